#include "core/swing_twist.hpp"

#include <glm/geometric.hpp>

namespace lutka {

SwingTwist swingTwist(const quat& rotation) {
    const quat q = rotation.w < 0.0F ? -rotation : rotation;
    const float length = std::hypot(q.w, q.x);
    const quat twist = length > 1e-6F ? quat(q.w / length, q.x / length, 0, 0) : quat(1, 0, 0, 0);
    vec3 swing = rotationVector(q * glm::conjugate(twist));
    swing.x = 0.0F;
    return {swing, 2.0F * std::atan2(twist.x, twist.w)};
}

quat rotationOf(const SwingTwist& parts) {
    const float angle = glm::length(parts.swing);
    const quat swing = angle > 1e-9F ? glm::angleAxis(angle, parts.swing / angle) : quat(1, 0, 0, 0);
    return swing * glm::angleAxis(parts.twist, vec3(1, 0, 0));
}

}  // namespace lutka
