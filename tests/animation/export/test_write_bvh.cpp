#include "animation/export/write_bvh.hpp"

#include <fstream>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "animation/import/bvh/bvh_document.hpp"
#include "animation/pose.hpp"
#include "core/random.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;
using rig_import::bvh::BvhDocument;

namespace {

// Poses of any turns, with bind poses that are turned, too.
Clip anyPoses(Skeleton& skeleton, int frames, bool stretches) {
    Random random(7);
    const auto anyTurn = [&](float most) {
        const vec3 axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1F, 1));
        return glm::angleAxis(random.uniform(-most, most), glm::normalize(axis));
    };
    for (RigidTransform& bind : skeleton.bindModelFromJoint)
        bind.rotation = anyTurn(3.0F);
    std::vector<RigidTransform> local(skeleton.parents.size());
    modelToLocal(skeleton, skeleton.bindModelFromJoint, local);
    Clip clip;
    clip.framesPerSecond = 30.0F;
    clip.frameCount = frames;
    for (int frame = 0; frame < frames; ++frame) {
        std::vector<RigidTransform> pose = local;
        for (RigidTransform& joint : pose)
            joint.rotation = joint.rotation * anyTurn(3.1F);
        pose[0].translation += vec3(static_cast<float>(frame), 0.5F, 0);
        if (stretches) pose[4].translation.y += 0.1F;
        clip.parentFromJoint.append(pose);
    }
    return clip;
}

std::vector<vec3> worldPositions(const BvhDocument& document, std::size_t frame) {
    std::vector<glm::dmat4> world;
    std::vector<vec3> out;
    for (std::size_t joint = 0; joint < document.joints.size(); ++joint) {
        const glm::dmat4 own = document.parentFromJoint(joint, frame);
        const int parent = document.joints[joint].parent;
        world.push_back(parent < 0 ? own : world[static_cast<std::size_t>(parent)] * own);
        out.emplace_back(vec3(world.back()[3]) / 100.0F);
    }
    return out;
}

// Reads what was written and compares where each joint is, by its name.
void checkPlaces(const Skeleton& skeleton, const Clip& clip, const RigidTransform& worldFromModel) {
    const auto document = rig_import::bvh::parseBvh(bvhText(skeleton, clip, worldFromModel), "made here");
    if (!document) FAIL(document.error().text());
    std::vector<RigidTransform> pose(skeleton.parents.size());
    for (int frame = 0; frame < clip.frameCount; ++frame) {
        const std::vector<vec3> got = worldPositions(document.value(), static_cast<std::size_t>(frame));
        localToModel(skeleton,
                     std::span(clip.parentFromJoint.data(), clip.parentFromJoint.size())
                         .subspan(static_cast<std::size_t>(frame) * pose.size(), pose.size()),
                     pose);
        int found = 0;
        for (std::size_t i = 0; i < got.size(); ++i) {
            const auto joint = std::find(skeleton.names.begin(), skeleton.names.end(), document.value().joints[i].name);
            if (joint == skeleton.names.end()) continue;
            ++found;
            const vec3 wanted =
                worldFromModel * pose[static_cast<std::size_t>(joint - skeleton.names.begin())].translation;
            CHECK(glm::distance(got[i], wanted) < 1e-4F);
        }
        CHECK(found == skeleton.jointCount());
    }
}

}  // namespace

TEST_CASE("a clip read back from BVH has every joint where it was, whatever the axes of the bind pose") {
    Skeleton skeleton = makeBiped().skeleton;
    const Clip clip = anyPoses(skeleton, 20, false);
    checkPlaces(skeleton, clip, {});
    checkPlaces(skeleton, clip, {glm::angleAxis(1.1F, glm::normalize(vec3(1, 2, 3))), vec3(4, 5, 6)});
}

TEST_CASE("a joint whose translation moves has position channels in BVH") {
    Skeleton skeleton = makeBiped().skeleton;
    checkPlaces(skeleton, anyPoses(skeleton, 3, true), {});
}

TEST_CASE("all angles are 0 in the bind pose, and the rate is the clip's") {
    Skeleton skeleton = makeBiped().skeleton;
    anyPoses(skeleton, 1, false);  // turns the bind pose
    std::vector<RigidTransform> local(skeleton.parents.size());
    modelToLocal(skeleton, skeleton.bindModelFromJoint, local);
    Clip clip;
    clip.framesPerSecond = 24.0F;
    clip.frameCount = 1;
    clip.parentFromJoint.append(local);
    const auto document = rig_import::bvh::parseBvh(bvhText(skeleton, clip), "made here");
    REQUIRE(document);
    CHECK_THAT(bvhText(skeleton, clip), Catch::Contains("Frame Time: 0.04166667"));
    const auto& values = document.value().frames;
    for (std::size_t i = 3; i < values.size(); ++i)
        CHECK(values[i] == Approx(0).margin(1e-3));
}

TEST_CASE(
    "names that BVH can't hold, names that are there twice and several roots are written so that all can be read") {
    Skeleton skeleton = makeSkeleton({{"two words", -1, {0, 1, 0}},
                                      {"{", 0, {0, 2, 0}},
                                      {"same", 0, {1, 1, 0}},
                                      {"same", -1, {3, 0, 0}},
                                      {"", 3, {3, 1, 0}}});
    const Clip clip = anyPoses(skeleton, 2, false);
    const auto document = rig_import::bvh::parseBvh(bvhText(skeleton, clip), "made here");
    if (!document) FAIL(document.error().text());
    std::vector<std::string> names;
    for (const auto& joint : document.value().joints)
        names.push_back(joint.name);
    for (const char* name : {"root", "two_words", "_", "same", "same_2", "joint"})
        CHECK(std::count(names.begin(), names.end(), name) == 1);
    CHECK(document.value().frames.size() == 2 * document.value().channelCount);
}
