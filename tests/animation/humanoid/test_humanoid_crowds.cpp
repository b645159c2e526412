#include <algorithm>
#include <string>
#include <vector>

#include "animation/humanoid/crowds.hpp"
#include "animation/humanoid/map_humanoid.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

// Scenes of many parts: what the mapper looks at grows with the figure, not with what stands beside it.
namespace lutka::test {
namespace {

using animation::Role;

}  // namespace

TEST_CASE("a figure in a scene of sixty thousand parts is read without them", "[crowds]") {
    const animation::Character alone = makeBiped();
    for (const char* name : {"part_", "head_of_a_bolt_"}) {
        animation::Character scene = alone;
        addParts(scene, 60000, name);
        const auto few = animation::leaveOutCrowds(scene, {});
        REQUIRE(few);
        CHECK(few->character.skeleton.jointCount() == alone.skeleton.jointCount() + 1);
        CHECK(few->character.meshes.size() == alone.meshes.size());
        const animation::HumanoidMap map = animation::mapHumanoid(scene);
        REQUIRE(map.humanoid);
        const animation::HumanoidMap expected = animation::mapHumanoid(alone);
        for (const Role role : {Role::hips, Role::head, Role::leftHand, Role::rightFoot})
            CHECK(map.jointOf(role) == expected.jointOf(role));
    }
}

TEST_CASE("of parts in groups the groups are left out as well", "[crowds]") {
    animation::Character scene = makeBiped();
    const int figure = scene.skeleton.jointCount();
    addParts(scene, 60000, "part_", 120);
    const auto few = animation::leaveOutCrowds(scene, {});
    REQUIRE(few);
    CHECK(few->character.skeleton.jointCount() == figure + 1);
    CHECK(animation::mapHumanoid(scene).humanoid);
}

TEST_CASE("crowds that hang on crowds are left out at once", "[crowds]") {
    // As many parts side by side as just make a crowd, on one of them as many more, and so on.
    animation::Character scene = makeBiped();
    const int figure = scene.skeleton.jointCount();
    constexpr int kLevels = 12;
    for (int level = 0; level < kLevels; ++level) {
        const int top = level == 0 ? 0 : scene.skeleton.jointCount() - 1;
        for (int part = 0; part < 256; ++part) {
            scene.skeleton.names.push_back("part_" + std::to_string(level) + "_" + std::to_string(part));
            scene.skeleton.parents.push_back(top);
            scene.skeleton.bindModelFromJoint.push_back(scene.skeleton.bindModelFromJoint[0]);
            scene.skeleton.nodeParentFromJoint.push_back(RigidTransform{});
            scene.skeleton.skinWeight.push_back(0.0F);
        }
    }
    const auto few = animation::leaveOutCrowds(scene, {});
    REQUIRE(few);
    CHECK(few->character.skeleton.jointCount() == figure + 256);  // too few are left to be a scene
    CHECK_FALSE(animation::leaveOutCrowds(few->character, {}));
    CHECK(animation::mapHumanoid(scene).humanoid);
}

TEST_CASE("a refusal tells once how many parts were left out, though they hang on each other", "[crowds]") {
    animation::Character scene;
    scene.skeleton = makeSkeleton({{"root", -1, {0, 0, 0}}});
    scene.skeleton.skinWeight.assign(1, 0.0F);
    addParts(scene, 50000, "part_", 100);
    const animation::HumanoidMap map = animation::mapHumanoid(scene);
    REQUIRE_FALSE(map.warnings.empty());
    const std::string& reason = map.warnings.front();
    INFO(reason);
    const std::size_t first = reason.find("(without ");
    REQUIRE(first != std::string::npos);
    CHECK(reason.find("(without ", first + 1) == std::string::npos);
}

TEST_CASE("of hundreds of parts those stay that are named as the body's, or that the user fixed", "[crowds]") {
    animation::Character scene = makeBiped();
    const int figure = scene.skeleton.jointCount();
    addParts(scene, 900, "part_");
    scene.skeleton.names[static_cast<std::size_t>(figure) + 5] = "left_hand_shell";
    const int fixed = figure + 700;
    const auto few = animation::leaveOutCrowds(scene, {fixed});
    REQUIRE(few);
    CHECK(few->character.skeleton.jointCount() == figure + 3);
    CHECK(few->original.back() == fixed);
    animation::MapOptions options;
    options.fixed[animation::indexOf(Role::leftToes)] = fixed;
    const animation::HumanoidMap map = animation::mapHumanoid(scene, options);
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::leftToes) == fixed);
}

TEST_CASE("limbs of rigid parts that hang beside a crowd are none of it", "[crowds]") {
    // A figure of blocks, and as many bolts on its root as are a multitude: below 4,096 joints and above.
    for (const bool named : {true, false}) {
        for (const int bolts : {named ? 3000 : 600, 5000}) {
            INFO(bolts << " bolts, named: " << named);
            std::vector<JointSpec> joints{{"root", -1, {0, 0, 0}}};
            const auto add = [&](const std::string& name, int parent, const vec3& place) {
                joints.push_back({named ? name : "Object_" + std::to_string(joints.size()), parent, place});
                return static_cast<int>(joints.size()) - 1;
            };
            add("hips", 0, {0, 0.95F, 0});
            add("torso", 0, {0, 1.2F, 0});
            add("head", 0, {0, 1.6F, 0});
            std::vector<int> tops;
            for (const float side : {1.0F, -1.0F}) {
                const std::string end = side > 0.0F ? "_L" : "_R";
                const auto limb = [&](const char* upper, const char* lower, const char* last, vec3 at, vec3 step) {
                    tops.push_back(add(upper + end, 0, at));
                    add(last + end, add(lower + end, tops.back(), at + step), at + 2.0F * step);
                };
                limb("upper_arm", "forearm", "hand", {side * 0.2F, 1.4F, 0}, {side * 0.27F, 0, 0});
                limb("thigh", "shin", "foot", {side * 0.1F, 0.9F, 0}, {0, -0.42F, 0.01F});
            }
            const int figure = static_cast<int>(joints.size());
            for (int bolt = 0; bolt < bolts; ++bolt)
                joints.push_back({"bolt_" + std::to_string(bolt), 0, {0.001F * static_cast<float>(bolt), 0, 1}});
            animation::Character scene;
            scene.skeleton = makeSkeleton(joints);
            scene.skeleton.skinWeight.assign(joints.size(), 0.0F);
            const auto few = animation::leaveOutCrowds(scene, {}, named);
            REQUIRE(few);
            CHECK(few->character.skeleton.jointCount() <= figure);
            for (const int top : tops) {
                for (int joint = top; joint < top + 3; ++joint)
                    CHECK(std::binary_search(few->original.begin(), few->original.end(), joint));
            }
            if (named) CHECK(animation::mapHumanoid(scene).humanoid);
        }
    }
}

TEST_CASE("a figure of rigid parts, with many beside it, keeps all of its own", "[crowds]") {
    animation::Character scene = makeBiped();
    addParts(scene, 200, "part_");
    CHECK_FALSE(animation::leaveOutCrowds(scene, {}));
}

}  // namespace lutka::test
