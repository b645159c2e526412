#pragma once

#include <vector>

#include "physics/world/world.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::scene {

/// The bodies of one doll in model space, as its placement's pose or clip has them, else those of the options. A clip
/// gives velocities too: central differences over two steps of `dt` around the moment (one-sided at the clip's ends),
/// linear of the body's centre of mass and angular by the rotation vector. Fails with ErrorCode::usage when the clip
/// doesn't exist.
[[nodiscard]] Result<std::vector<physics::BodyState>> startBodies(const RagdollAsset& asset,
                                                                  const SimulationOptions& options,
                                                                  const Placement& placement = {});

}  // namespace lutka::scene
