// reading MODEL.glb ...: what import, mapping and fit of a glTF cost beside tinygltf's own reading of the file, as CSV,
// a row a model: vertices; milliseconds of tinygltf, import, map and fit without pictures, and the ratio of the three
// to the first (1.3 at most is asked at 20,000 vertices); the same ratio with pictures decoded by both.
//
// All in turn in one process, and their medians: on a machine that others share, ratios taken side by side travel.
#include <fmt/format.h>
#include <tiny_gltf.h>

#include <functional>
#include <string>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "animation/import/import_character.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "timing.hpp"

namespace {

using namespace lutka;

constexpr int kRounds = 25;

bool skipPicture(tinygltf::Image* /*image*/, int /*index*/, std::string* /*error*/, std::string* /*warning*/,
                 int /*width*/, int /*height*/, const unsigned char* /*bytes*/, int /*size*/, void* /*user*/) {
    return true;
}

bool readWithTinygltf(const std::string& file, bool pictures) {
    tinygltf::TinyGLTF loader;
    if (!pictures) loader.SetImageLoader(skipPicture, nullptr);
    tinygltf::Model model;
    std::string error;
    std::string warning;
    const bool read = file.ends_with(".gltf") ? loader.LoadASCIIFromFile(&model, &error, &warning, file)
                                              : loader.LoadBinaryFromFile(&model, &error, &warning, file);
    if (!read) fmt::print(stderr, "{}: {}\n", file, error);
    return read;
}

std::size_t verticesOf(const animation::Character& character) {
    std::size_t count = 0;
    for (const animation::SkinnedMesh& mesh : character.meshes)
        count += mesh.positions.size();
    return count;
}

// Medians over rounds in which every case has its turn.
std::vector<double> mediansOf(const std::vector<std::function<void()>>& cases) {
    std::vector<std::vector<double>> ms(cases.size());
    for (int round = 0; round < kRounds; ++round) {
        for (std::size_t i = 0; i < cases.size(); ++i)
            ms[i].push_back(timeOf(cases[i]));
    }
    std::vector<double> medians;
    for (const std::vector<double>& one : ms)
        medians.push_back(medianOf(one));
    return medians;
}

bool measure(const std::string& file) {
    animation::ImportOptions bare;
    bare.loadTextures = false;
    const animation::ImportOptions whole;
    const auto character = animation::importCharacter(file, bare);
    if (!character) {
        fmt::print(stderr, "{}\n", character.error().text());
        return false;
    }
    if (!readWithTinygltf(file, true)) return false;
    const animation::HumanoidMap map = animation::mapHumanoid(character.value());
    const std::vector<double> ms = mediansOf({[&] { static_cast<void>(readWithTinygltf(file, false)); },
                                              [&] { static_cast<void>(animation::importCharacter(file, bare)); },
                                              [&] { static_cast<void>(animation::mapHumanoid(character.value())); },
                                              [&] { static_cast<void>(physics::fitRagdoll(character.value(), map)); },
                                              [&] { static_cast<void>(readWithTinygltf(file, true)); },
                                              [&] { static_cast<void>(animation::importCharacter(file, whole)); }});
    const double rest = ms[2] + ms[3];
    fmt::print("{},{},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f}\n", file.substr(file.rfind('/') + 1),
               verticesOf(character.value()), ms[0], ms[1], ms[2], ms[3], (ms[1] + rest) / ms[0],
               (ms[5] + rest) / ms[4]);
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    fmt::print("model,vertices,tinygltf ms,import ms,map ms,fit ms,ratio,ratio with pictures\n");
    bool sound = argc > 1;
    for (int i = 1; i < argc; ++i)
        sound = measure(argv[i]) && sound;
    return sound ? 0 : 1;
}
