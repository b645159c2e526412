#include "animation/playback/joint_mask.hpp"

#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::animation;

TEST_CASE("the upper body is the spine and all above it, whatever hangs on its joints") {
    Character biped = test::makeBiped();
    Skeleton& skeleton = biped.skeleton;
    const HumanoidMap map = test::mapOfBiped(biped);
    // A ring on the hand and a pocket on the thigh.
    const auto hang = [&](Role role) {
        skeleton.names.emplace_back("thing");
        skeleton.parents.push_back(map.jointOf(role));
        skeleton.bindModelFromJoint.push_back(skeleton.bindModelFromJoint[map.jointOf(role)]);
        skeleton.nodeParentFromJoint.emplace_back();
        skeleton.skinWeight.push_back(0);
        return skeleton.jointCount() - 1;
    };
    const int ring = hang(Role::leftHand);
    const int pocket = hang(Role::rightUpperLeg);
    const JointMask mask = upperBodyMask(skeleton, map);
    REQUIRE(mask.weights.size() == skeleton.parents.size());
    for (const Role role : {Role::spine, Role::head, Role::leftHand, Role::rightUpperArm})
        CHECK(mask[map.jointOf(role)] == 1.0F);
    for (const Role role : {Role::hips, Role::leftFoot, Role::rightUpperLeg})
        CHECK(mask[map.jointOf(role)] == 0.0F);
    CHECK(mask[ring] == 1.0F);
    CHECK(mask[pocket] == 0.0F);
    const JointMask lower = inverted(mask, skeleton.jointCount());
    CHECK(lower[pocket] == 1.0F);
    CHECK(lower[ring] == 0.0F);
}

TEST_CASE("a mask of joints takes what hangs below them, and weights go by role") {
    const Character biped = test::makeBiped();
    const HumanoidMap map = test::mapOfBiped(biped);
    const int arm = map.jointOf(Role::leftUpperArm);
    const JointMask below = maskBelow(biped.skeleton, std::span(&arm, 1));
    CHECK(below[map.jointOf(Role::leftHand)] == 1.0F);
    CHECK(below[map.jointOf(Role::rightHand)] == 0.0F);
    std::array<float, kRoleCount> weights{};
    weights[indexOf(Role::spine)] = 0.5F;
    weights[indexOf(Role::head)] = 1.0F;
    const JointMask byRole = maskOfRoles(biped.skeleton, map, weights);
    CHECK(byRole[map.jointOf(Role::spine)] == 0.5F);
    CHECK(byRole[map.jointOf(Role::head)] == 1.0F);
    CHECK(byRole[map.jointOf(Role::hips)] == 0.0F);
    CHECK(JointMask{}[3] == 1.0F);
}
