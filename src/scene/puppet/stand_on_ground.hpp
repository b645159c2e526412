#pragma once

#include <span>

#include "physics/world/world.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/description/scenario.hpp"

namespace lutka::scene {

/// Where dolls with muscles begin: on the ground below them, upright, as they head and at rest. Named scenes drop dolls
/// or throw them, and one whose hips are held would hang in the air there for good. Who stands already (soles within
/// 3 cm of the ground, upright to 1 degree), is held by a pin of the scene, or has no ground within 10 m below stays as
/// it is. `world` has the scenario's static shapes; it needs no dolls yet.
void standOnGround(const physics::World& world, std::span<const RagdollAsset* const> assets, Scenario& scenario);

/// The same for one doll that the scenario places at `worldFromModel`: where it stands.
[[nodiscard]] RigidTransform standingPlace(const physics::World& world, const RagdollAsset& asset,
                                           const Scenario& scenario, const RigidTransform& worldFromModel);

}  // namespace lutka::scene
