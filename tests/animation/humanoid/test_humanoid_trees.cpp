#include <string>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

// Figures without names whose tree of joints starts further up than at the hips.
namespace lutka::test {
namespace {

using animation::HumanoidMap;
using animation::Role;

struct Rig {
    std::vector<JointSpec> joints;
    std::vector<TubeSpec> skin;

    // A joint called by its number, whose skin reaches to `end`.
    int add(int parent, const vec3& place, const vec3& end, float radius) {
        joints.push_back({"joint" + std::to_string(joints.size()), parent, place});
        skin.push_back({static_cast<int>(joints.size()) - 1, end, radius});
        return static_cast<int>(joints.size()) - 1;
    }
};

HumanoidMap mapOf(const Rig& rig) {
    HumanoidMap map = animation::mapHumanoid(makeFigure("figure", rig.joints, rig.skin));
    INFO((map.warnings.empty() ? std::string() : map.warnings.front()));
    REQUIRE(map.humanoid);
    return map;
}

vec3 onSide(float side, float x, float y, float z = 0.0F) {
    return {side * x, y, z};
}

}  // namespace

TEST_CASE("blocks without names whose root is the chest are a figure, and the corners at a limb's end no part of it",
          "[trees][blocks]") {
    constexpr float kCorners = 0.02F;
    Rig rig;
    const int chest = rig.add(-1, {0, 1.07F, 0}, {0, 0.7F, 0}, 0.18F);
    const int hips = rig.add(chest, {0, 0.64F, 0}, {0, 0.5F, 0}, 0.16F);
    const int head = rig.add(chest, {0, 1.28F, 0}, {0, 1.7F, 0}, 0.17F);
    std::vector<int> arms;
    std::vector<int> legs;
    for (const float side : {1.0F, -1.0F}) {
        arms.push_back(rig.add(chest, onSide(side, 0.22F, 1.07F), onSide(side, 0.22F, 0.68F), 0.06F));
        rig.add(arms.back(), onSide(side, 0.22F, 0.66F), onSide(side, 0.22F, 0.66F - kCorners), 0.06F);
        legs.push_back(rig.add(hips, onSide(side, 0.07F, 0.52F), onSide(side, 0.07F, 0.06F), 0.06F));
        rig.add(legs.back(), onSide(side, 0.07F, 0.03F), onSide(side, 0.07F, 0.03F - kCorners), 0.06F);
    }
    const HumanoidMap map = mapOf(rig);
    CHECK(map.jointOf(Role::hips) == hips);
    CHECK(map.jointOf(Role::head) == head);
    CHECK(map.jointOf(Role::leftUpperArm) + map.jointOf(Role::rightUpperArm) == arms[0] + arms[1]);
    CHECK(map.jointOf(Role::leftUpperLeg) + map.jointOf(Role::rightUpperLeg) == legs[0] + legs[1]);
    for (const Role role : {Role::leftLowerArm, Role::leftHand, Role::leftLowerLeg, Role::leftFoot})
        CHECK(map.jointOf(role) == animation::kNoJoint);
}

TEST_CASE("a large head that the whole trunk hangs on is the head, without a name", "[trees]") {
    Rig rig;
    const int head = rig.add(-1, {0, 1.56F, -0.25F}, {0, 1.15F, 0.2F}, 0.4F);
    const int chest = rig.add(head, {0, 0.9F, 0}, {0, 0.5F, 0}, 0.12F);
    const int hips = rig.add(chest, {0, 0.43F, 0}, {0, 0.38F, 0}, 0.12F);
    for (const float side : {1.0F, -1.0F}) {
        const int arm = rig.add(chest, onSide(side, 0.12F, 0.85F), onSide(side, 0.28F, 0.7F), 0.05F);
        const int forearm = rig.add(arm, onSide(side, 0.29F, 0.69F), onSide(side, 0.42F, 0.75F), 0.05F);
        rig.add(forearm, onSide(side, 0.43F, 0.77F), onSide(side, 0.5F, 0.9F), 0.07F);
        const int thigh = rig.add(hips, onSide(side, 0.12F, 0.43F), onSide(side, 0.15F, 0.28F), 0.06F);
        const int shin = rig.add(thigh, onSide(side, 0.16F, 0.26F), onSide(side, 0.19F, 0.06F), 0.05F);
        rig.add(shin, onSide(side, 0.2F, 0.03F), onSide(side, 0.28F, 0.0F, 0.25F), 0.04F);
    }
    const HumanoidMap map = mapOf(rig);
    CHECK(map.jointOf(Role::head) == head);
    CHECK(map.jointOf(Role::hips) == hips);
    CHECK(map.missing.empty());
}

TEST_CASE("arms that start unevenly from the spine are a pair, where one is as long as the other", "[trees]") {
    Rig rig;
    const int hips = rig.add(-1, {0, 0.36F, 0}, {0, 0.62F, 0}, 0.12F);
    const int chest = rig.add(hips, {0, 0.623F, 0}, {0, 0.82F, 0}, 0.12F);
    const int head = rig.add(chest, {0, 0.824F, 0}, {0, 1.2F, 0}, 0.2F);
    std::vector<int> arms;
    for (const float side : {1.0F, -1.0F}) {
        const float start = side > 0.0F ? 0.103F : 0.17F;
        const float elbow = side > 0.0F ? 0.44F : 0.486F;
        arms.push_back(rig.add(chest, onSide(side, start, 0.745F), onSide(side, elbow, 0.655F), 0.06F));
        rig.add(arms.back(), onSide(side, elbow, 0.655F), onSide(side, elbow + 0.2F, 0.6F), 0.05F);
    }
    for (const float side : {1.0F, -1.0F}) {
        const float thigh = side > 0.0F ? 0.118F : 0.098F;
        const float knee = side > 0.0F ? 0.244F : 0.217F;
        const int leg = rig.add(hips, onSide(side, thigh, 0.31F), onSide(side, knee, -0.02F), 0.07F);
        rig.add(leg, onSide(side, knee, -0.026F), onSide(side, knee + 0.05F, -0.4F), 0.06F);
    }
    const HumanoidMap map = mapOf(rig);
    CHECK(map.jointOf(Role::head) == head);
    CHECK(map.jointOf(Role::leftUpperArm) + map.jointOf(Role::rightUpperArm) == arms[0] + arms[1]);
    CHECK(map.jointOf(Role::leftLowerArm) + map.jointOf(Role::rightLowerArm) == arms[0] + arms[1] + 2);
}

TEST_CASE("long arms without names beside short legs are no forelegs, where the trunk is straight and tall",
          "[trees][blocks]") {
    Rig rig;
    const int root = rig.add(-1, {0, 0.48F, 0}, {0, 0.8F, 0}, 0.2F);
    const int chest = rig.add(root, {0, 0.8F, 0}, {0, 1.5F, 0}, 0.35F);
    const int head = rig.add(chest, {0, 1.57F, 0}, {0, 2.0F, 0}, 0.2F);
    std::vector<int> arms;
    std::vector<int> legs;
    for (const float side : {1.0F, -1.0F}) {
        arms.push_back(rig.add(chest, onSide(side, 0.55F, 1.44F), onSide(side, 0.6F, 0.8F), 0.16F));
        rig.add(arms.back(), onSide(side, 0.6F, 0.8F), onSide(side, 0.6F, 0.17F), 0.16F);
        legs.push_back(rig.add(root, onSide(side, 0.18F, 0.47F), onSide(side, 0.18F, 0.0F), 0.12F));
    }
    const HumanoidMap map = mapOf(rig);
    CHECK(map.jointOf(Role::head) == head);
    CHECK(map.jointOf(Role::leftUpperArm) + map.jointOf(Role::rightUpperArm) == arms[0] + arms[1]);
    CHECK(map.jointOf(Role::leftUpperLeg) + map.jointOf(Role::rightUpperLeg) == legs[0] + legs[1]);
}

}  // namespace lutka::test
