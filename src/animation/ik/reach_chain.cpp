#include "animation/ik/reach_chain.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "core/assert.hpp"

namespace lutka::animation {
namespace {

// Whole turns curl the joints by the tip and leave the others; half turns share the way out, and come to the target
// slowly, so that the last passes turn all the way.
constexpr float kFirstGain = 0.5F;
constexpr float kNoArm = 1e-5F;  // metres: a point this near to a joint gives it no direction

// The part of the shortest rotation from one direction to the other.
quat partBetween(const vec3& from, const vec3& to, float part) {
    const vec3 turn = rotationVector(rotationBetween(from, to)) * part;
    const float angle = glm::length(turn);
    return angle > 1e-9F ? glm::angleAxis(angle, turn / angle) : quat(1, 0, 0, 0);
}

float lengthOf(const Skeleton& skeleton, const ReachChain& chain, std::span<const RigidTransform> pose,
               const vec3& tip) {
    float length = 0.0F;
    vec3 last = modelFrameOf(skeleton, pose, chain.joints[0]).translation;
    for (std::size_t i = 1; i < chain.joints.size(); ++i) {
        const vec3 next = modelFrameOf(skeleton, pose, chain.joints[i]).translation;
        length += glm::distance(last, next);
        last = next;
    }
    return length + glm::distance(last, tip);
}

}  // namespace

Reached solveReachChain(const Skeleton& skeleton, const ReachChain& chain, const vec3& target,
                        std::span<RigidTransform> parentFromJoint, const ReachSettings& settings) {
    LUTKA_ASSERT(!chain.joints.empty() && isAncestorOrSelf(skeleton, chain.joints.back(), chain.tip));
    LUTKA_ASSERT(chain.ranges.empty() || chain.ranges.size() == chain.joints.size());
    LUTKA_ASSERT(chain.stiffness.empty() || chain.stiffness.size() == chain.joints.size());
    LUTKA_ASSERT(isFinite(target));
    vec3 tip = modelFrameOf(skeleton, parentFromJoint, chain.tip) * chain.pointInTip;
    const vec3 start = modelFrameOf(skeleton, parentFromJoint, chain.joints[0]).translation;
    const float length = lengthOf(skeleton, chain, parentFromJoint, tip);
    const float way = glm::distance(target, start);
    vec3 aim = target;
    if (way > kNoArm)
        aim = start + (target - start) * (softlyClamped(way, -length, length, settings.softness * length) / way);
    for (int pass = 0; pass < settings.mostPasses && glm::distance(tip, aim) > settings.toleranceM; ++pass) {
        const float gain = 2 * pass < settings.mostPasses ? kFirstGain : 1.0F;
        for (std::size_t i = chain.joints.size(); i-- > 0;) {
            const RigidTransform frame = modelFrameOf(skeleton, parentFromJoint, chain.joints[i]);
            const vec3 toTip = tip - frame.translation;
            const vec3 toAim = aim - frame.translation;
            if (glm::length(toTip) < kNoArm || glm::length(toAim) < kNoArm) continue;
            const float part = gain * (chain.stiffness.empty() ? 1.0F : 1.0F - chain.stiffness[i]);
            const quat turned = partBetween(toTip, toAim, part) * frame.rotation;
            RigidTransform& local = parentFromJoint[chain.joints[i]];
            const quat modelFromParent = frame.rotation * glm::conjugate(local.rotation);
            local.rotation = glm::normalize(glm::conjugate(modelFromParent) * turned);
            if (!chain.ranges.empty()) local.rotation = clampedTo(chain.ranges[i], local.rotation);
            tip = frame.translation + modelFromParent * local.rotation * (glm::conjugate(frame.rotation) * toTip);
        }
    }
    return {glm::distance(modelFrameOf(skeleton, parentFromJoint, chain.tip) * chain.pointInTip, target)};
}

}  // namespace lutka::animation
