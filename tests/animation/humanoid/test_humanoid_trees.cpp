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

}  // namespace lutka::test
