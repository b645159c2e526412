// Arms and hands that their length and what hangs on them tell better than their names.

#include <cmath>
#include <string>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "placed_joints.hpp"
#include "support/catch.hpp"

namespace lutka::test {
namespace {

using animation::HumanoidMap;
using animation::Role;

struct ArmJoint {
    std::string name;
    vec3 place;
};

// A trunk and legs by their names, and arms of these joints, with four fingers of two joints each at the last.
PlacedJoints withArms(const std::vector<ArmJoint>& arm, bool nameFingers = true) {
    PlacedJoints rig;
    const int hips = rig.add("hips", -1, {0, 0.93F, 0});
    const int chest = rig.add("chest", rig.add("spine", hips, {0, 1.05F, 0}), {0, 1.22F, 0}, 300.0F);
    rig.add("head", rig.add("neck", chest, {0, 1.48F, 0}), {0, 1.56F, 0}, 300.0F);
    for (int side = 0; side < 2; ++side) {
        const std::string end = side == 0 ? "_L" : "_R";
        const int thigh = rig.add("thigh" + end, hips, onSide({0.1F, 0.9F, 0}, side));
        const int shin = rig.add("shin" + end, thigh, onSide({0.1F, 0.5F, 0.01F}, side));
        rig.add("foot" + end, shin, onSide({0.1F, 0.08F, -0.02F}, side));
        int last = chest;
        for (const ArmJoint& joint : arm)
            last = rig.add(joint.name + end, last, onSide(joint.place, side));
        const vec3 hand = arm.back().place;
        for (int finger = 0; finger < 4; ++finger) {
            const float aside = 0.025F * static_cast<float>(finger) - 0.04F;
            const std::string name = (nameFingers ? "finger" : "") + std::to_string(finger) + (side == 0 ? "" : ".1");
            const int first = rig.add(name, last, onSide(hand + vec3(0.09F, 0, aside), side), 20.0F);
            rig.add(name + ".2", first, onSide(hand + vec3(0.13F, 0, aside), side), 20.0F);
        }
    }
    return rig;
}

}  // namespace

TEST_CASE("a shoulder as long as the arm, where nothing else is an elbow, is the upper arm", "[arms]") {
    for (const auto& words : {std::vector<std::string>{"shoulder", "arm", "hand"}, {"ombro", "braco", "mao"}}) {
        const PlacedJoints rig =
            withArms({{words[0], {0.19F, 1.4F, 0}}, {words[1], {0.45F, 1.4F, -0.02F}}, {words[2], {0.68F, 1.4F, 0}}});
        const HumanoidMap map = rig.map(true);
        REQUIRE(map.humanoid);
        CHECK(rig.nameOf(map, Role::leftUpperArm) == words[0] + "_L");
        CHECK(rig.nameOf(map, Role::leftLowerArm) == words[1] + "_L");
        CHECK(rig.nameOf(map, Role::rightHand) == words[2] + "_R");
        CHECK(rig.nameOf(map, Role::leftShoulder) == "none");
    }
}

TEST_CASE("a shoulder that starts at the spine or is short stays the clavicle", "[arms]") {
    for (const float start : {0.03F, 0.16F}) {
        const float arm = start < 0.1F ? 0.2F : 0.26F;
        const PlacedJoints rig =
            withArms({{"shoulder", {start, 1.4F, 0}}, {"arm", {arm, 1.4F, -0.02F}}, {"hand", {0.62F, 1.4F, 0}}});
        const HumanoidMap map = rig.map(true);
        REQUIRE(map.humanoid);
        CHECK(rig.nameOf(map, Role::leftShoulder) == "shoulder_L");
        CHECK(rig.nameOf(map, Role::leftUpperArm) == "arm_L");
    }
}

TEST_CASE("a shoulder above an arm and an elbow stays the clavicle, however long", "[arms]") {
    const PlacedJoints rig = withArms({{"shoulder", {0.1F, 1.4F, 0}},
                                       {"arm", {0.3F, 1.4F, -0.02F}},
                                       {"elbow", {0.5F, 1.4F, -0.02F}},
                                       {"hand", {0.7F, 1.4F, 0}}});
    const HumanoidMap map = rig.map(true);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftShoulder) == "shoulder_L");
    CHECK(rig.nameOf(map, Role::leftUpperArm) == "arm_L");
    CHECK(rig.nameOf(map, Role::leftLowerArm) == "elbow_L");
}

TEST_CASE("a wrist nearer to the elbow than to the hand with the fingers turns the forearm", "[arms]") {
    for (const bool near : {true, false}) {
        const PlacedJoints rig = withArms({{"uparm", {0.17F, 1.4F, 0}},
                                           {"loarm", {0.43F, 1.4F, -0.02F}},
                                           {"wrist", {near ? 0.5F : 0.64F, 1.4F, -0.01F}},
                                           {"hand", {0.68F, 1.4F, 0}}});
        const HumanoidMap map = rig.map(true);
        REQUIRE(map.humanoid);
        CHECK(rig.nameOf(map, Role::leftHand) == (near ? "hand_L" : "wrist_L"));
        CHECK(rig.nameOf(map, Role::rightLowerArm) == "loarm_R");
    }
}

TEST_CASE("what several short chains without names hang on is the hand, and none of them", "[arms]") {
    PlacedJoints rig =
        withArms({{"LH", {0.02F, 1.42F, 0}}, {"b", {0.45F, 1.35F, 0.1F}}, {"c", {0.59F, 1.35F, 0.12F}}}, false);
    const HumanoidMap map = rig.map(true);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftHand) == "c_L");
    CHECK(rig.nameOf(map, Role::rightHand) == "c_R");
}

TEST_CASE("a Portuguese foot on its control, where the leg ends, is the leg's", "[arms]") {
    PlacedJoints rig;
    const int root = rig.add("controleGeral", -1, {0, 0.08F, 0}, 0.0F);
    const int hips = rig.add("cintura", root, {0, 0.84F, 0});
    const int chest = rig.add("peito", hips, {0, 1.2F, 0}, 300.0F);
    rig.add("cabeca", rig.add("pescoco", chest, {0, 1.45F, 0}), {0, 1.5F, 0}, 300.0F);
    for (int side = 0; side < 2; ++side) {
        const std::string end = side == 0 ? "_L" : "_R.001";
        const vec3 ankle = onSide({0.09F, 0.05F, -0.03F}, side);
        const int control = rig.add("peControle" + end, root, ankle, 0.0F);
        const int foot = rig.add("pe" + end, control, ankle);
        rig.add("pe" + end + "_end", foot, onSide({0.09F, 0.02F, 0.14F}, side), 0.0F);
        const int thigh = rig.add("coxa" + end, hips, onSide({0.09F, 0.81F, 0}, side));
        const int shin = rig.add("perna" + end, thigh, onSide({0.09F, 0.47F, 0.02F}, side));
        rig.add("perna" + end + "_end", shin, ankle, 0.0F);
        const int arm = rig.add("ombro" + end, chest, onSide({0.19F, 1.37F, 0}, side));
        const int fore = rig.add("braco" + end, arm, onSide({0.45F, 1.38F, -0.03F}, side));
        rig.add("mao" + end, fore, onSide({0.68F, 1.38F, 0}, side));
    }
    const HumanoidMap map = rig.map(true);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftFoot) == "pe_L");
    CHECK(rig.nameOf(map, Role::rightFoot) == "pe_R.001");
}

}  // namespace lutka::test
