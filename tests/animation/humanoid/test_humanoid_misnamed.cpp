#include <string>
#include <utility>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "animation/humanoid/rig_features.hpp"
#include "placed_joints.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

// Joints whose names tell a part of the body, but not by its own word; and what wears or holds such names.
namespace lutka::test {
namespace {

using animation::HumanoidMap;
using animation::Role;

struct BipedTrunk {
    int hips;
    int chest;
};

BipedTrunk addBipedTrunk(PlacedJoints& rig) {
    const int hips = rig.add("Pelvis", -1, {0, 0.95F, 0});
    const int chest = rig.add("Spine1", rig.add("Spine", hips, {0, 1.05F, 0}), {0, 1.25F, 0});
    rig.add("Head", rig.add("Neck", chest, {0, 1.45F, 0}), {0, 1.55F, 0});
    return {hips, chest};
}

void addBipedLegs(PlacedJoints& rig, int hips) {
    for (const float side : {1.0F, -1.0F}) {
        const std::string start = side > 0.0F ? "L " : "R ";
        const int thigh = rig.add(start + "Thigh", hips, {side * 0.1F, 0.93F, 0});
        const int shin = rig.add(start + "Calf", thigh, {side * 0.1F, 0.5F, 0.01F});
        rig.add(start + "Foot", shin, {side * 0.1F, 0.08F, 0});
    }
}

// The arm of a biped whose language has one word for collarbone and arm, in a pose: the one is stretched, the other
// bent. It may end in a hand.
void addCountedArms(PlacedJoints& rig, int chest, bool hands) {
    for (const float side : {1.0F, -1.0F}) {
        const std::string start = side > 0.0F ? "Bip01 L " : "Bip01 R ";
        const auto at = [&](float x, float y, float z) { return vec3(side * x, y, z); };
        const float bend = side > 0.0F ? 1.0F : 0.0F;
        const int collar = rig.add(start + "Arm", chest, at(0.1F, 1.42F, 0));
        const int upper = rig.add(start + "Arm1", collar, at(0.2F, 1.4F, 0), 0.0F);
        const int fore = rig.add(start + "Arm2", upper, at(0.42F - 0.15F * bend, 1.36F - 0.2F * bend, 0), 0.0F);
        if (hands) rig.add(start + "Hand", fore, at(0.66F - 0.35F * bend, 1.33F - 0.4F * bend, 0.08F * bend), 0.0F);
    }
}

// Parts of a figure that are boxes without a skin, each on a node of its own.
struct BlockFigure {
    PlacedJoints rig;
    animation::Character figure;

    void box(int joint, const vec3& low, const vec3& high) {
        animation::SkinnedMesh mesh;
        mesh.rigid = true;
        for (int corner = 0; corner < 8; ++corner)
            mesh.positions.emplace_back((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                                        (corner & 4) != 0 ? high.z : low.z);
        mesh.joints.assign(8, {static_cast<std::uint16_t>(joint), 0, 0, 0});
        mesh.weights.assign(8, {1, 0, 0, 0});
        mesh.indices = {0, 1, 2};
        figure.meshes.push_back(std::move(mesh));
    }

    HumanoidMap map() {
        figure.skeleton = makeSkeleton(rig.joints);
        figure.skeleton.skinWeight.assign(rig.joints.size(), 0.0F);
        for (const animation::SkinnedMesh& mesh : figure.meshes)
            figure.skeleton.skinWeight[mesh.joints.front()[0]] += 8.0F;
        return animation::mapHumanoid(figure);
    }
};

// A figure of blocks whose legs and arms, of one joint each, are called foot and hand.
PlacedJoints blocksOfEnds(bool wholeLimbs) {
    PlacedJoints rig;
    const int hips = rig.add("hip", -1, {0, 0.6F, 0});
    const int torso = rig.add("torso", hips, {0, 0.62F, 0});
    rig.add("head", torso, {0, 1.3F, 0});
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? "_L" : "_R";
        rig.add("hand" + end, torso, {side * (wholeLimbs ? 0.3F : 0.55F), wholeLimbs ? 1.2F : 0.75F, 0});
        rig.add("foot" + end, hips, {side * 0.15F, wholeLimbs ? 0.57F : 0.08F, 0});
    }
    return rig;
}

HumanoidMap mapBlocks(const PlacedJoints& rig, bool wholeLimbs) {
    std::vector<TubeSpec> skin{{0, {0, 0.75F, 0}, 0.2F}, {1, {0, 1.3F, 0}, 0.25F}, {2, {0, 1.7F, 0}, 0.22F}};
    for (int joint = 3; joint < static_cast<int>(rig.joints.size()); ++joint) {
        const vec3& place = rig.placeOf(joint);
        const bool hand = rig.joints[static_cast<std::size_t>(joint)].name.find("hand") == 0;
        skin.push_back({joint, place - vec3(0, wholeLimbs ? place.y - (hand ? 0.55F : 0.0F) : 0.08F, 0), 0.09F});
    }
    return animation::mapHumanoid(makeFigure("blocks", rig.joints, skin));
}

}  // namespace

TEST_CASE("arms that are counted from the collarbone on begin at the second joint", "[misnamed]") {
    for (const bool hands : {true, false}) {
        PlacedJoints rig;
        const BipedTrunk trunk = addBipedTrunk(rig);
        addBipedLegs(rig, trunk.hips);
        addCountedArms(rig, trunk.chest, hands);
        const HumanoidMap map = rig.map(true);
        REQUIRE(map.humanoid);
        CHECK(rig.nameOf(map, Role::leftShoulder) == "Bip01 L Arm");
        CHECK(rig.nameOf(map, Role::leftUpperArm) == "Bip01 L Arm1");
        CHECK(rig.nameOf(map, Role::leftLowerArm) == "Bip01 L Arm2");
        CHECK(rig.nameOf(map, Role::rightUpperArm) == "Bip01 R Arm1");
        CHECK(rig.nameOf(map, Role::rightHand) == (hands ? "Bip01 R Hand" : "none"));
    }
}

TEST_CASE("counted arms below a shoulder begin at the first joint", "[misnamed]") {
    // As Blender numbers the bones that it splits one arm into.
    for (const bool shoulders : {true, false}) {
        INFO("shoulders: " << shoulders);
        PlacedJoints rig;
        const BipedTrunk trunk = addBipedTrunk(rig);
        addBipedLegs(rig, trunk.hips);
        for (const float side : {1.0F, -1.0F}) {
            const std::string end = side > 0.0F ? ".L" : ".R";
            const auto at = [&](float x) { return vec3(side * x, 1.42F, 0); };
            const int top = shoulders ? rig.add("Shoulder" + end, trunk.chest, at(0.04F)) : trunk.chest;
            const int arm = rig.add("Arm" + end, top, at(0.18F));
            const int second = rig.add("Arm" + end + ".001", arm, at(0.46F));
            const int third = rig.add("Arm" + end + ".002", second, at(0.6F));
            rig.add("Hand" + end, third, at(0.73F));
        }
        const HumanoidMap map = rig.map(true);
        REQUIRE(map.humanoid);
        CHECK(rig.nameOf(map, Role::leftUpperArm) == "Arm.L");
        CHECK(rig.nameOf(map, Role::leftHand) == "Hand.L");
        CHECK(rig.nameOf(map, Role::rightShoulder) == (shoulders ? "Shoulder.R" : "none"));
    }
}

TEST_CASE("a block from the hip to the floor is the leg, though it is called foot, and so is an arm", "[misnamed]") {
    const PlacedJoints whole = blocksOfEnds(true);
    const HumanoidMap limbs = mapBlocks(whole, true);
    REQUIRE(limbs.humanoid);
    CHECK(whole.nameOf(limbs, Role::leftUpperLeg) == "foot_L");
    CHECK(whole.nameOf(limbs, Role::rightUpperArm) == "hand_R");
    CHECK_FALSE(limbs[Role::leftFoot]);
    CHECK_FALSE(limbs[Role::rightHand]);
}

TEST_CASE("sleeves and trousers beside the limbs of a figure of blocks are worn", "[misnamed]") {
    // Layers of a block game's figure: their nodes lie at the origin, their boxes around the limb's.
    BlockFigure made;
    PlacedJoints& rig = made.rig;
    const int waist = rig.add("waist", rig.add("root", -1, {0, 0, 0}), {0, 0.75F, 0});
    const int body = rig.add("body", waist, {0, 1.5F, 0});
    made.box(rig.add("body", body, {0, 0, 0}), {-0.25F, 0.75F, -0.12F}, {0.25F, 1.5F, 0.12F});
    const int head = rig.add("head", body, {0, 1.5F, 0});
    made.box(rig.add("head", head, {0, 0, 0}), {-0.25F, 1.5F, -0.25F}, {0.25F, 2.0F, 0.25F});
    for (const float side : {1.0F, -1.0F}) {
        const std::string start = side > 0.0F ? "left" : "right";
        const auto layers = [&](int group, const char* limb, const char* cloth, const vec3& middle) {
            const vec3 half(0.12F, 0.37F, 0.12F);
            made.box(rig.add(start + limb, group, {0, 0, 0}), middle - half, middle + half);
            made.box(rig.add(start + cloth, group, {0, 0, 0}), middle - half * 1.05F, middle + half * 1.05F);
        };
        layers(rig.add(start + "Arm", body, {side * 0.31F, 1.35F, 0}), "Arm", "Sleeve", {side * 0.37F, 1.12F, 0});
        layers(rig.add(start + "Leg", waist, {side * 0.12F, 0.75F, 0}), "Leg", "Pants", {side * 0.12F, 0.37F, 0});
    }
    const HumanoidMap map = made.map();
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftUpperArm) == "leftArm");
    CHECK(rig.nameOf(map, Role::leftLowerArm) == "none");
    CHECK(rig.nameOf(map, Role::rightUpperLeg) == "rightLeg");
    CHECK(rig.nameOf(map, Role::rightLowerLeg) == "none");
}

TEST_CASE("trousers beside arms, and a shirt beside a head, are worn by none of them", "[misnamed]") {
    // Boxes side by side on one node, as a flat figure's.
    BlockFigure made;
    PlacedJoints& rig = made.rig;
    const int root = rig.add("root", -1, {0, 0, 0});
    const auto box = [&](const std::string& name, const vec3& joint) {
        const vec3 half(0.12F, 0.3F, 0.12F);
        made.box(rig.add(name, root, joint), joint - half, joint + half);
    };
    box("Shirt", {0, 1.1F, 0});
    box("Head", {0, 1.8F, 0});
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? "_L" : "_R";
        box("Pants" + end, {side * 0.13F, 0.4F, 0});
        box("Arm" + end, {side * 0.38F, 1.2F, 0});
        box("Sleeve" + end, {side * 0.38F, 1.2F, 0});
    }
    made.map();
    const animation::RigFeatures features = animation::readRig(made.figure, true);
    for (int joint = 0; joint < features.count(); ++joint) {
        const std::string& name = rig.joints[static_cast<std::size_t>(joint)].name;
        INFO(name);
        CHECK(features.names[joint].helper == (name.find("Sleeve") == 0));
    }
}

TEST_CASE("a jaw that carries the head is no neck", "[misnamed]") {
    PlacedJoints rig;
    const int hips = rig.add("Body", -1, {0, 0.9F, 0});
    const int chest = rig.add("Body-Upper", hips, {0, 1.1F, 0});
    rig.add("Head", rig.add("Jaw", chest, {0, 1.4F, 0}), {0, 1.48F, 0});
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? "-L" : "-R";
        const int arm = rig.add("Arm" + end, chest, {side * 0.25F, 1.35F, 0});
        rig.add("Arm" + end + ":Bend", arm, {side * 0.27F, 0.95F, 0});
        const int leg = rig.add("Leg" + end, hips, {side * 0.1F, 0.88F, 0});
        rig.add("Leg" + end + ":Bend", leg, {side * 0.1F, 0.45F, 0});
    }
    const HumanoidMap map = rig.map(true);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::head) == "Head");
    CHECK(rig.nameOf(map, Role::neck) == "none");
}

TEST_CASE("what a player's own hands hold is no pair of legs", "[misnamed][refusal]") {
    // The skeleton of a man of which only the hands are seen, and a pet with two legs and a head in one of them.
    PlacedJoints rig;
    const BipedTrunk trunk = addBipedTrunk(rig);
    for (const float side : {1.0F, -1.0F}) {
        const std::string start = side > 0.0F ? "Bip01 L " : "Bip01 R ";
        const auto at = [&](float x, float y, float z) { return vec3(side * x, y, z); };
        const int collar = rig.add(start + "Clavicle", trunk.chest, at(0.05F, 1.42F, 0), 0.0F);
        const int arm = rig.add(start + "UpperArm", collar, at(0.2F, 1.4F, 0), 0.0F);
        const int hand =
            rig.add(start + "Hand", rig.add(start + "Forearm", arm, at(0.24F, 1.12F, 0.05F)), at(0.2F, 0.95F, 0.22F));
        if (side > 0.0F) continue;
        const int pet = rig.add("Bip02 Pelvis", hand, {-0.16F, 0.9F, 0.26F});
        for (const float leg : {1.0F, -1.0F}) {
            const std::string name = leg > 0.0F ? "Bip02 L " : "Bip02 R ";
            const int thigh = rig.add(name + "Thigh", pet, {-0.16F + leg * 0.06F, 0.88F, 0.26F});
            rig.add(name + "Calf", thigh, {-0.16F + leg * 0.07F, 0.7F, 0.27F});
        }
    }
    const HumanoidMap map = rig.map(true);
    REQUIRE_FALSE(map.humanoid);
    CHECK(map.warnings.front().find("hang on one of the arms") != std::string::npos);
}

TEST_CASE("a small beast on splayed legs is none, though its joints have a man's names", "[misnamed][refusal]") {
    std::vector<JointSpec> joints{{"Bip01 Pelvis", -1, {0, 0.33F, -0.17F}},
                                  {"Bip01 Spine", 0, {0, 0.52F, -0.28F}},
                                  {"Bip01 Neck", 1, {0, 0.53F, 0.3F}},
                                  {"Bip01 Head", 2, {0, 0.53F, 0.35F}}};
    std::vector<TubeSpec> skin{{0, {0, 0.45F, -0.25F}, 0.1F},
                               {1, {0, 0.5F, 0.3F}, 0.2F},
                               {2, {0, 0.5F, 0.36F}, 0.15F},
                               {3, {0, 0.5F, 0.6F}, 0.12F}};
    for (const float side : {1.0F, -1.0F}) {
        const std::string start = side > 0.0F ? "Bip01 L " : "Bip01 R ";
        const auto add = [&](const char* name, int parent, const vec3& place, const vec3& tip) {
            const vec3 mirrored(side, 1, 1);
            joints.push_back({start + name, parent, place * mirrored});
            const int joint = static_cast<int>(joints.size()) - 1;
            skin.push_back({joint, tip * mirrored, 0.03F});
            return joint;
        };
        const int thigh = add("Thigh", 0, {0.19F, 0.33F, -0.17F}, {0.33F, 0.28F, -0.26F});
        add("Calf", thigh, {0.33F, 0.28F, -0.26F}, {0.42F, 0.03F, -0.34F});
        const int collar = add("Clavicle", 2, {0.07F, 0.31F, 0.14F}, {0.16F, 0.31F, 0.13F});
        const int arm = add("UpperArm", collar, {0.17F, 0.31F, 0.13F}, {0.32F, 0.28F, 0.19F});
        add("Forearm", arm, {0.32F, 0.28F, 0.19F}, {0.42F, 0.03F, 0.24F});
    }
    const HumanoidMap map = animation::mapHumanoid(makeFigure("snark", joints, skin));
    CHECK_FALSE(map.humanoid);
}

TEST_CASE("a man who crawls is one, though his limbs have two joints each", "[misnamed]") {
    std::vector<JointSpec> joints{{"Bip01 Pelvis", -1, {0, 0.4F, 0}},
                                  {"Bip01 Spine", 0, {0, 0.44F, 0.25F}},
                                  {"Bip01 Neck", 1, {0, 0.48F, 0.5F}},
                                  {"Bip01 Head", 2, {0, 0.5F, 0.58F}}};
    std::vector<TubeSpec> skin{{0, {0, 0.42F, 0.1F}, 0.15F},
                               {1, {0, 0.46F, 0.4F}, 0.17F},
                               {2, {0, 0.5F, 0.56F}, 0.07F},
                               {3, {0, 0.52F, 0.8F}, 0.1F}};
    for (const float side : {1.0F, -1.0F}) {
        const std::string start = side > 0.0F ? "Bip01 L " : "Bip01 R ";
        const auto add = [&](const char* name, int parent, const vec3& place, const vec3& tip) {
            const vec3 mirrored(side, 1, 1);
            joints.push_back({start + name, parent, place * mirrored});
            const int joint = static_cast<int>(joints.size()) - 1;
            skin.push_back({joint, tip * mirrored, 0.05F});
            return joint;
        };
        const int thigh = add("Thigh", 0, {0.1F, 0.4F, 0}, {0.35F, 0.25F, 0.1F});
        add("Calf", thigh, {0.35F, 0.25F, 0.1F}, {0.5F, 0.02F, -0.25F});
        const int collar = add("Clavicle", 2, {0.05F, 0.47F, 0.45F}, {0.17F, 0.47F, 0.45F});
        const int arm = add("UpperArm", collar, {0.18F, 0.47F, 0.45F}, {0.38F, 0.3F, 0.5F});
        add("Forearm", arm, {0.38F, 0.3F, 0.5F}, {0.5F, 0.03F, 0.55F});
    }
    const HumanoidMap map = animation::mapHumanoid(makeFigure("crawling", joints, skin));
    INFO((map.warnings.empty() ? std::string() : map.warnings.front()));
    CHECK(map.humanoid);
}

TEST_CASE("the end of an arm that has no part's name takes nothing from names that tell the sides", "[misnamed]") {
    // Its shins lean back, and so do its soles, though the figure faces +Z, as all its names say.
    std::vector<JointSpec> joints{{"Torso", -1, {0, 0.69F, 0}}, {"Chest", 0, {0, 1.1F, 0}}, {"Head", 1, {0, 1.5F, 0}}};
    std::vector<TubeSpec> skin{{0, {0, 1.1F, 0}, 0.2F}, {1, {0, 1.5F, 0}, 0.25F}, {2, {0, 1.95F, 0}, 0.25F}};
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? "_L" : "_R";
        const auto add = [&](const char* name, int parent, const vec3& place, const vec3& tip) {
            joints.push_back({name + end, parent, place});
            const int joint = static_cast<int>(joints.size()) - 1;
            skin.push_back({joint, tip, 0.07F});
            return joint;
        };
        const vec3 elbow(side * 0.53F, 1.15F, 0);
        const vec3 wrist(side * 0.72F, 0.8F, 0);
        const int arm = add("Arm", 1, {side * 0.24F, 1.44F, 0}, elbow);
        add("Grab", add("Forearm", arm, elbow, wrist), wrist, wrist + vec3(0, -0.1F, 0));
        const vec3 knee(side * 0.3F, 0.42F, 0.06F);
        add("Shin", add("Thigh", 0, {side * 0.13F, 0.87F, 0}, knee), knee, {side * 0.34F, 0, -0.3F});
    }
    const HumanoidMap map = animation::mapHumanoid(makeFigure("zombie", joints, skin));
    REQUIRE(map.humanoid);
    const auto nameOf = [&](Role role) {
        REQUIRE(map[role]);
        return joints[static_cast<std::size_t>(map.jointOf(role))].name;
    };
    CHECK(nameOf(Role::leftUpperArm) == "Arm_L");
    CHECK(nameOf(Role::rightLowerLeg) == "Shin_R");
}

TEST_CASE("where every limb is named whole, a figure is told without a word for the hips", "[misnamed]") {
    // Cut out of a drawing: both shoulders start in one place, and both thighs.
    PlacedJoints rig;
    const int root = rig.add("root", -1, {0, 0.41F, -0.1F}, 0.0F);
    const int back = rig.add("backspine", root, {0.005F, 0.42F, 0.03F}, 180.0F);
    rig.add("head", back, {-0.015F, 0.6F, 0.02F}, 2300.0F);
    for (const float side : {1.0F, -1.0F}) {
        const bool left = side > 0.0F;
        const std::string start = left ? "left_" : "right_";
        const int shoulder = rig.add(start + "shoulder", back, {-0.015F, 0.6F, 0.02F}, 30.0F);
        const int forearm = rig.add(start + "forearm", shoulder, {left ? 0.08F : -0.1F, 0.56F, 0}, 40.0F);
        rig.add(start + "hand", forearm, {side * 0.4F, left ? 0.25F : 0.28F, -0.01F}, 900.0F);
        const int leg = rig.add(start + "leg", root, {0.005F, 0.42F, 0.03F}, 70.0F);
        const int knee = rig.add(start + "knee", leg, {left ? 0.05F : -0.09F, left ? 0.14F : 0.12F, -0.02F}, 180.0F);
        rig.add(start + "foot", knee, {side * 0.085F, left ? -0.16F : -0.14F, -0.02F}, 320.0F);
    }
    const HumanoidMap map = rig.map(true);
    INFO((map.warnings.empty() ? std::string() : map.warnings.front()));
    REQUIRE(map.humanoid);
    CHECK(map.missing.empty());
    CHECK(rig.nameOf(map, Role::leftLowerArm) == "left_forearm");
    CHECK(rig.nameOf(map, Role::rightFoot) == "right_foot");
}

TEST_CASE("hips that carry named legs keep their name, wherever a capture's first frame has them", "[misnamed]") {
    PlacedJoints rig;
    const int hips = rig.add("Hips", -1, {0, 0, 0}, 0.0F);
    // The hips are thrown half a body away from the thighs that hang on them.
    const int spine = rig.add("Spine", hips, {0, -0.08F, -0.56F}, 0.0F);
    const int chest = rig.add("Chest", spine, {0, -0.15F, -1.1F}, 0.0F);
    const int neck = rig.add("Neck", chest, {0, -0.2F, -1.6F}, 0.0F);
    rig.add("Head", neck, {0, -0.2F, -1.8F}, 0.0F);
    for (const float side : {1.0F, -1.0F}) {
        const std::string start = side > 0.0F ? "Left" : "Right";
        int joint = rig.add(start + "Shoulder", chest, {side * 0.05F, -0.2F, -1.5F}, 0.0F);
        joint = rig.add(start + "Arm", joint, {side * 0.2F, -0.2F, -1.5F}, 0.0F);
        joint = rig.add(start + "ForeArm", joint, {side * 0.5F, -0.2F, -1.45F}, 0.0F);
        rig.add(start + "Hand", joint, {side * 0.75F, -0.15F, -1.4F}, 0.0F);
        joint = rig.add(start + "UpLeg", hips, {side * 0.1F, -0.08F, -0.56F}, 0.0F);
        joint = rig.add(start + "Leg", joint, {side * 0.12F, 0.1F, -0.1F}, 0.0F);
        rig.add(start + "Foot", joint, {side * 0.12F, 0.1F, 0.4F}, 0.0F);
    }
    const HumanoidMap map = rig.map(false);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::hips) == "Hips");
    CHECK(rig.nameOf(map, Role::spine) == "Spine");
    CHECK(rig.nameOf(map, Role::rightFoot) == "RightFoot");
}

namespace {

// A figure whose arms hang on a shoulder each: what `addArm` puts below one.
template <typename AddArm>
HumanoidMap figureWithArms(PlacedJoints& rig, AddArm addArm) {
    const BipedTrunk trunk = addBipedTrunk(rig);
    addBipedLegs(rig, trunk.hips);
    for (const float side : {1.0F, -1.0F})
        addArm(trunk.chest, side);
    return rig.map(true);
}

}  // namespace

TEST_CASE("what an elbow points at makes no upper arm of the shoulder that it hangs on", "[misnamed]") {
    PlacedJoints rig;
    const HumanoidMap map = figureWithArms(rig, [&](int chest, float side) {
        const std::string end = side > 0.0F ? ".L" : ".R";
        const int shoulder = rig.add("ombro" + end, chest, {side * 0.017F, 1.42F, 0});
        rig.add("cotovelo" + end, shoulder, {side * 0.3F, 1.41F, -0.3F}, 0.0F);
        const int upper = rig.add("braco" + end, shoulder, {side * 0.06F, 1.41F, 0});
        const int fore = rig.add("antebraco" + end, upper, {side * 0.3F, 1.41F, 0});
        rig.add("mao" + end, fore, {side * 0.58F, 1.41F, 0});
    });
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftShoulder) == "ombro.L");
    CHECK(rig.nameOf(map, Role::leftUpperArm) == "braco.L");
    CHECK(rig.nameOf(map, Role::leftLowerArm) == "antebraco.L");
    CHECK(rig.nameOf(map, Role::rightUpperArm) == "braco.R");
}

TEST_CASE("an elbow beside what stands for the arm's volume still makes the shoulder the upper arm", "[misnamed]") {
    PlacedJoints rig;
    const HumanoidMap map = figureWithArms(rig, [&](int chest, float side) {
        const std::string end = side > 0.0F ? "Left" : "Right";
        const int collar = rig.add("mCollar" + end, chest, {side * 0.04F, 1.42F, 0}, 0.0F);
        const int shoulder = rig.add("mShoulder" + end, collar, {side * 0.15F, 1.42F, 0}, 0.0F);
        rig.add((side > 0.0F ? "L" : "R") + std::string("_UPPER_ARM"), shoulder, {side * 0.2F, 1.42F, 0});
        const int elbow = rig.add("mElbow" + end, shoulder, {side * 0.4F, 1.42F, 0}, 0.0F);
        rig.add((side > 0.0F ? "L" : "R") + std::string("_LOWER_ARM"), elbow, {side * 0.45F, 1.42F, 0});
        rig.add("mWrist" + end, elbow, {side * 0.65F, 1.42F, 0});
    });
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftUpperArm) == "mShoulderLeft");
    CHECK(rig.nameOf(map, Role::leftLowerArm) == "mElbowLeft");
}

TEST_CASE("a forearm between a shoulder and an arm is the upper arm", "[misnamed]") {
    PlacedJoints rig;
    const HumanoidMap map = figureWithArms(rig, [&](int chest, float side) {
        const std::string start = side > 0.0F ? "Left" : "Right";
        const int shoulder = rig.add(start + "Shoulder", chest, {0, 1.42F, 0});
        const int upper = rig.add(start + "Forearm", shoulder, {side * 0.18F, 1.42F, 0});
        rig.add(start + "Arm", upper, {side * 0.18F, 1.14F, 0});
    });
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftShoulder) == "LeftShoulder");
    CHECK(rig.nameOf(map, Role::leftUpperArm) == "LeftForearm");
    CHECK(rig.nameOf(map, Role::leftLowerArm) == "LeftArm");
    CHECK(rig.nameOf(map, Role::rightLowerArm) == "RightArm");
}

TEST_CASE("a head by its name is the head, though the trunk moves its skin", "[misnamed]") {
    PlacedJoints rig;
    const int hips = rig.add("Hips", -1, {0, 0.888F, 0});
    const int spine = rig.add("Spine", hips, {0, 0.962F, 0}, 900.0F);
    rig.add("Head", spine, {0, 1.457F, 0}, 0.0F);
    for (const float side : {1.0F, -1.0F}) {
        const std::string start = side > 0.0F ? "Left" : "Right";
        const int thigh = rig.add(start + "UpLeg", hips, {side * 0.105F, 0.785F, 0});
        rig.add(start + "Foot", rig.add(start + "Leg", thigh, {side * 0.105F, 0.478F, 0}), {side * 0.105F, 0.131F, 0});
        const int arm = rig.add(start + "Arm", spine, {side * 0.265F, 1.253F, 0});
        rig.add(start + "Hand", rig.add(start + "ForeArm", arm, {side * 0.526F, 1.253F, 0}),
                {side * 0.742F, 1.253F, 0});
    }
    const HumanoidMap map = rig.map(true);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::head) == "Head");
    CHECK(rig.nameOf(map, Role::spine) == "Spine");
}

}  // namespace lutka::test
