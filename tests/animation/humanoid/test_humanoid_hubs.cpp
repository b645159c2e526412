// Trunks and heads that what hangs on a joint tells better than its name or its place.

#include <string>

#include "animation/humanoid/map_humanoid.hpp"
#include "placed_joints.hpp"
#include "support/catch.hpp"

namespace lutka::test {
namespace {

using animation::HumanoidMap;
using animation::Role;

const std::string kBothSides[] = {"Left", "Right"};

// Both legs of three joints on one, named as the parts.
void addLegs(PlacedJoints& rig, int hips, float hip) {
    for (int side = 0; side < 2; ++side) {
        const int thigh = rig.add(kBothSides[side] + "Thigh", hips, onSide({0.1F, hip, 0}, side));
        const int calf = rig.add(kBothSides[side] + "Calf", thigh, onSide({0.1F, 0.53F * hip, 0.01F}, side));
        rig.add(kBothSides[side] + "Foot", calf, onSide({0.1F, 0.08F, -0.02F}, side));
    }
}

// Both arms of three joints on one, from there to the sides, and fingers that mark their ends.
void addArms(PlacedJoints& rig, int chest, float height) {
    for (int side = 0; side < 2; ++side) {
        const int upper = rig.add(kBothSides[side] + "UpperArm", chest, onSide({0.18F, height, 0}, side));
        const int fore = rig.add(kBothSides[side] + "Forearm", upper, onSide({0.46F, height, -0.01F}, side));
        const int hand = rig.add(kBothSides[side] + "Hand", fore, onSide({0.71F, height, 0}, side));
        rig.add(kBothSides[side] + "Finger", hand, onSide({0.8F, height, 0}, side), 20.0F);
    }
}

}  // namespace

TEST_CASE("what carries both arms is the chest, however far below it they start", "[hubs]") {
    PlacedJoints rig;
    const int root = rig.add("root", -1, {0, 0, 0}, 0.0F);
    const int center = rig.add("center", root, {0, 0.48F, 0});
    const int up = rig.add("centerUp", center, {0, 0.63F, 0});
    const int sternum = rig.add("sternum", up, {0, 0.73F, 0});
    rig.add("head", sternum, {0, 0.98F, 0}, 400.0F);
    for (int side = 0; side < 2; ++side) {
        const std::string& name = kBothSides[side];
        const int shoulder = rig.add(name + "Shoulder", sternum, onSide({0.16F, 0.76F, 0}, side));
        const int upper = rig.add(name + "LowShoulder", shoulder, onSide({0.2F, 0.57F, 0}, side));
        const int elbow = rig.add(name + "Elbow", upper, onSide({0.3F, 0.44F, 0}, side));
        const int hand = rig.add(name + "Hand", elbow, onSide({0.36F, 0.35F, 0}, side));
        rig.add(name + "Fingers", hand, onSide({0.33F, 0.31F, 0}, side));
        const int hip = rig.add(name + "Hip", center, onSide({0.13F, 0.39F, 0}, side));
        const int knee = rig.add(name + "Knee", hip, onSide({0.13F, 0.24F, 0.01F}, side));
        rig.add(name + "Foot", knee, onSide({0.15F, 0.06F, 0}, side));
    }
    const HumanoidMap map = rig.map(true);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::hips) == "center");
    CHECK(rig.nameOf(map, map.jointOf(Role::chest) == animation::kNoJoint ? Role::spine : Role::chest) == "sternum");
    CHECK(rig.nameOf(map, Role::neck) == "none");
}

TEST_CASE("a joint that carries both arms is no neck, though it lies low", "[hubs]") {
    PlacedJoints rig;
    const int root = rig.add("root", -1, {0, 0, 0}, 0.0F);
    const int spine = rig.add("spine", root, {0, 0.9F, 0});
    const int high = rig.add("spinehigh", spine, {0, 1.05F, 0}, 400.0F);
    rig.add("head", high, {0, 1.5F, 0}, 200.0F);
    addLegs(rig, spine, 0.9F);
    addArms(rig, high, 1.38F);
    const HumanoidMap map = rig.map(true);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::hips) == "spine");
    CHECK(rig.nameOf(map, Role::spine) == "spinehigh");
    CHECK(rig.nameOf(map, Role::neck) == "none");
}

TEST_CASE("of hubs that are all called pelvis the one with the legs is the hips", "[hubs]") {
    PlacedJoints rig;
    const int root = rig.add("Base", -1, {0, 0, 0}, 0.0F);
    const int pelvis = rig.add("Base Pelvis", root, {0, 0.93F, 0});
    const int spine = rig.add("Base Spine", pelvis, {0, 1.0F, -0.03F});
    const int ribs = rig.add("Base Pelvis001", spine, {0, 1.22F, 0}, 900.0F);
    const int neck = rig.add("Base Spine1", ribs, {0, 1.4F, -0.02F});
    rig.add("Base Pelvis002", neck, {0, 1.62F, 0.03F}, 400.0F);
    addLegs(rig, pelvis, 0.92F);
    addArms(rig, ribs, 1.4F);
    const HumanoidMap map = rig.map(true);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::hips) == "Base Pelvis");
    CHECK(rig.nameOf(map, Role::chest) == "Base Pelvis001");
    CHECK(rig.nameOf(map, Role::neck) == "Base Spine1");
    CHECK(rig.nameOf(map, Role::head) == "Base Pelvis002");
}

TEST_CASE("a lower body above what carries the thighs is the spine's, and one that carries them the hips", "[hubs]") {
    for (const bool onRoot : {true, false}) {
        PlacedJoints rig;
        const int control = rig.add("Main_Control", -1, {0, 0, 0}, 0.0F);
        const int root = rig.add("Root_Joint", control, {0, 0.9F, 0}, onRoot ? 100.0F : 0.0F);
        const int lower = rig.add("LowerBody_Joint", root, {0, onRoot ? 1.02F : 0.95F, 0});
        const int upper = rig.add("UpperBody_Joint", lower, {0, 1.25F, 0}, 200.0F);
        const int neck = rig.add("Neck_Joint", upper, {0, 1.48F, 0});
        rig.add("Head_Joint", neck, {0, 1.58F, 0}, 300.0F);
        addLegs(rig, onRoot ? root : lower, 0.88F);
        addArms(rig, upper, 1.4F);
        const HumanoidMap map = rig.map(true);
        REQUIRE(map.humanoid);
        CHECK(rig.nameOf(map, Role::hips) == (onRoot ? "Root_Joint" : "LowerBody_Joint"));
    }
}

TEST_CASE("hips that all limbs hang on may lie before them, and the head may end a spine without a name", "[hubs]") {
    PlacedJoints rig;
    const int armature = rig.add("Armature", -1, {0, 0, 0}, 0.0F);
    const int hips = rig.add("Spine01", armature, {0, 0.49F, 0.29F}, 80.0F);
    const int middle = rig.add("Spine02", hips, {0, 0.77F, 0.04F}, 30.0F);
    const int high = rig.add("Spine03", middle, {0, 1.13F, -0.07F}, 70.0F);
    rig.add("Top02", rig.add("Top01", high, {0, 1.63F, -0.09F}, 50.0F), {0, 1.73F, -0.11F}, 50.0F);
    for (int side = 0; side < 2; ++side) {
        const std::string& name = kBothSides[side];
        const int leg = rig.add("Leg" + name + "Upper", hips, onSide({0.16F, 0.63F, 0}, side), 90.0F);
        rig.add("Leg" + name + "Lower", leg, onSide({0.19F, 0.29F, 0.03F}, side), 90.0F);
        const int arm = rig.add("Arm" + name + "Upper", hips, onSide({0.2F, 0.96F, -0.03F}, side), 90.0F);
        rig.add("Arm" + name + "Lower", arm, onSide({0.45F, 0.92F, 0.02F}, side), 90.0F);
    }
    const HumanoidMap map = rig.map(true);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::hips) == "Spine01");
    CHECK(rig.nameOf(map, Role::head).substr(0, 3) == "Top");
}

TEST_CASE("the head is the joint with the mass: no leaf before it, and no pair with what lies in its place", "[hubs]") {
    for (const bool inPlace : {true, false}) {
        PlacedJoints rig;
        const int hips = rig.add("bone000", -1, {0, 0.95F, 0}, 60.0F);
        const int spine = rig.add("bone001", hips, {0, 1.08F, 0}, 40.0F);
        const int chest = rig.add("bone002", spine, {0, 1.27F, 0}, 80.0F);
        const int neck = rig.add("bone003", chest, {0, 1.48F, 0}, 0.0F);
        const int head = rig.add("bone004", neck, {0, 1.57F, 0}, 680.0F);
        rig.add("bone005", head, {0.03F, 1.62F, 0.1F}, 30.0F);
        if (inPlace) rig.add("bone006", neck, {0, 1.57F, 0}, 300.0F);
        int count = 10;
        const auto next = [&](int parent, const vec3& place, int side) {
            return rig.add("bone0" + std::to_string(count++), parent, onSide(place, side), 50.0F);
        };
        for (int side = 0; side < 2; ++side) {
            const int thigh = next(hips, {0.11F, 0.95F, 0}, side);
            next(next(next(thigh, {0.11F, 0.53F, 0}, side), {0.11F, 0.1F, 0}, side), {0.11F, 0.04F, 0.12F}, side);
            const int upper = next(chest, {0.22F, 1.45F, 0}, side);
            next(next(upper, {0.53F, 1.45F, 0}, side), {0.74F, 1.45F, 0}, side);
        }
        const HumanoidMap map = rig.map(true);
        REQUIRE(map.humanoid);
        CHECK(rig.nameOf(map, Role::head) == "bone004");
    }
}

TEST_CASE("a helmet is the head where no joint has that name", "[hubs]") {
    for (const bool withHead : {false, true}) {
        PlacedJoints rig;
        const int hips = rig.add("Hips", -1, {0, 0.93F, 0});
        const int chest = rig.add("Chest", hips, {0, 1.2F, 0}, 300.0F);
        const int head = withHead ? rig.add("Head", chest, {0, 1.52F, 0}, 200.0F) : chest;
        rig.add("Helmet", head, {0, withHead ? 1.7F : 1.52F, 0.02F}, 200.0F);
        rig.add("Connector", chest, {0, 1.5F, -0.25F}, 200.0F);
        addLegs(rig, hips, 0.9F);
        addArms(rig, chest, 1.4F);
        const HumanoidMap map = rig.map(true);
        REQUIRE(map.humanoid);
        CHECK(rig.nameOf(map, Role::head) == (withHead ? "Head" : "Helmet"));
    }
}

TEST_CASE("legs are added to a figure whose spine is numbered from the hips on", "[hubs]") {
    PlacedJoints rig;
    int above = rig.add("metarig", -1, {0, 0, 0}, 0.0F);
    const float heights[] = {0.17F, 0.49F, 0.68F, 0.88F, 1.11F, 1.17F, 1.23F};
    int chest = above;
    for (int count = 0; count < 7; ++count) {
        const std::string number = count == 0 ? "" : ".00" + std::to_string(count);
        above = rig.add("spine" + number, above, {0, heights[count], 0}, count == 6 ? 300.0F : 60.0F);
        if (count == 3) chest = above;
    }
    for (int side = 0; side < 2; ++side) {
        const std::string end = side == 0 ? ".L" : ".R";
        const int shoulder = rig.add("shoulder" + end, chest, onSide({0.02F, 1.07F, 0.05F}, side), 40.0F);
        const int upper = rig.add("upper_arm" + end, shoulder, onSide({0.17F, 1.07F, -0.03F}, side), 40.0F);
        const int fore = rig.add("forearm" + end, upper, onSide({0.44F, 1.04F, -0.03F}, side), 40.0F);
        rig.add("hand" + end, fore, onSide({0.66F, 0.99F, -0.02F}, side), 40.0F);
        rig.add("breast" + end, chest, onSide({0.12F, 0.99F, 0.05F}, side), 30.0F);
    }
    const HumanoidMap map = rig.map(true);
    INFO((map.warnings.empty() ? std::string() : map.warnings.front()));
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::hips) == "spine");
    CHECK(rig.nameOf(map, Role::head) == "spine.006");
    CHECK(rig.nameOf(map, Role::leftUpperLeg) == "none");
}

}  // namespace lutka::test
