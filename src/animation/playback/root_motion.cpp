#include "animation/playback/root_motion.hpp"

#include <glm/geometric.hpp>

#include "animation/pose.hpp"

namespace lutka::animation {

RigidTransform groundFrame(const Skeleton& skeleton, const RootMotionSettings& settings,
                           std::span<const RigidTransform> parentFromJoint, float firstHeight) {
    RigidTransform ground;
    if (settings.joint == kNoJoint) return ground;
    const RigidTransform frame = modelFrameOf(skeleton, parentFromJoint, settings.joint);
    const vec3& up = settings.up;
    const float height = glm::dot(frame.translation, up);
    if (settings.horizontal) ground.translation = frame.translation - up * height;
    if (settings.vertical) ground.translation += up * (height - firstHeight);
    if (settings.turn) {
        // The twist about `up`: what is left of the rotation when the tilt is taken away.
        const quat turned = frame.rotation * glm::conjugate(skeleton.bindModelFromJoint[settings.joint].rotation);
        const float along = glm::dot(vec3(turned.x, turned.y, turned.z), up);
        const float length = std::sqrt(along * along + turned.w * turned.w);
        // Upside down there is no heading.
        if (length > 1e-6F) ground.rotation = quat(turned.w / length, up * (along / length));
    }
    return ground;
}

RigidTransform powerOf(RigidTransform transform, long long times) {
    RigidTransform out;
    for (; times > 0; times /= 2) {
        if (times % 2 == 1) out = out * transform;
        transform = transform * transform;
        transform.rotation = glm::normalize(transform.rotation);
    }
    out.rotation = glm::normalize(out.rotation);
    return out;
}

}  // namespace lutka::animation
