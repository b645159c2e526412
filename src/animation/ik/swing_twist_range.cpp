#include "animation/ik/swing_twist_range.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/swing_twist.hpp"

namespace lutka::animation {
namespace {

quat inRangesAxes(const SwingTwistRange& range, const quat& parentFromJoint) {
    return glm::conjugate(range.parentFromNeutral) * parentFromJoint * range.jointFromNeutral;
}

// 1 on the ellipse.
float swingShare(const SwingTwistRange& range, const vec3& swing) {
    return std::hypot(swing.y / range.mostSwingY, swing.z / range.mostSwingZ);
}

}  // namespace

quat clampedTo(const SwingTwistRange& range, const quat& parentFromJoint) {
    SwingTwist parts = swingTwist(inRangesAxes(range, parentFromJoint));
    const float share = swingShare(range, parts.swing);
    const float twist = std::clamp(parts.twist, range.leastTwist, range.mostTwist);
    if (share <= 1.0F && twist == parts.twist) return parentFromJoint;
    if (share > 1.0F) parts.swing /= share;
    const quat within = rotationOf({parts.swing, twist});
    return glm::normalize(range.parentFromNeutral * within * glm::conjugate(range.jointFromNeutral));
}

float excessOf(const SwingTwistRange& range, const quat& parentFromJoint) {
    const SwingTwist parts = swingTwist(inRangesAxes(range, parentFromJoint));
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
