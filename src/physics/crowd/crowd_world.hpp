#pragma once

#include <memory>

#include "physics/crowd/tuning.hpp"
#include "physics/world/world.hpp"

namespace lutka::physics {

/// A World that solves dolls of one profile eight at a time, one a SIMD lane (docs/crowd.md). It has no Bullet in it.
/// `settings.solver` is not looked at.
[[nodiscard]] std::unique_ptr<World> createCrowdWorld(const WorldSettings& settings,
                                                      const crowd::CrowdTuning& tuning = {});

}  // namespace lutka::physics
