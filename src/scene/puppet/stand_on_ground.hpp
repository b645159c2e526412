#pragma once

#include <functional>
#include <span>

#include "physics/world/world.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/description/scenario.hpp"

namespace lutka::scene {

/// The bodies of one of the scenario's dolls as it begins, model space; none where only its clip knows: the bind pose
/// counts then, without the arms, which it spreads.
using StartOfDoll = std::function<std::span<const physics::BodyState>(int doll)>;

/// Where dolls with muscles begin: on the ground below them, upright, as they head and at rest. Named scenes drop dolls
/// or throw them, and one whose hips are held would hang in the air there for good. Who stands already (soles within
/// 3 cm of the ground, upright to 1 degree), is held by a pin of the scene, has no ground within 10 m below, has a prop
/// between it and the ground, or would be in a prop or another doll there stays as it is. `world` has the scenario's
/// static shapes; it needs no dolls yet. Call it once: another call finds
/// room where somebody has gone.
void standOnGround(const physics::World& world, std::span<const RagdollAsset* const> assets, const StartOfDoll& startOf,
                   Scenario& scenario);

/// The same for one of the scenario's dolls that begins with these bodies (model space), whatever the others do.
[[nodiscard]] RigidTransform standingPlace(const physics::World& world, const RagdollAsset& asset,
                                           const Scenario& scenario, int doll,
                                           std::span<const physics::BodyState> start);

}  // namespace lutka::scene
