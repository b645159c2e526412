#pragma once

#include <nlohmann/json.hpp>

#include "physics/fit/fit_measures.hpp"
#include "physics/world/quality.hpp"

namespace lutka::scene {

/// The figures as reports and benchmarks print them; keys in the order of docs/cli.md.
[[nodiscard]] nlohmann::ordered_json qualityJson(const physics::Quality& quality);

/// The measures of the fit: "vertices", "skinNear" and "volumeCovered" (shares in [0, 1]; null where unknown),
/// "overlapM".
[[nodiscard]] nlohmann::ordered_json fitJson(const physics::FitMeasures& fit);

}  // namespace lutka::scene
