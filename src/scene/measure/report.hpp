#pragma once

#include <span>
#include <string>

#include "scene/run/simulation.hpp"

namespace lutka::scene {

/// Wall times of steps, milliseconds.
struct StepSummary {
    float mean = 0;
    float p50 = 0;
    float p99 = 0;
};
/// Of wall times in milliseconds; all 0 for an empty span.
[[nodiscard]] StepSummary summarise(std::span<const float> stepMs);

/// The report of a finished run as one JSON document (`--report`, `simulate --json`; the keys are in docs/cli.md).
[[nodiscard]] std::string reportJson(const Simulation& simulation);

/// The same in a few lines for a person.
[[nodiscard]] std::string reportText(const Simulation& simulation);

}  // namespace lutka::scene
