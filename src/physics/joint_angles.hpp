#pragma once

#include "core/math.hpp"

namespace lutka::physics {

/// q = swing · twist, twist about x: the rotation that takes the parent's constraint frame to the child's.
struct SwingTwist {
    vec3 swing{0, 0, 0};  ///< Rotation vector, x = 0, length in [0, pi].
    float twist = 0.0F;   ///< Radians, (-pi, pi].
};

/// The twist is (w, x, 0, 0) normalised, the swing what remains. A swing by pi leaves the twist undefined: 0 then.
[[nodiscard]] inline SwingTwist swingTwistOf(const quat& q) {
    const float norm = std::sqrt(q.w * q.w + q.x * q.x);
    if (norm < 1e-6F) return {rotationVector(q), 0.0F};
    const quat twist(q.w / norm, q.x / norm, 0, 0);
    const vec3 swing = rotationVector(q * glm::conjugate(twist));
    float angle = 2.0F * std::atan2(twist.x, twist.w);
    if (angle > kPi) angle -= 2.0F * kPi;
    if (angle <= -kPi) angle += 2.0F * kPi;
    return {{0, swing.y, swing.z}, angle};
}

/// Rotation about z in q, radians, (-pi, pi].
[[nodiscard]] inline float hingeAngleOf(const quat& q) {
    float angle = 2.0F * std::atan2(q.z, q.w);
    if (angle > kPi) angle -= 2.0F * kPi;
    if (angle <= -kPi) angle += 2.0F * kPi;
    return angle;
}

}  // namespace lutka::physics
