#pragma once

#include "animation/character.hpp"
#include "animation/humanoid/map_humanoid.hpp"
#include "core/result.hpp"
#include "physics/fit/body_plan.hpp"
#include "physics/fit/limits.hpp"
#include "physics/profile/profile.hpp"

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

/// A profile that fits a character's joints.
struct BoundProfile {
    RagdollProfile profile;
    bool rebound = false;  ///< It was made for another rig and went through rebindProfile().
};

/// The profile as it is where it was made for this rig: its joints are there, and the anchors of every constraint meet
/// in the bind pose. Else rebindProfile(). Fails with ErrorCode::input as that does, and when a few of the joints are
/// not there: those are typos to be mended, not another rig.
[[nodiscard]] Result<BoundProfile> bindOrRebind(RagdollProfile profile, const animation::Character& character,
                                                const animation::HumanoidMap& map, bool keepShapes = false);

/// Writes joints, shapes and their places into the bodies, in the plan's order; masses and inertia stay.
void placeBodies(RagdollProfile& profile, const animation::Character& character, const BodyPlan& plan,
                 std::span<const PlacedShape> shapes);

/// The shapes of a profile in its character's bind pose, in the standard stance's axes.
/// Every joint of the profile must be in the skeleton.
[[nodiscard]] std::vector<PlacedShape> shapesInBindPose(const RagdollProfile& profile,
                                                        const animation::Skeleton& skeleton);

/// The roles of a profile's bodies, in their order.
/// Of the bodies that have one.
[[nodiscard]] std::vector<Role> rolesOf(const RagdollProfile& profile);

}  // namespace lutka::physics
