#include "animation/ik/look_at.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "core/assert.hpp"

namespace lutka::animation {
namespace {

constexpr int kRounds = 3;       // the eye moves with the head
constexpr float kNoWay = 1e-5F;  // metres

quat byVector(const vec3& turn) {
    const float angle = glm::length(turn);
    return angle > 1e-9F ? glm::angleAxis(angle, turn / angle) : quat(1, 0, 0, 0);
}

// The direction that is looked into, in the base's frame: within the limits, and less of it the further behind.
vec3 allowedDirection(const LookAt& look, const vec3& wanted, const vec3& own) {
    const vec3& ahead = look.forwardInBase;
    const float angle = std::acos(std::clamp(glm::dot(ahead, wanted), -1.0F, 1.0F));
    const vec3 turn = rotationVector(rotationBetween(ahead, wanted));
    const vec3 left = glm::normalize(glm::cross(look.upInBase, ahead));
    const vec3 up = glm::cross(ahead, left);
    // How much of the limits' ellipse the turn takes.
    const float share = std::hypot(glm::dot(turn, up) / look.mostYaw, glm::dot(turn, left) / look.mostPitch);
    vec3 direction = wanted;
    if (share > 1e-6F) {
        const float soft = look.softness / std::min(look.mostYaw, look.mostPitch);
        direction = byVector(turn * (softlyClamped(share, -1.0F, 1.0F, soft) / share)) * ahead;
    }
    const float t = std::clamp((angle - look.letGo) / (kPi - look.letGo), 0.0F, 1.0F);
    const float kept = 1.0F - t * t * (3.0F - 2.0F * t);
    return byVector(rotationVector(rotationBetween(own, direction)) * kept) * own;
}

}  // namespace

float solveLookAt(const Skeleton& skeleton, const LookAt& look, const vec3& target,
                  std::span<RigidTransform> parentFromJoint, float weight) {
    LUTKA_ASSERT(!look.joints.empty() && isFinite(target));
    const int head = look.joints.back().joint;
    const int parent = skeleton.parents[look.joints.front().joint];
    const quat modelFromBase =
        parent == kNoJoint ? quat(1, 0, 0, 0) : modelFrameOf(skeleton, parentFromJoint, parent).rotation;
    const quat baseFromModel = glm::conjugate(modelFromBase);
    const vec3 ownInBase =
        baseFromModel * (modelFrameOf(skeleton, parentFromJoint, head).rotation * look.forwardInHead);
    float sum = 0.0F;
    for (const LookJoint& joint : look.joints)
        sum += joint.share;
    for (int round = 0; round < kRounds; ++round) {
        const RigidTransform frame = modelFrameOf(skeleton, parentFromJoint, head);
        const vec3 way = target - frame * look.eyeInHead;
        if (glm::length(way) < kNoWay) return 0.0F;
        const vec3 wanted = baseFromModel * glm::normalize(way);
        const vec3 allowed = allowedDirection(look, wanted, ownInBase);
        const vec3 goal = byVector(rotationVector(rotationBetween(ownInBase, allowed)) * weight) * ownInBase;
        const vec3 turn =
            rotationVector(rotationBetween(frame.rotation * look.forwardInHead, modelFromBase * goal)) / sum;
        for (const LookJoint& joint : look.joints) {
            // What is above has turned by its own share, about the same axis, so that this one adds its own.
            const RigidTransform now = modelFrameOf(skeleton, parentFromJoint, joint.joint);
            RigidTransform& local = parentFromJoint[joint.joint];
            const quat modelFromParent = now.rotation * glm::conjugate(local.rotation);
            local.rotation =
                glm::normalize(glm::conjugate(modelFromParent) * byVector(turn * joint.share) * now.rotation);
        }
    }
    const RigidTransform frame = modelFrameOf(skeleton, parentFromJoint, head);
    const vec3 way = glm::normalize(target - frame * look.eyeInHead);
    return std::acos(std::clamp(glm::dot(frame.rotation * look.forwardInHead, way), -1.0F, 1.0F));
}

}  // namespace lutka::animation
