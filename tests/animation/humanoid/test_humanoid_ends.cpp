#include <string>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "placed_joints.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

// Names that tell the end of a bone, and ornaments beside the neck.
namespace lutka::test {
namespace {

using animation::HumanoidMap;
using animation::Role;

// A trunk with arms of three joints; legs are the test's own. Returns the hips.
int addUpperBody(PlacedJoints& rig) {
    const int hips = rig.add("Hips", -1, {0, 0.95F, 0});
    const int chest = rig.add("Chest", rig.add("Spine", hips, {0, 1.1F, 0}), {0, 1.25F, 0});
    rig.add("Head", rig.add("Neck", chest, {0, 1.45F, 0}), {0, 1.55F, 0});
    for (const int side : {0, 1}) {
        const std::string end = side == 0 ? ".L" : ".R";
        const int arm = rig.add("UpperArm" + end, chest, onSide({0.18F, 1.4F, 0}, side));
        const int forearm = rig.add("LowerArm" + end, arm, onSide({0.45F, 1.4F, 0}, side));
        rig.add("Hand" + end, forearm, onSide({0.7F, 1.4F, 0}, side));
    }
    return hips;
}

}  // namespace

TEST_CASE("bones that are called by the joint at their end are the parts that they are", "[named]") {
    PlacedJoints rig;
    const int hips = rig.add("Bone", -1, {0, 0.45F, 0});
    const int neck = rig.add("Neck", hips, {0, 0.86F, 0});
    rig.add("Head", neck, {0, 0.98F, 0});
    std::vector<std::string> wanted;
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? ".l" : ".r";
        const auto at = [&](float x, float y, float z = 0.0F) { return vec3(side * x, y, z); };
        const int shoulder = rig.add("Shoulder" + end, hips, at(0, 0.86F));
        const int arm = rig.add("Elbow" + end, shoulder, at(0.237F, 0.865F));
        const int forearm = rig.add("Wrist" + end, arm, at(0.394F, 0.816F, -0.02F));
        const int hand = rig.add("Hand" + end, forearm, at(0.567F, 0.773F));
        rig.add("Fingers" + end, hand, at(0.686F, 0.775F));
        const int thigh = rig.add("Thigh" + end, hips, at(0.105F, 0.423F));
        const int shin = rig.add("Ankle" + end, thigh, at(0.099F, 0.248F, 0.033F));
        rig.add("Foot" + end, shin, at(0.092F, 0.07F, 0.02F));
    }
    const HumanoidMap map = rig.map(true);
    REQUIRE(map.humanoid);
    const auto nameOf = [&](Role role) {
        const int joint = map.jointOf(role);
        return joint == animation::kNoJoint ? std::string("none") : rig.joints[static_cast<std::size_t>(joint)].name;
    };
    CHECK(nameOf(Role::leftShoulder) == "Shoulder.l");
    CHECK(nameOf(Role::leftUpperArm) == "Elbow.l");
    CHECK(nameOf(Role::leftLowerArm) == "Wrist.l");
    CHECK(nameOf(Role::leftHand) == "Hand.l");
    CHECK(nameOf(Role::rightUpperLeg) == "Thigh.r");
    CHECK(nameOf(Role::rightLowerLeg) == "Ankle.r");
    CHECK(nameOf(Role::rightFoot) == "Foot.r");
}

TEST_CASE("a long hand beyond the wrist shifts no names where the shoulder is the arm's own joint", "[named]") {
    PlacedJoints rig;
    const int hips = rig.add("Joint_Hips", -1, {0, 0.8F, 0});
    const int chest = rig.add("Joint_Chest", rig.add("Joint_Spine", hips, {0, 0.95F, 0}), {0, 1.1F, 0});
    rig.add("Joint_Head", rig.add("Joint_Neck", chest, {0, 1.3F, 0}), {0, 1.4F, 0});
    for (const int side : {0, 1}) {
        const std::string end = side == 0 ? "_L" : "_R";
        const int shoulder = rig.add("Joint_Shoulder" + end, chest, onSide({0.2F, 1.25F, 0}, side));
        const int elbow = rig.add("Joint_Elbow" + end, shoulder, onSide({0.4F, 1.25F, -0.01F}, side));
        const int wrist = rig.add("Joint_Wrist" + end, elbow, onSide({0.6F, 1.25F, 0}, side));
        rig.add("Joint_Hand" + end, wrist, onSide({0.77F, 1.25F, 0}, side));
        const int hip = rig.add("Joint_Hip" + end, hips, onSide({0.1F, 0.75F, 0}, side));
        const int knee = rig.add("Joint_Knee" + end, hip, onSide({0.1F, 0.45F, 0.01F}, side));
        const int ankle = rig.add("Joint_Ankle" + end, knee, onSide({0.1F, 0.1F, 0}, side));
        rig.add("Joint_Foot" + end, ankle, onSide({0.1F, 0.02F, 0.15F}, side));
    }
    const HumanoidMap map = rig.map(true);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftUpperArm) == "Joint_Shoulder_L");
    CHECK(rig.nameOf(map, Role::leftLowerArm) == "Joint_Elbow_L");
    CHECK(rig.nameOf(map, Role::rightHand) == "Joint_Wrist_R");
    CHECK(rig.nameOf(map, Role::rightUpperLeg) == "Joint_Hip_R");
    CHECK(rig.nameOf(map, Role::rightFoot) == "Joint_Ankle_R");
}

TEST_CASE("a wrist in the middle of a forearm shifts no names where all parts have theirs", "[named]") {
    PlacedJoints rig;
    const int hips = rig.add("hips", -1, {0, 0.78F, 0});
    const int chest = rig.add("chest", rig.add("waist", hips, {0, 0.9F, 0}), {0, 1.02F, 0});
    rig.add("head", rig.add("neck", chest, {0, 1.15F, 0.03F}), {0, 1.25F, 0.08F});
    std::vector<int> left;
    for (const float side : {1.0F, -1.0F}) {
        const std::string start = side > 0.0F ? "l" : "r";
        const auto at = [&](float x, float y, float z = 0.0F) { return vec3(side * x, y, z); };
        const int arm = rig.add(start + "uparm", chest, at(0.139F, 1.099F));
        const int forearm = rig.add(start + "loarm", arm, at(0.353F, 1.0F, -0.06F));
        const int wrist = rig.add(start + "wrist", forearm, at(0.412F, 0.963F, -0.05F));
        const int hand = rig.add(start + "hand", wrist, at(0.527F, 0.871F, 0.03F));
        rig.add(start + "middle1", hand, at(0.596F, 0.798F, 0.07F));
        const int thigh = rig.add(start + "upleg", hips, at(0.095F, 0.74F));
        const int shin = rig.add(start + "loleg", thigh, at(0.131F, 0.448F, 0.1F));
        rig.add(start + "ankle", shin, at(0.141F, 0.1F));
        if (side > 0.0F) left = {arm, forearm, thigh, shin};
    }
    const HumanoidMap map = rig.map(true);
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::leftUpperArm) == left[0]);
    CHECK(map.jointOf(Role::leftLowerArm) == left[1]);
    CHECK(map.jointOf(Role::leftUpperLeg) == left[2]);
    CHECK(map.jointOf(Role::leftLowerLeg) == left[3]);
}

TEST_CASE("a neck in the middle but for rounding is no pair with a rope that hangs as far aside", "[named]") {
    PlacedJoints rig;
    const int hips = rig.add("Hips", -1, {0, 1.036F, 0});
    const int chest = rig.add("Spine1", rig.add("Spine", hips, {0, 1.15F, 0}), {0, 1.377F, -0.014F});
    const int neck = rig.add("Neck", chest, {1e-6F, 1.694F, -0.076F});
    const int head = rig.add("Head", neck, {1e-6F, 1.853F, -0.043F});
    const int back = rig.add("BackRope1", chest, {-0.19F, 1.488F, -0.233F});
    rig.add("BackRope3", rig.add("BackRope2", back, {-0.19F, 1.34F, -0.215F}), {-0.19F, 1.201F, -0.2F});
    for (const float side : {1.0F, -1.0F}) {
        const std::string name = side > 0.0F ? "Left" : "Right";
        const auto at = [&](float x, float y, float z = 0.0F) { return vec3(side * x, y, z); };
        const int shoulder = rig.add(name + "Shoulder", chest, at(0.078F, 1.639F, -0.096F));
        const int arm = rig.add(name + "Arm", shoulder, at(0.236F, 1.576F, -0.109F));
        rig.add(name + "Hand", rig.add(name + "ForeArm", arm, at(0.458F, 1.576F, -0.109F)), at(0.74F, 1.576F, -0.109F));
        const int thigh = rig.add(name + "UpLeg", hips, at(0.116F, 0.954F));
        const int foot = rig.add(name + "Foot", rig.add(name + "Leg", thigh, at(0.116F, 0.541F)), at(0.116F, 0.128F));
        rig.add(name + "ToeBase", foot, at(0.119F, 0, 0.103F));
    }
    const HumanoidMap map = rig.map(false);
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::neck) == neck);
    CHECK(map.jointOf(Role::head) == head);
}

TEST_CASE("a last bone with its parent's name and a number is the foot, and half a shin is none", "[named]") {
    for (const bool isWhole : {true, false}) {
        CAPTURE(isWhole);
        PlacedJoints rig;
        const int hips = addUpperBody(rig);
        for (const int side : {0, 1}) {
            const std::string end = side == 0 ? ".L" : ".R";
            const int thigh = rig.add("UpperLeg" + end, hips, onSide({0.1F, 0.9F, 0}, side));
            const int shin = rig.add("LowerLeg" + end, thigh, onSide({0.1F, 0.5F, 0.01F}, side));
            rig.add("LowerLeg" + end + ".001", shin, onSide({0.1F, isWhole ? 0.08F : 0.28F, 0}, side));
        }
        const HumanoidMap map = rig.map(true);
        REQUIRE(map.humanoid);
        CHECK(rig.nameOf(map, Role::rightLowerLeg) == "LowerLeg.R");
        CHECK(rig.nameOf(map, Role::leftFoot) == (isWhole ? "LowerLeg.L.001" : "none"));
    }
}

TEST_CASE("feet below a robe, without legs, do not make a figure none", "[named]") {
    PlacedJoints rig;
    const int hips = addUpperBody(rig);
    for (const int side : {0, 1})
        rig.add(side == 0 ? "Foot.L" : "Foot.R", hips, onSide({0.1F, 0.08F, 0}, side));
    const HumanoidMap map = rig.map(true);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftHand) == "Hand.L");
    CHECK_FALSE(map[Role::leftUpperLeg]);
}

}  // namespace lutka::test
