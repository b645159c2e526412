// safety MODEL...: what safety costs, as CSV. A row a model: reading it in this process and in a confined one, and the
// difference (30 ms at most are asked of a model of 20,000 vertices), on the clock and in a second row in processor
// time, which other work on the machine disturbs less; what both processes do at once counts twice there. Then two rows
// of dolls, apart and in a pile: a step of the default solver, and the share in it of the guard that catches dolls
// whose motion makes no sense (1 % asked).
//
// Both ways in turn and their medians: on a machine that others share, differences taken side by side travel.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "animation/import/import_character.hpp"
#include "physics/world/doll_guard.hpp"
#include "scene/ragdoll_asset.hpp"
#include "scene/scenario.hpp"
#include "scene/simulation.hpp"
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
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (!arguments.empty() && animation::asksForImport(arguments[0])) return animation::serveImport(arguments);
    if (arguments.empty()) {
        fmt::print(stderr, "usage: safety MODEL...\n");
        return 2;
    }
    fmt::print("what,size,direct or step ms,confined or guard ms,more\n");
    int failed = 0;
    for (const std::string& file : arguments)
        failed += measureReading(file);
    const auto asset = scene::loadRagdoll(arguments[0]);
    if (!asset) return failed + 1;
    measureGuard(*asset.value(), "drop", 100);
    measureGuard(*asset.value(), "pile", 100);
    return failed;
}
