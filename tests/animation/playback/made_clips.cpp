#include "made_clips.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "core/random.hpp"

namespace lutka::test {

using namespace animation;

namespace {

std::vector<RigidTransform> bindLocals(const Skeleton& skeleton) {
    std::vector<RigidTransform> locals(skeleton.parents.size());
    modelToLocal(skeleton, skeleton.bindModelFromJoint, locals);
    return locals;
}

}  // namespace

Clip makeWavingClip(const Skeleton& skeleton, const std::string& name, std::uint64_t seed, const vec3& stride) {
    const std::vector<RigidTransform> rest = bindLocals(skeleton);
    Clip clip;
    clip.name = name;
    clip.frameCount = 31;
    for (int frame = 0; frame < clip.frameCount; ++frame) {
        const float phase = static_cast<float>(frame) / static_cast<float>(clip.frameCount - 1);
        Random random(seed);
        std::vector<RigidTransform> pose = rest;
        for (RigidTransform& joint : pose) {
            const vec3 axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1F, 1));
            const float angle = random.uniform(0.1F, 0.8F) * std::sin(2.0F * kPi * phase + random.uniform(0, 6));
            joint.rotation = joint.rotation * glm::angleAxis(angle, glm::normalize(axis));
        }
        pose[0].translation += stride * phase;
        clip.parentFromJoint.append(pose);
    }
    return clip;
}

Clip makeTurnedClip(const Skeleton& skeleton, const std::string& name, int joint, float angle, float seconds) {
    std::vector<RigidTransform> pose = bindLocals(skeleton);
    pose[joint].rotation = pose[joint].rotation * glm::angleAxis(angle, vec3(0, 0, 1));
    Clip clip;
    clip.name = name;
    clip.framesPerSecond = 1.0F / seconds;
    clip.frameCount = 2;
    clip.parentFromJoint.append(pose);
    clip.parentFromJoint.append(pose);
    return clip;
}

float differenceOf(std::span<const RigidTransform> a, std::span<const RigidTransform> b) {
    float worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const quat near = glm::dot(a[i].rotation, b[i].rotation) < 0.0F ? -b[i].rotation : b[i].rotation;
        worst = std::max({worst, glm::distance(a[i].translation, b[i].translation), glm::length(a[i].rotation - near)});
    }
    return worst;
}

}  // namespace lutka::test
