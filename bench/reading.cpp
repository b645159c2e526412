// reading MODEL.glb ...: what import, mapping and fit of a glTF cost beside tinygltf's own reading of the file, as CSV,
// a row a model: vertices; milliseconds of the processor that tinygltf, import, map and fit take without pictures, then
// tinygltf and import with them; the ratio of import, map and fit to tinygltf, by the processor's time and by the
// clock, without and with pictures (1.3 at most is asked at 20,000 vertices).
//
// All in turn in one process, and the least of each: on a machine that others share, that travels best.
#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <ctime>
#include <functional>
#include <limits>
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

struct Cost {
    double wallMs = std::numeric_limits<double>::max();
    double processorMs = std::numeric_limits<double>::max();  // of all threads
};

double processorMsNow() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// The least of rounds in which every case has its turn.
std::vector<Cost> leastOf(const std::vector<std::function<void()>>& cases) {
    std::vector<Cost> least(cases.size());
    for (int round = 0; round < kRounds; ++round) {
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const double before = processorMsNow();
            least[i].wallMs = std::min(least[i].wallMs, timeOf(cases[i]));
            least[i].processorMs = std::min(least[i].processorMs, processorMsNow() - before);
        }
    }
    return least;
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
    enum Case { kBareBaseline, kBareImport, kMap, kFit, kBaseline, kImport };
    const std::vector<Cost> cost = leastOf({[&] { static_cast<void>(readWithTinygltf(file, false)); },
                                            [&] { static_cast<void>(animation::importCharacter(file, bare)); },
                                            [&] { static_cast<void>(animation::mapHumanoid(character.value())); },
                                            [&] { static_cast<void>(physics::fitRagdoll(character.value(), map)); },
                                            [&] { static_cast<void>(readWithTinygltf(file, true)); },
                                            [&] { static_cast<void>(animation::importCharacter(file, whole)); }});
    const auto ratio = [&](double Cost::*of, Case import, Case baseline) {
        return (cost[import].*of + cost[kMap].*of + cost[kFit].*of) / cost[baseline].*of;
    };
    fmt::print("{},{}", file.substr(file.rfind('/') + 1), verticesOf(character.value()));
    for (const Cost& one : cost)
        fmt::print(",{:.2f}", one.processorMs);
    fmt::print(",{:.2f},{:.2f},{:.2f},{:.2f}\n", ratio(&Cost::processorMs, kBareImport, kBareBaseline),
               ratio(&Cost::wallMs, kBareImport, kBareBaseline), ratio(&Cost::processorMs, kImport, kBaseline),
               ratio(&Cost::wallMs, kImport, kBaseline));
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    fmt::print(
        "model,vertices,tinygltf ms,import ms,map ms,fit ms,tinygltf with pictures ms,import with pictures ms,"
        "ratio,ratio by the clock,ratio with pictures,ratio with pictures by the clock\n");
    bool sound = argc > 1;
    for (int i = 1; i < argc; ++i)
        sound = measure(argv[i]) && sound;
    return sound ? 0 : 1;
}
