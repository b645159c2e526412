#include "animation/ik/swing_twist_range.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace lutka::animation {
namespace {

struct SwingAndTwist {
    vec3 swing{0, 0, 0};  // rotation vector, x = 0
    float twist = 0.0F;   // about x
};

SwingAndTwist takenApart(const quat& rotation) {
    const quat q = rotation.w < 0.0F ? -rotation : rotation;
    const float length = std::hypot(q.w, q.x);
    const quat twist = length > 1e-6F ? quat(q.w / length, q.x / length, 0, 0) : quat(1, 0, 0, 0);
    vec3 swing = rotationVector(q * glm::conjugate(twist));
    swing.x = 0.0F;
    return {swing, 2.0F * std::atan2(twist.x, twist.w)};
}

quat turnBy(const vec3& vector) {
    const float angle = glm::length(vector);
    return angle > 1e-9F ? glm::angleAxis(angle, vector / angle) : quat(1, 0, 0, 0);
}

quat inRangesAxes(const SwingTwistRange& range, const quat& parentFromJoint) {
    return glm::conjugate(range.parentFromNeutral) * parentFromJoint * range.jointFromNeutral;
}

// 1 on the ellipse.
float swingShare(const SwingTwistRange& range, const vec3& swing) {
    return std::hypot(swing.y / range.mostSwingY, swing.z / range.mostSwingZ);
}

}  // namespace

quat clampedTo(const SwingTwistRange& range, const quat& parentFromJoint) {
    SwingAndTwist parts = takenApart(inRangesAxes(range, parentFromJoint));
    const float share = swingShare(range, parts.swing);
    const float twist = std::clamp(parts.twist, range.leastTwist, range.mostTwist);
    if (share <= 1.0F && twist == parts.twist) return parentFromJoint;
    if (share > 1.0F) parts.swing /= share;
    const quat within = turnBy(parts.swing) * glm::angleAxis(twist, vec3(1, 0, 0));
    return glm::normalize(range.parentFromNeutral * within * glm::conjugate(range.jointFromNeutral));
}

float excessOf(const SwingTwistRange& range, const quat& parentFromJoint) {
    const SwingAndTwist parts = takenApart(inRangesAxes(range, parentFromJoint));
    const float share = swingShare(range, parts.swing);
    const float swing = share > 1.0F ? glm::length(parts.swing) * (1.0F - 1.0F / share) : 0.0F;
    return std::max({swing, parts.twist - range.mostTwist, range.leastTwist - parts.twist, 0.0F});
}

float softlyClamped(float value, float low, float high, float softness) {
    const float soft = std::min(softness, (high - low) * 0.25F);
    if (soft <= 0.0F) return std::clamp(value, low, high);
    if (value > high - soft) return high - soft * std::exp(-(value - (high - soft)) / soft);
    if (value < low + soft) return low + soft * std::exp((value - (low + soft)) / soft);
    return value;
}

}  // namespace lutka::animation
