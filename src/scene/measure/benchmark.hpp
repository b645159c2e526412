#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/measure/report.hpp"
#include "scene/run/scene_cast.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::scene {

/// One case: our solver and plain Bullet (`stock`) on the same profile and scene, stepped in turn in one process.
struct BenchCase {
    std::string scene = "spread";
    int count = 100;
    int threads = 1;
    physics::SolverKind solver = physics::SolverKind::crowd;
    bool sleeping = false;
    int steps = 300;  ///< Of 1/60 s.
};

struct BenchResult {
    BenchCase what;
    StepSummary ours;          ///< Milliseconds a step, without measuring.
    StepSummary stock;         ///< Likewise.
    float speedup = 0;         ///< Stock's time over ours: the median over interleaved blocks of steps.
    physics::Quality quality;  ///< Of a run of its own, so that measuring costs no time above.
    physics::Quality stockQuality;
    std::uint64_t contacts = 0;     ///< Of our world at the last step.
    std::uint64_t memoryBytes = 0;  ///< Heap that our world holds at the end.

    /// How many steps of 1/60 s of one doll ours makes in a second; 0 for a case without time.
    [[nodiscard]] double dollStepsPerSecond() const;
    /// How many dolls one core carries in real time, at the cost that a doll has in this case.
    [[nodiscard]] double realTimeDollsPerCore() const;
};

/// Runs one case. Fails as makeScenario and Simulation::create do.
[[nodiscard]] Result<BenchResult> runBenchmark(const RagdollAsset& asset, const BenchCase& what);
/// The same of a scene's own characters; `what.scene` and `what.count` only label it.
[[nodiscard]] Result<BenchResult> runBenchmark(const EntityScene& scene, const SceneCast& cast, const BenchCase& what);

/// `lutka bench --json`: {"machine", "cases": […]}, and the same as CSV with a header line.
[[nodiscard]] std::string benchmarkJson(std::span<const BenchResult> results);
[[nodiscard]] std::string benchmarkCsv(std::span<const BenchResult> results);

}  // namespace lutka::scene
