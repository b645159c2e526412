#pragma once

#include <nlohmann/json.hpp>

#include "physics/quality.hpp"

namespace lutka::scene {

/// The figures as reports and benchmarks print them; keys in the order of docs/cli.md.
[[nodiscard]] nlohmann::ordered_json qualityJson(const physics::Quality& quality);

}  // namespace lutka::scene
