// safety [MODEL...]: what safety costs, as CSV. A row a model, and one of a tube of 20,000 vertices made here: reading
// it in this process and in a confined one, and the difference (30 ms at most are asked of 20,000 vertices), on the
// clock and in a second row in processor time, which other work on the machine disturbs less; what both processes do at
// once counts twice there. Then two rows of dolls, apart and in a pile: a step of the default solver, and the share in
// it of the guard that catches dolls whose motion makes no sense (1 % asked).
//
// Both ways in turn and their medians: on a machine that others share, differences taken side by side travel.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "animation/import/gltf_file.hpp"
#include "animation/import/import_character.hpp"
#include "physics/world/doll_guard.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/description/scenario.hpp"
#include "scene/run/simulation.hpp"
#include "support/rigs.hpp"
#include "timing.hpp"

namespace {

using namespace lutka;

constexpr int kRounds = 31;
constexpr int kSteps = 240;

// Of the processor, of this process and those that it has waited for, so far.
double processorMs() {
    double ms = 0.0;
    for (const auto whose : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage used{};
        ::getrusage(whose, &used);
        ms += 1e3 * static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
              1e-3 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
    }
    return ms;
}

/// Two ways of the same work, in turn.
struct TwoWays {
    std::vector<double> direct, confined, more;

    void add(double directMs, double confinedMs) {
        direct.push_back(directMs);
        confined.push_back(confinedMs);
        more.push_back(confinedMs - directMs);
    }
    void print(const std::string& what, std::size_t vertices) {
        fmt::print("{},{} vertices,{:.2f},{:.2f},{:.2f}\n", what, vertices, medianOf(direct), medianOf(confined),
                   medianOf(more));
    }
};

/// A tube of rings, 1.8 m tall, that hangs on three joints by two weights a vertex: 20,000 vertices with normals and
/// texture coordinates, 39,800 triangles, no pictures.
test::GltfFile makeTube() {
    constexpr int kAround = 100;
    constexpr int kHigh = 200;
    std::vector<float> positions, normals, places, weights;
    std::vector<std::array<std::uint8_t, 4>> joints;
    std::vector<std::uint16_t> indices;
    for (int vertex = 0; vertex < kAround * kHigh; ++vertex) {
        const float turn = static_cast<float>(vertex % kAround) / kAround;
        const float up = static_cast<float>(vertex / kAround) / (kHigh - 1);
        const float angle = 2.0F * std::numbers::pi_v<float> * turn;
        const float joint = std::min(2.0F * up, 1.999F);
        const float share = joint - std::floor(joint);
        const auto lower = static_cast<std::uint8_t>(joint);
        positions.insert(positions.end(), {0.2F * std::cos(angle), 1.8F * up, 0.2F * std::sin(angle)});
        normals.insert(normals.end(), {std::cos(angle), 0.0F, std::sin(angle)});
        places.insert(places.end(), {turn, up});
        weights.insert(weights.end(), {1.0F - share, share, 0.0F, 0.0F});
        joints.push_back({lower, static_cast<std::uint8_t>(lower + 1), 0, 0});
        if (vertex >= kAround * (kHigh - 1)) continue;
        const int beside = vertex % kAround + 1 < kAround ? vertex + 1 : vertex + 1 - kAround;
        for (const int corner : {vertex, vertex + kAround, beside, beside, vertex + kAround, beside + kAround})
            indices.push_back(static_cast<std::uint16_t>(corner));
    }
    test::GltfFile file = test::makePostRig();
    file.json["meshes"][0]["primitives"][0] = {{"attributes",
                                                {{"POSITION", file.addFloats(positions, "VEC3")},
                                                 {"NORMAL", file.addFloats(normals, "VEC3")},
                                                 {"TEXCOORD_0", file.addFloats(places, "VEC2")},
                                                 {"JOINTS_0", file.addBytes4(joints)},
                                                 {"WEIGHTS_0", file.addFloats(weights, "VEC4")}}},
                                               {"indices", file.addIndices(indices)}};
    return file;
}

std::size_t verticesOf(const animation::Character& character) {
    std::size_t count = 0;
    for (const animation::SkinnedMesh& mesh : character.meshes)
        count += mesh.positions.size();
    return count;
}

int measureReading(const std::string& file) {
    animation::ImportOptions direct;
    animation::ImportOptions confined;
    confined.worker.program = std::filesystem::read_symlink("/proc/self/exe");
    const auto character = animation::importCharacter(file, confined);
    if (!character) {
        fmt::print(stderr, "{}\n", character.error().text());
        return 1;
    }
    TwoWays clock;
    TwoWays processor;
    for (int round = 0; round < kRounds; ++round) {
        const double before = processorMs();
        const double directMs = timeOf([&] { static_cast<void>(animation::importCharacter(file, direct)); });
        const double between = processorMs();
        const double confinedMs = timeOf([&] { static_cast<void>(animation::importCharacter(file, confined)); });
        clock.add(directMs, confinedMs);
        processor.add(between - before, processorMs() - between);
    }
    const std::string name = std::filesystem::path(file).filename().string();
    clock.print("reading " + name, verticesOf(character.value()));
    processor.print("its processor time", verticesOf(character.value()));
    return 0;
}

// The guard's own work over the same states, timed beside the step that contains it.
void measureGuard(const scene::RagdollAsset& asset, const std::string& scenario, int count) {
    auto made = scene::makeScenario({.name = scenario, .count = count, .seed = 1}, asset);
    scene::SimulationOptions options;
    options.measure = false;
    options.world.sleeping = false;
    const auto simulation = std::move(scene::Simulation::create(asset, std::move(made).value(), options)).value();
    const physics::WorldView& world = simulation->world();
    physics::DollGuard guard;
    std::vector<physics::BodyState> bodies(asset.profile.bodies.size());
    for (const physics::DollId doll : world.dolls()) {
        world.getBodies(doll, bodies);
        guard.add(doll, asset.profile, bodies);
    }
    std::vector<double> stepMs;
    std::vector<double> guardMs;
    for (int step = 0; step < kSteps; ++step) {
        stepMs.push_back(timeOf([&] { simulation->step(); }));
        guardMs.push_back(timeOf([&] {
            for (int doll = 0; doll < count; ++doll) {
                const std::span<physics::BodyState> states = guard.scratch(doll);
                world.getBodies(world.dolls()[doll], states);
                static_cast<void>(guard.judge(doll, states, 0.0));
            }
        }));
    }
    const double whole = medianOf(stepMs);
    const double part = medianOf(guardMs);
    fmt::print("guard in {},{} dolls,{:.3f},{:.4f},{:.2f} %\n", scenario, count, whole, part, 100.0 * part / whole);
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> arguments(argv + 1, argv + argc);
    if (!arguments.empty() && animation::asksForImport(arguments[0])) return animation::serveImport(arguments);
    const test::TemporaryFolder folder;
    arguments.push_back((folder / "tube.glb").string());
    makeTube().saveBinary(arguments.back());
    fmt::print("what,size,direct or step ms,confined or guard ms,more\n");
    int failed = 0;
    for (const std::string& file : arguments)
        failed += measureReading(file);
    const auto asset = scene::makeRagdoll(test::makeBiped());
    if (!asset) return failed + 1;
    measureGuard(*asset.value(), "drop", 100);
    measureGuard(*asset.value(), "pile", 100);
    return failed;
}
