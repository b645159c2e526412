#pragma once

#include <array>

#include "physics/world/world.hpp"

namespace lutka::physics {

/// How far a joint is from its motor's target, about each axis that the motor turns.
struct MotorError {
    int count = 0;               ///< Hinge: 1. Cone-twist: 3.
    std::array<vec3, 3> axes{};  ///< World, unit; positive turns the child.
    vec3 error{0, 0, 0};         ///< Radians, the child ahead of the target.
};
[[nodiscard]] MotorError motorError(const ConstraintProfile& constraint, const JointMotor& motor,
                                    const quat& worldFromParent, const quat& worldFromChild);

}  // namespace lutka::physics
