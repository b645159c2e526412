#include "animation/export/reduce_keys.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "animation/pose.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

// A biped whose joints swing at rates of their own, for two seconds.
Clip swinging(const Skeleton& skeleton) {
    Clip clip;
    clip.framesPerSecond = 60.0F;
    clip.frameCount = 121;
    std::vector<RigidTransform> bind(skeleton.parents.size());
    modelToLocal(skeleton, skeleton.bindModelFromJoint, bind);
    for (int frame = 0; frame < clip.frameCount; ++frame) {
        const float s = static_cast<float>(frame) / 60.0F;
        std::vector<RigidTransform> pose = bind;
        pose[0].translation += vec3(0, 0.2F * std::sin(3 * s), s);
        for (std::size_t joint = 0; joint < pose.size(); joint += 2) {
            const float angle = 0.4F * std::sin(s * (1.0F + 0.3F * static_cast<float>(joint)));
            pose[joint].rotation = pose[joint].rotation * glm::angleAxis(angle, vec3(0, 0, 1));
        }
        clip.parentFromJoint.append(pose);
    }
    return clip;
}

// The pose at a frame, blended between the kept keys about it.
std::vector<RigidTransform> blended(const Skeleton& skeleton, const Clip& clip, const KeptKeys& keys, int frame) {
    const std::size_t joints = skeleton.parents.size();
    std::vector<RigidTransform> pose(joints);
    const auto around = [&](const std::vector<int>& kept) {
        const auto to = std::lower_bound(kept.begin(), kept.end(), frame);
        const int after = *to;
        const int before = *to == frame ? frame : *(to - 1);
        return std::tuple(
            before, after,
            after == before ? 0.0F : static_cast<float>(frame - before) / static_cast<float>(after - before));
    };
    for (std::size_t joint = 0; joint < joints; ++joint) {
        const auto at = [&](int f) { return clip.parentFromJoint[static_cast<std::size_t>(f) * joints + joint]; };
        const auto [r0, r1, r] = around(keys.rotations[joint]);
        const auto [t0, t1, t] = around(keys.translations[joint]);
        pose[joint] = {glm::slerp(at(r0).rotation, at(r1).rotation, r),
                       glm::mix(at(t0).translation, at(t1).translation, t)};
    }
    localToModel(skeleton, pose, pose);
    return pose;
}

std::size_t countOf(const KeptKeys& keys) {
    std::size_t count = 0;
    for (std::size_t joint = 0; joint < keys.rotations.size(); ++joint)
        count += keys.rotations[joint].size() + keys.translations[joint].size();
    return count;
}

}  // namespace

TEST_CASE("with the keys that are kept every joint stays within the tolerance in model space, at every frame") {
    const Skeleton skeleton = makeBiped().skeleton;
    const Clip clip = swinging(skeleton);
    const KeyTolerance tolerance;
    const KeptKeys keys = reduceKeys(skeleton, clip, tolerance);
    const std::size_t joints = skeleton.parents.size();
    for (int frame = 0; frame < clip.frameCount; ++frame) {
        std::vector<RigidTransform> exact(clip.parentFromJoint.data() + static_cast<std::size_t>(frame) * joints,
                                          clip.parentFromJoint.data() + static_cast<std::size_t>(frame + 1) * joints);
        localToModel(skeleton, exact, exact);
        const auto got = blended(skeleton, clip, keys, frame);
        for (std::size_t joint = 0; joint < joints; ++joint) {
            CHECK(glm::distance(got[joint].translation, exact[joint].translation) <= tolerance.metres * 1.01F);
            const quat between = glm::conjugate(got[joint].rotation) * exact[joint].rotation;
            CHECK(2.0F * glm::length(vec3(between.x, between.y, between.z)) <= tolerance.radians * 1.01F);
        }
    }
    CHECK(countOf(keys) < countOf(allKeys(skeleton, clip)) / 3);
    // A wider tolerance needs fewer.
    CHECK(countOf(reduceKeys(skeleton, clip, {1e-2F, 0.05F})) < countOf(keys));
}

TEST_CASE("the skin stays within the tolerance, too, however far it reaches from its joint") {
    Character character = makeBiped();
    const Skeleton& skeleton = character.skeleton;
    SkinnedMesh& mesh = character.meshes[0];
    mesh.positions.push_back(skeleton.bindModelFromJoint[12].translation + vec3(0, 0, 1.4F));  // a spear's tip
    mesh.joints.push_back({12, 0, 0, 0});
    mesh.weights.push_back({1, 0, 0, 0});
    const std::vector<float> reach = skinReach(character);
    CHECK(reach[12] == Approx(1.4F));
    const Clip clip = swinging(skeleton);
    const KeyTolerance tolerance;
    const KeptKeys keys = reduceKeys(skeleton, clip, tolerance, reach);
    const std::size_t joints = skeleton.parents.size();
    std::vector<RigidTransform> exact(joints);
    float most = 0.0F;
    for (int frame = 0; frame < clip.frameCount; ++frame) {
        std::copy_n(clip.parentFromJoint.data() + static_cast<std::size_t>(frame) * joints, joints, exact.begin());
        localToModel(skeleton, exact, exact);
        const auto got = blended(skeleton, clip, keys, frame);
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            vec3 off(0);
            for (std::size_t i = 0; i < 4; ++i) {
                const std::size_t joint = mesh.joints[v][i];
                const vec3 inJoint = inverse(skeleton.bindModelFromJoint[joint]) * mesh.positions[v];
                off += mesh.weights[v][i] * (got[joint] * inJoint - exact[joint] * inJoint);
            }
            most = std::max(most, glm::length(off));
        }
    }
    CHECK(most <= tolerance.metres * 1.02F);
    CHECK(countOf(keys) < countOf(allKeys(skeleton, clip)));
    CHECK(countOf(reduceKeys(skeleton, clip, tolerance)) < countOf(keys));
}

TEST_CASE("a joint at rest keeps its two ends, and one that turns evenly, too") {
    const Skeleton skeleton = makeBiped().skeleton;
    Clip clip = swinging(skeleton);
    std::vector<RigidTransform> bind(skeleton.parents.size());
    modelToLocal(skeleton, skeleton.bindModelFromJoint, bind);
    auto& frames = clip.parentFromJoint.change();
    for (int frame = 0; frame < clip.frameCount; ++frame) {
        std::copy(bind.begin(), bind.end(), frames.begin() + frame * static_cast<std::ptrdiff_t>(bind.size()));
        frames[static_cast<std::size_t>(frame) * bind.size()].rotation =
            glm::angleAxis(0.01F * static_cast<float>(frame), vec3(0, 1, 0));
    }
    const KeptKeys keys = reduceKeys(skeleton, clip, {});
    for (const auto& list : keys.rotations)
        CHECK(list == std::vector<int>{0, 120});
    CHECK(keys.translations[5] == std::vector<int>{0, 120});
}

TEST_CASE("channels that hold each frame are kept whole, and clips of one frame stay") {
    const Skeleton skeleton = makeBiped().skeleton;
    Clip clip = swinging(skeleton);
    clip.steppedRotations.assign(skeleton.parents.size(), false);
    clip.steppedRotations[3] = true;
    CHECK(reduceKeys(skeleton, clip, {}).rotations[3].size() == 121);
    Clip still;
    still.frameCount = 1;
    std::vector<RigidTransform> bind(skeleton.parents.size());
    modelToLocal(skeleton, skeleton.bindModelFromJoint, bind);
    still.parentFromJoint.append(bind);
    CHECK(reduceKeys(skeleton, still, {}).rotations[0] == std::vector<int>{0});
}
