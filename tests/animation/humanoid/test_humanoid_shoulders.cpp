#include <string>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
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

}  // namespace lutka::test
