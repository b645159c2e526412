#include <string>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "animation/humanoid/rig_features.hpp"
#include "placed_joints.hpp"
#include "support/catch.hpp"

// What a shoulder, an arm and a forearm are called, against how they hang.
namespace lutka::test {
namespace {

using animation::HumanoidMap;
using animation::Role;

struct Limb {
    std::string end;  // of the names
    float side;       // 1 on the left, -1 on the right
    int chest;
    int upper;  // "Shoulder", on the chest
    int fore;   // on it
};

// A biped whose arms start at a joint called shoulder and go on in one of that name. `addMore` adds to each arm.
template <class AddMore>
HumanoidMap figureWithShoulders(PlacedJoints& rig, const std::string& fore, const AddMore& addMore) {
    const int hips = rig.add("Hips", -1, {0, 1, 0});
    const int chest = rig.add("Chest", rig.add("Spine", hips, {0, 1.15F, 0}), {0, 1.3F, 0});
    rig.add("Head", rig.add("Neck", chest, {0, 1.5F, 0}), {0, 1.6F, 0});
    for (const float side : {1.0F, -1.0F}) {
        Limb arm{side > 0.0F ? "_L" : "_R", side, chest, 0, 0};
        arm.upper = rig.add("Shoulder" + arm.end, chest, {side * 0.18F, 1.45F, 0});
        arm.fore = rig.add(fore + arm.end, arm.upper, {side * 0.46F, 1.45F, 0});
        addMore(arm);
        const int thigh = rig.add("Thigh" + arm.end, hips, {side * 0.1F, 0.95F, 0});
        const int shin = rig.add("Shin" + arm.end, thigh, {side * 0.1F, 0.53F, 0});
        rig.add("Foot" + arm.end, shin, {side * 0.1F, 0.11F, -0.02F});
    }
    return rig.map(true);
}

}  // namespace

TEST_CASE("a forearm that a hand hangs on stays the forearm, whatever else hangs there called arm", "[shoulders]") {
    PlacedJoints rig;
    const HumanoidMap map = figureWithShoulders(rig, "ForeArm", [&](const Limb& arm) {
        rig.add("Hand" + arm.end, arm.fore, {arm.side * 0.72F, 1.45F, 0});
        rig.add("Arm" + arm.end, arm.fore, {arm.side * 0.59F, 1.45F, 0});
    });
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftUpperArm) == "Shoulder_L");
    CHECK(rig.nameOf(map, Role::leftLowerArm) == "ForeArm_L");
    CHECK(rig.nameOf(map, Role::leftHand) == "Hand_L");
    CHECK(rig.nameOf(map, Role::rightLowerArm) == "ForeArm_R");
}

TEST_CASE("a forearm that goes on in more skin than what hangs there called arm stays the forearm", "[shoulders]") {
    PlacedJoints rig;
    const HumanoidMap map = figureWithShoulders(rig, "ForeArm", [&](const Limb& arm) {
        rig.add("End" + arm.end, arm.fore, {arm.side * 0.72F, 1.45F, 0});
        rig.add("Arm" + arm.end, arm.fore, {arm.side * 0.59F, 1.45F, 0}, 20.0F);
    });
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftUpperArm) == "Shoulder_L");
    CHECK(rig.nameOf(map, Role::leftLowerArm) == "ForeArm_L");
    CHECK(rig.nameOf(map, Role::rightLowerArm) == "ForeArm_R");
}

TEST_CASE("a pad beside a shoulder does not settle that what hangs on the shoulder is the upper arm", "[shoulders]") {
    for (const char* pad : {"ShoulderPad", "Shoulder1", "ShoulderDeform"}) {
        INFO(pad);
        PlacedJoints rig;
        const HumanoidMap map = figureWithShoulders(rig, "Arm", [&](const Limb& arm) {
            rig.add("Hand" + arm.end, arm.fore, {arm.side * 0.72F, 1.45F, 0});
            rig.add(pad + arm.end, arm.chest, {arm.side * 0.12F, 1.46F, 0});
        });
        REQUIRE(map.humanoid);
        CHECK(rig.nameOf(map, Role::leftUpperArm) == "Shoulder_L");
        CHECK(rig.nameOf(map, Role::leftLowerArm) == "Arm_L");
        CHECK(rig.nameOf(map, Role::rightUpperArm) == "Shoulder_R");
        animation::Character character;
        character.skeleton = makeSkeleton(rig.joints);
        character.skeleton.skinWeight = rig.skin;
        const animation::RigFeatures read = animation::readRig(character, true);
        for (int joint = 0; joint < read.count(); ++joint) {
            const std::string& name = rig.joints[static_cast<std::size_t>(joint)].name;
            INFO(name);
            constexpr float kSure = 4.0F;
            if (name.find(pad) == 0) CHECK(read.names[joint].parts[animation::Part::clavicle] < kSure);
        }
    }
}

TEST_CASE("a shoulder that no joint hangs on, beside the arm, is the clavicle", "[shoulders]") {
    // On the arm's own parent, or on a joint of the trunk where the arm hangs on a control.
    for (const bool flat : {true, false}) {
        INFO(flat);
        PlacedJoints rig;
        const int root = rig.add("master", -1, {0, 0, 0}, 0.0F);
        const int chest = rig.add("Chest", root, {0, 1.3F, 0});
        const int left = rig.add("Shoulder_L", chest, {0.05F, 1.45F, 0});
        const int arm = rig.add("Arm_L", flat ? chest : root, {0.18F, 1.45F, 0});
        rig.add("ForeArm_L", arm, {0.46F, 1.45F, 0});
        animation::Character character;
        character.skeleton = makeSkeleton(rig.joints);
        character.skeleton.skinWeight = rig.skin;
        const animation::RigFeatures read = animation::readRig(character, true);
        constexpr float kSure = 4.0F;
        CHECK(read.names[left].parts[animation::Part::clavicle] >= kSure);
        CHECK(read.names[arm].parts[animation::Part::upperArm] >= kSure);
    }
}

}  // namespace lutka::test
