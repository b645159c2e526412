#pragma once

#include <span>
#include <vector>

#include "export/export_ragdoll.hpp"
#include "physics/collision/friction.hpp"

namespace lutka::exporting {

/// A doll's friction on the ground: what a body is written with where an engine takes the less of both sides'.
inline constexpr float kContactFriction = physics::kBodyFriction * physics::kStaticFriction;

/// The z-up world of robotics: x forward, y left, z up. Takes the standard stance (Y up, facing +Z, left at +X) to it.
[[nodiscard]] quat zUpFromStandard();

/// Bodies in the neutral pose of all constraints, where both frames of each agree, in the model's space; the first
/// body stands as in the bind pose. In it every angle of every joint is zero.
[[nodiscard]] std::vector<RigidTransform> neutralPose(const ExportSource& source);

/// The child's body in the parent's, in the neutral pose of their constraint.
[[nodiscard]] RigidTransform neutralParentFromChild(const physics::ConstraintProfile& constraint);

/// R_parentFrame⁻¹ · R_childFrame in the bind pose.
[[nodiscard]] quat bindRotation(const ExportSource& source, const physics::ConstraintProfile& constraint);

/// The hinge's angle in the bind pose, radians.
[[nodiscard]] float bindHingeAngle(const ExportSource& source, const physics::ConstraintProfile& constraint);

/// How far the lowest point of all shapes lies along `up` (unit, in the space of the poses) from the origin, metres.
[[nodiscard]] float lowestPoint(const physics::RagdollProfile& profile, std::span<const RigidTransform> spaceFromBody,
                                const vec3& up);

/// Turns the figure upright and puts the lowest point of its bodies in the bind pose on height 0 (Y up).
[[nodiscard]] RigidTransform standingFromModel(const ExportSource& source);

/// The name of a body as an identifier of every language, unique in the profile; of a role it is the role's.
[[nodiscard]] std::string bodyName(const physics::RagdollProfile& profile, int body);
/// The name of the body's further shape of that index, which no body has.
[[nodiscard]] std::string addedName(const std::string& body, std::size_t index);

}  // namespace lutka::exporting
