#pragma once

#include "core/rigid_transform.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// Where a constraint stands: the two anchors' distance and how far past its limits it is (0 inside).
struct ConstraintState {
    float separationM = 0;
    float violation = 0;   ///< Radians past the nearest limit.
    float hingeAngle = 0;  ///< Radians, hinge only.
    vec3 swing{0, 0, 0};   ///< Rotation vector of the swing in the parent frame (x = 0), cone-twist only.
    float twist = 0;       ///< Radians, cone-twist only.
};
[[nodiscard]] ConstraintState measureConstraint(const ConstraintProfile& constraint,
                                                const RigidTransform& worldFromParent,
                                                const RigidTransform& worldFromChild);

}  // namespace lutka::physics
