#pragma once

#include "animation/character.hpp"
#include "animation/humanoid/map_humanoid.hpp"
#include "core/result.hpp"
#include "physics/body_plan.hpp"
#include "physics/limits.hpp"
#include "physics/profile.hpp"

namespace lutka::physics {

/// A profile made for one character, applied to another (or to the same one under other joint names) by role.
///
/// Kept: which roles have bodies, masses, kinds and spans of the limits, friction, filtered pairs. Made anew from the
/// rig's own anatomy: joints, constraint frames, and shapes with their inertia; with `keepShapes` the shapes keep their
/// size and their place relative to the constraint frames. A limit that the new bind pose breaks is widened (see
/// RagdollProfile::notes), and pairs that overlap in it are filtered. Trunk roles stand in for one another, see
/// adaptTrunk().
/// Fails with ErrorCode::input, naming every role that the new rig lacks.
[[nodiscard]] Result<RagdollProfile> rebindProfile(const RagdollProfile& profile, const animation::Character& character,
                                                   const animation::HumanoidMap& map, bool keepShapes = false);

/// Writes joints, shapes and their places into the bodies, in the plan's order; masses and inertia stay.
void placeBodies(RagdollProfile& profile, const animation::Character& character, const BodyPlan& plan,
                 std::span<const PlacedShape> shapes);

/// The shapes of a profile in its character's bind pose, in the standard stance's axes.
/// Every joint of the profile must be in the skeleton.
[[nodiscard]] std::vector<PlacedShape> shapesInBindPose(const RagdollProfile& profile,
                                                        const animation::Skeleton& skeleton);

/// The roles of a profile's bodies, in their order.
[[nodiscard]] std::vector<Role> rolesOf(const RagdollProfile& profile);

}  // namespace lutka::physics
