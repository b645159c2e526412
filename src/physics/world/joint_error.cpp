#include "physics/world/joint_error.hpp"

#include <cmath>

namespace lutka::physics {

MotorError motorError(const ConstraintProfile& constraint, const JointMotor& motor, const quat& worldFromParent,
                      const quat& worldFromChild) {
    const quat parentFrame = worldFromParent * constraint.parentFromFrame.rotation;
    const quat relative = glm::conjugate(parentFrame) * (worldFromChild * constraint.childFromFrame.rotation);
    MotorError found;
    if (constraint.kind == ConstraintProfile::Kind::hinge) {
        found.count = 1;
        found.axes[0] = parentFrame * vec3(0, 0, 1);
        found.error.x = std::remainder(2.0F * std::atan2(relative.z, relative.w) - motor.angle, 2.0F * kPi);
        return found;
    }
    found.count = 3;
    found.axes = {parentFrame * vec3(1, 0, 0), parentFrame * vec3(0, 1, 0), parentFrame * vec3(0, 0, 1)};
    found.error = rotationVector(glm::normalize(relative * glm::conjugate(motor.target)));
    return found;
}

}  // namespace lutka::physics
