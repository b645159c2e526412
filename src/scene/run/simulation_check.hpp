#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/run/simulation.hpp"

namespace lutka::scene {

/// All that keeps a simulation from being made of these, a few words each; empty when nothing does. What it looks at:
/// no assets or null ones, dolls, pins and hits whose index names none, geometry and props that a world would refuse,
/// numbers that are not finite or out of the range that their declaration gives, options that do not go together.
[[nodiscard]] std::vector<std::string> problemsOf(std::span<const RagdollAsset* const> assets, const Scenario& scenario,
                                                  const SimulationOptions& options);

}  // namespace lutka::scene
