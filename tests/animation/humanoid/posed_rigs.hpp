#pragma once

#include "animation/humanoid/roles.hpp"
#include "synthetic_rigs.hpp"

namespace lutka::test {

/// The joint that truth has first for the role.
[[nodiscard]] int jointOf(const SyntheticRig& rig, animation::Role role);

[[nodiscard]] bool isBelow(const animation::Skeleton& skeleton, int top, int joint);

/// Turns a role's joint and all below it about the joint itself.
void turn(SyntheticRig& rig, animation::Role role, float angle, const vec3& axis);

/// Turns the joints of both sides about x.
void turnBoth(SyntheticRig& rig, animation::Role left, float angle);

/// Without the joints of a role and below it.
void cutOff(SyntheticRig& rig, animation::Role role);

/// The map is right in every required role.
void checkWhole(const SyntheticRig& rig);

/// Every role of a side whose joint is still there has that joint, no other one of a side has any, and some role is
/// missing.
void checkWhatIsLeft(const SyntheticRig& rig);

}  // namespace lutka::test
