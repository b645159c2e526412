#include "physics/profile/within_limits.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "core/swing_twist.hpp"

namespace lutka::physics {

quat withinLimits(const ConstraintProfile& constraint, const quat& parentFromChild, float share) {
    const quat& parentFrame = constraint.parentFromFrame.rotation;
    const quat& childFrame = constraint.childFromFrame.rotation;
    const quat relative = glm::conjugate(parentFrame) * parentFromChild * childFrame;
    const auto back = [&](const quat& within) {
        return glm::normalize(parentFrame * within * glm::conjugate(childFrame));
    };
    if (constraint.kind == ConstraintProfile::Kind::hinge) {
        const float angle = std::remainder(2.0F * std::atan2(relative.z, relative.w), 2.0F * kPi);
        const float within = std::clamp(angle, share * constraint.hinge.lower, share * constraint.hinge.upper);
        return back(glm::angleAxis(within, vec3(0, 0, 1)));
    }
    SwingTwist parts = swingTwist(relative);
    const ConeTwistLimits& cone = constraint.cone;
    const float outness = std::hypot(parts.swing.y / cone.swingY, parts.swing.z / cone.swingZ) / share;
    const float twist = std::clamp(parts.twist, -share * cone.twist, share * cone.twist);
    if (outness <= 1.0F && twist == parts.twist) return parentFromChild;
    if (outness > 1.0F) parts.swing /= outness;
    return back(rotationOf({parts.swing, twist}));
}

}  // namespace lutka::physics
