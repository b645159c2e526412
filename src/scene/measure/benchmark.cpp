#include "scene/measure/benchmark.hpp"

#include <malloc.h>

#include <algorithm>
#include <numeric>

namespace lutka::scene {
namespace {

// Long enough to outweigh the clock, short enough that both worlds see the same weather on a shared machine.
constexpr int kBlock = 10;

// What both solvers are given.
struct Stage {
    std::vector<const RagdollAsset*> assets;
    Scenario scenario;
    SimulationOptions options;
};

Result<std::unique_ptr<Simulation>> makeSimulation(const Stage& stage, const BenchCase& what,
                                                   physics::SolverKind solver, bool measure) {
    SimulationOptions options = stage.options;
    options.world.solver = solver;
    options.world.threads = what.threads;
    options.world.sleeping = what.sleeping;
    options.measure = measure;
    return Simulation::create(stage.assets, stage.scenario, options);
}

// The last `steps` of a run, in sum.
float sumOfLast(const Simulation& simulation, int steps) {
    const auto times = simulation.stepMs().last(static_cast<std::size_t>(steps));
    return std::accumulate(times.begin(), times.end(), 0.0F);
}

std::size_t heapInUse() {
    const auto info = ::mallinfo2();
    return info.uordblks + info.hblkhd;
}

float medianOf(std::vector<float> values) {
    if (values.empty()) return 0.0F;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

Result<physics::Quality> measureQuality(const Stage& stage, const BenchCase& what, physics::SolverKind solver) {
    auto simulation = makeSimulation(stage, what, solver, true);
    if (!simulation) return simulation.error();
    for (int step = 0; step < what.steps; ++step)
        simulation.value()->step();
    return simulation.value()->quality();
}

Result<BenchResult> runBenchmark(const Stage& stage, const BenchCase& what) {
    BenchResult result;
    result.what = what;
    auto stock = makeSimulation(stage, what, physics::SolverKind::stock, false);
    if (!stock) return stock.error();
    auto ours = makeSimulation(stage, what, what.solver, false);
    if (!ours) return ours.error();
    std::vector<float> ratios;
    for (int done = 0; done < what.steps; done += kBlock) {
        const int block = std::min(kBlock, what.steps - done);
        for (int step = 0; step < block; ++step)
            stock.value()->step();
        for (int step = 0; step < block; ++step)
            ours.value()->step();
        ratios.push_back(sumOfLast(*stock.value(), block) / std::max(sumOfLast(*ours.value(), block), 1e-6F));
    }
    result.ours = summarise(ours.value()->stepMs());
    result.stock = summarise(stock.value()->stepMs());
    result.speedup = medianOf(std::move(ratios));
    std::vector<physics::ContactPoint> contacts;
    ours.value()->world().getContacts(contacts);
    result.contacts = contacts.size();
    // What is given back with it: stock's own heap grows in the same run.
    const std::size_t held = heapInUse();
    ours.value().reset();
    const std::size_t left = heapInUse();
    result.memoryBytes = held > left ? held - left : 0;
    auto quality = measureQuality(stage, what, what.solver);
    if (!quality) return quality.error();
    auto stockQuality = measureQuality(stage, what, physics::SolverKind::stock);
    if (!stockQuality) return stockQuality.error();
    result.quality = quality.value();
    result.stockQuality = stockQuality.value();
    return result;
}

}  // namespace

Result<BenchResult> runBenchmark(const RagdollAsset& asset, const BenchCase& what) {
    auto scenario = makeScenario({.name = what.scene, .count = what.count, .seed = 1}, asset);
    if (!scenario) return scenario.error();
    return runBenchmark(Stage{{&asset}, std::move(scenario).value(), {}}, what);
}

Result<BenchResult> runBenchmark(const EntityScene& scene, const SceneCast& cast, const BenchCase& what) {
    auto scenario = compileScene(scene, cast.figures(), cast.assetOfRagdoll);
    if (!scenario) return scenario.error();
    return runBenchmark(Stage{cast.pointers(), std::move(scenario).value(), simulationOptionsOf(scene)}, what);
}

}  // namespace lutka::scene
