#include "animation/pose.hpp"

#include <glm/geometric.hpp>

#include "animation/clip.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::animation;

TEST_CASE("model space goes to local and back without loss") {
    const Skeleton skeleton = test::makeBiped().skeleton;
    std::vector<RigidTransform> local = skeleton.nodeParentFromJoint;
    for (std::size_t joint = 0; joint < local.size(); ++joint) {
        local[joint].rotation = glm::angleAxis(0.1F * static_cast<float>(joint), glm::normalize(vec3(1, 2, 3)));
    }
    std::vector<RigidTransform> model(local.size());
    std::vector<RigidTransform> back(local.size());
    localToModel(skeleton, local, model);
    modelToLocal(skeleton, model, back);
    for (std::size_t joint = 0; joint < local.size(); ++joint) {
        CHECK(glm::distance(back[joint].translation, local[joint].translation) < 1e-5F);
        CHECK(std::abs(glm::dot(back[joint].rotation, local[joint].rotation)) > 0.99999F);
    }
}

TEST_CASE("a turned parent carries its children around") {
    const Skeleton skeleton = test::makeSkeleton({{"a", -1, {0, 0, 0}}, {"b", 0, {1, 0, 0}}, {"c", 1, {2, 0, 0}}});
    std::vector<RigidTransform> pose = skeleton.nodeParentFromJoint;
    pose[0].rotation = glm::angleAxis(kPi / 2, vec3(0, 0, 1));
    localToModel(skeleton, pose, pose);
    CHECK(glm::distance(pose[2].translation, vec3(0, 2, 0)) < 1e-6F);
}

TEST_CASE("a clip is read at its frames, between them and clamped beyond its ends") {
    Clip clip{"slide", 10.0F, 3, {}, {}};
    for (const float x : {0.0F, 1.0F, 4.0F})
        clip.parentFromJoint.push_back({quat(1, 0, 0, 0), {x, 0, 0}});
    CHECK(clip.seconds() == Approx(0.2F));
    const auto at = [&](float seconds) {
        std::vector<RigidTransform> pose(1);
        sampleClip(clip, seconds, pose);
        return pose[0].translation.x;
    };
    CHECK(at(0.1F) == Approx(1.0F));
    CHECK(at(0.15F) == Approx(2.5F));
    CHECK(at(-1.0F) == 0.0F);
    CHECK(at(9.0F) == 4.0F);
}
