// Words that mean something else in the place where they stand.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "placed_joints.hpp"
#include "support/catch.hpp"

namespace lutka::test {
namespace {

using animation::HumanoidMap;
using animation::Role;

constexpr float kNone = 0.0F;  // of the skin

struct Trunk {
    int hips;
    int chest;
    int head;
};

Trunk addTrunk(PlacedJoints& rig) {
    const int hips = rig.add("pelvis", -1, {0, 0.95F, 0});
    const int chest = rig.add("chest", rig.add("spine", hips, {0, 1.1F, 0}), {0, 1.25F, 0});
    return {hips, chest, rig.add("head", rig.add("neck", chest, {0, 1.45F, 0}), {0, 1.55F, 0})};
}

void addArms(PlacedJoints& rig, int chest) {
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? "_l" : "_r";
        const int upper = rig.add("upperarm" + end, chest, {side * 0.18F, 1.4F, 0});
        rig.add("hand" + end, rig.add("forearm" + end, upper, {side * 0.45F, 1.4F, 0}), {side * 0.7F, 1.4F, 0});
    }
}

void addLegs(PlacedJoints& rig, int hips) {
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? "_l" : "_r";
        const int upper = rig.add("thigh" + end, hips, {side * 0.1F, 0.9F, 0});
        const int foot =
            rig.add("foot" + end, rig.add("shin" + end, upper, {side * 0.1F, 0.5F, 0.01F}), {side * 0.1F, 0.08F, 0});
        rig.add("toe" + end, foot, {side * 0.1F, 0.02F, 0.12F});
    }
}

}  // namespace

TEST_CASE("where the foot and the hand are words for the whole limb, the third joint is the foot", "[words]") {
    PlacedJoints rig;
    const int hips = rig.add("center", -1, {0, 0.43F, 0.02F});
    const int chest = rig.add("back", rig.add("waist", hips, {0, 0.54F, 0.03F}), {0, 0.63F, 0.04F});
    rig.add("head", chest, {0, 0.74F, 0.01F});
    for (const float side : {1.0F, -1.0F}) {
        const std::string start = side > 0.0F ? "L_" : "R_";
        int joint = hips;
        const vec3 leg[] = {
            {0.05F, 0.414F, 0.02F}, {0.05F, 0.25F, 0.03F}, {0.05F, 0.1F, 0.005F}, {0.05F, 0.02F, 0.05F}};
        for (int i = 0; i < 4; ++i)
            joint = rig.add(start + "foot_" + std::to_string(i + 1), joint, leg[i] * vec3(side, 1, 1));
        joint = rig.add(start + "shoulder", chest, {side * 0.04F, 0.69F, 0});
        const vec3 arm[] = {{0.07F, 0.67F, 0}, {0.22F, 0.67F, 0}, {0.32F, 0.67F, 0}};
        for (int i = 0; i < 3; ++i)
            joint = rig.add(start + "hand_" + std::to_string(i + 1), joint, arm[i] * vec3(side, 1, 1));
    }
    const HumanoidMap map = rig.map(true);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftUpperLeg) == "L_foot_1");
    CHECK(rig.nameOf(map, Role::leftLowerLeg) == "L_foot_2");
    CHECK(rig.nameOf(map, Role::rightFoot) == "R_foot_3");
    CHECK(rig.nameOf(map, Role::rightToes) == "R_foot_4");
    CHECK(rig.nameOf(map, Role::leftUpperArm) == "L_hand_1");
    CHECK(rig.nameOf(map, Role::leftLowerArm) == "L_hand_2");
    CHECK(rig.nameOf(map, Role::rightHand) == "R_hand_3");
}

TEST_CASE("where the shin has its name, joints that are called foot stay feet", "[words]") {
    PlacedJoints rig;
    const Trunk trunk = addTrunk(rig);
    addArms(rig, trunk.chest);
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? "_l" : "_r";
        int joint = rig.add("thigh" + end, trunk.hips, {side * 0.1F, 0.9F, 0});
        joint = rig.add("shin" + end, joint, {side * 0.1F, 0.5F, 0.01F});
        for (int i = 0; i < 3; ++i) {
            const auto along = static_cast<float>(i);
            joint = rig.add("foot" + std::to_string(i + 1) + end, joint,
                            {side * 0.1F, 0.08F - 0.03F * along, 0.08F * along});
        }
    }
    const HumanoidMap map = rig.map(true);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftFoot) == "foot1_l");
    CHECK(rig.nameOf(map, Role::rightLowerLeg) == "shin_r");
}

TEST_CASE("below limbs without names, joints that are called foot and hand stay feet and hands", "[words]") {
    struct Case {
        int bonesAbove;  // of each limb, without a name
        int fingers;
    };
    for (const Case& way : {Case{2, 1}, Case{1, 1}, Case{2, 5}, Case{1, 5}}) {
        PlacedJoints rig;
        const Trunk trunk = addTrunk(rig);
        int number = 0;
        for (const float side : {1.0F, -1.0F}) {
            const std::string end = side > 0.0F ? ".L" : ".R";
            const auto limb = [&](int parent, const vec3& start, const vec3& stop) {
                for (int i = 0; i < way.bonesAbove; ++i) {
                    const float along = static_cast<float>(i) / static_cast<float>(way.bonesAbove);
                    const vec3 place = start + along * (stop - start);
                    parent = rig.add("Bone.00" + std::to_string(number++) + end, parent, place * vec3(side, 1, 1));
                }
                return parent;
            };
            const vec3 wrist(0.7F, 1.4F, 0);
            const int hand =
                rig.add("hand" + end, limb(trunk.chest, {0.18F, 1.4F, 0}, wrist), wrist * vec3(side, 1, 1));
            for (int finger = 0; finger < way.fingers; ++finger) {
                int joint = hand;
                for (int i = 0; i < 2; ++i) {
                    const vec3 place(0.8F + 0.04F * static_cast<float>(i), 1.4F, 0.02F * static_cast<float>(finger));
                    joint = rig.add("hand" + end + ".00" + std::to_string(2 * finger + i + 1), joint,
                                    place * vec3(side, 1, 1));
                }
            }
            int joint =
                rig.add("foot" + end, limb(trunk.hips, {0.1F, 0.9F, 0}, {0.1F, 0.08F, 0}), {side * 0.1F, 0.08F, 0});
            joint = rig.add("foot" + end + ".001", joint, {side * 0.1F, 0.03F, 0.1F});
            rig.add("foot" + end + ".002", joint, {side * 0.1F, 0.02F, 0.15F});
        }
        INFO(way.bonesAbove << " bones and " << way.fingers << " fingers");
        const HumanoidMap map = rig.map(true);
        REQUIRE(map.humanoid);
        CHECK(rig.nameOf(map, Role::leftFoot) == "foot.L");
        CHECK(rig.nameOf(map, Role::rightFoot) == "foot.R");
        CHECK(rig.nameOf(map, Role::leftHand) == "hand.L");
        CHECK(rig.nameOf(map, Role::rightHand) == "hand.R");
    }
}

TEST_CASE("a foot that hangs on a control with skin of its own is the foot", "[words]") {
    PlacedJoints rig;
    const Trunk trunk = addTrunk(rig);
    addArms(rig, trunk.chest);
    for (const float side : {1.0F, -1.0F}) {
        const std::string start = side > 0.0F ? "L" : "R";
        const vec3 ankle(side * 0.1F, 0.08F, 0);
        const int upper = rig.add(start + "leg", trunk.hips, {side * 0.1F, 0.9F, 0});
        rig.add(start + "leg.001", upper, {side * 0.1F, 0.5F, 0.03F});
        rig.add(start + "Feet", rig.add("IK" + start + "Leg", trunk.hips, ankle, 20.0F), ankle, 80.0F);
    }
    const HumanoidMap map = rig.map(true);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftUpperLeg) == "Lleg");
    CHECK(rig.nameOf(map, Role::leftLowerLeg) == "Lleg.001");
    CHECK(rig.nameOf(map, Role::leftFoot) == "LFeet");
    CHECK(rig.nameOf(map, Role::rightFoot) == "RFeet");
}

TEST_CASE("where heads are put on is no head", "[words]") {
    // Below the joint that is the head, as are the containers of games whose heads are exchanged.
    for (const bool skinned : {true, false}) {
        PlacedJoints rig;
        const Trunk trunk = addTrunk(rig);
        rig.add("HEAD_CONTAINER", trunk.head, {0, 1.68F, 0.05F}, kNone);
        rig.skin[static_cast<std::size_t>(trunk.head)] = kNone;
        addArms(rig, trunk.chest);
        addLegs(rig, trunk.hips);
        const HumanoidMap map = rig.map(skinned);
        REQUIRE(map.humanoid);
        CHECK(rig.nameOf(map, Role::head) == "head");
    }
}

TEST_CASE("gear on the back is no spine", "[words]") {
    PlacedJoints rig;
    const int body = rig.add("body", -1, {0, 0.69F, 0});
    rig.add("back_gear", body, {0, 1.19F, -0.19F});
    rig.add("head", body, {0, 1.31F, 0});
    addArms(rig, body);
    for (const float side : {1.0F, -1.0F}) {
        const std::string start = side > 0.0F ? "left_" : "right_";
        const int leg = rig.add(start + "leg", body, {side * 0.12F, 0.69F, 0});
        rig.add(start + "foot", rig.add(start + "knee", leg, {side * 0.12F, 0.37F, 0.06F}), {side * 0.12F, 0.02F, 0});
    }
    const HumanoidMap map = rig.map(false);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::hips) == "body");
    CHECK(rig.nameOf(map, Role::spine) == "body");
}

TEST_CASE("a runner whose shoulders turn against the hips keeps the hips that are named so", "[words]") {
    // The first frame of a clip that came without a skin: a plane askew mirrors its limbs from front to back.
    PlacedJoints rig;
    const int hips = rig.add("Hips", -1, {0.01F, 0.95F, -0.02F});
    const int spine = rig.add("Spine1", rig.add("Spine", hips, {0.01F, 1.06F, 0.02F}), {0, 1.19F, 0.09F});
    const int chest = rig.add("Spine2", spine, {-0.01F, 1.33F, 0.17F});
    rig.add("Head", rig.add("Neck", chest, {-0.02F, 1.49F, 0.27F}), {-0.03F, 1.64F, 0.36F});
    const auto limb = [&](int parent, const std::vector<std::pair<std::string, vec3>>& chain) {
        for (const auto& [name, place] : chain)
            parent = rig.add(name, parent, place);
    };
    limb(chest, {{"LeftShoulder", {0.05F, 1.46F, 0.25F}},
                 {"LeftArm", {0.19F, 1.39F, 0.25F}},
                 {"LeftForeArm", {0.3F, 1.26F, 0.08F}},
                 {"LeftHand", {0.3F, 0.99F, -0.07F}}});
    limb(chest, {{"RightShoulder", {-0.09F, 1.46F, 0.25F}},
                 {"RightArm", {-0.22F, 1.37F, 0.26F}},
                 {"RightForeArm", {-0.23F, 1.14F, 0.28F}},
                 {"RightHand", {-0.12F, 1.06F, 0.55F}}});
    limb(hips, {{"LeftUpLeg", {0.1F, 0.9F, -0.03F}},
                {"LeftLeg", {0.12F, 0.55F, 0.25F}},
                {"LeftFoot", {0.1F, 0.25F, -0.06F}},
                {"LeftToeBase", {0.11F, 0.1F, -0.04F}}});
    limb(hips, {{"RightUpLeg", {-0.08F, 0.89F, -0.01F}},
                {"RightLeg", {-0.06F, 0.5F, -0.2F}},
                {"RightFoot", {-0.03F, 0.4F, -0.6F}},
                {"RightToeBase", {-0.04F, 0.28F, -0.7F}}});
    const HumanoidMap map = rig.map(false);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::hips) == "Hips");
    CHECK(rig.nameOf(map, Role::spine) == "Spine");
    CHECK(rig.nameOf(map, Role::leftUpperLeg) == "LeftUpLeg");
    CHECK(rig.nameOf(map, Role::rightUpperArm) == "RightArm");
}

TEST_CASE("a toy that lies keeps legs that end at the second joint, which is named foot", "[words]") {
    // As a small bunny is rigged: no knees, and arms whose three joints all have names. It leans on its back.
    const auto leaning = [](float x, float along, float up) {
        return vec3(x, 0.6F * along + 0.8F * up, -0.8F * along + 0.6F * up);
    };
    PlacedJoints rig;
    const int hips = rig.add("Hips", -1, leaning(0, 0.15F, 0));
    const int spine = rig.add("Spine", hips, leaning(0, 0.34F, 0));
    const int head = rig.add("Head", spine, leaning(0, 0.57F, 0));
    std::vector<TubeSpec> skin{{spine, leaning(0, 0.55F, 0), 0.15F}, {head, leaning(0, 0.95F, 0), 0.25F}};
    for (const float side : {1.0F, -1.0F}) {
        const std::string start = side > 0.0F ? "Left" : "Right";
        const int upper = rig.add(start + "UpperArm", spine, leaning(side * 0.17F, 0.53F, -0.07F));
        const int lower = rig.add(start + "LowerArm", upper, leaning(side * 0.42F, 0.53F, -0.07F));
        const int wrist = rig.add(start + "Wrist", lower, leaning(side * 0.66F, 0.53F, -0.07F));
        const int leg = rig.add(start + "Leg", hips, leaning(side * 0.15F, 0.15F, 0.1F));
        const int foot = rig.add(start + "Foot", leg, leaning(side * 0.16F, 0.03F, 0.13F));
        for (const int joint : {upper, lower, wrist})
            skin.push_back({joint, rig.placeOf(joint) + vec3(side * 0.2F, 0, 0), 0.06F});
        skin.push_back({foot, leaning(side * 0.16F, 0, 0.2F), 0.06F});
    }
    const HumanoidMap map = animation::mapHumanoid(makeFigure("toy", rig.joints, skin));
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftUpperLeg) == "LeftLeg");
    CHECK(rig.nameOf(map, Role::leftFoot) == "LeftFoot");
    CHECK(rig.nameOf(map, Role::rightHand) == "RightWrist");
}

TEST_CASE("arms that are crossed and hang on one joint are no arm of either side", "[words]") {
    PlacedJoints rig;
    const int body = rig.add("body", -1, {0, 0.6F, 0});
    const int head = rig.add("head", body, {0, 1.21F, 0});
    const int arms = rig.add("arm", body, {-0.002F, 1.1F, 0.02F});
    std::vector<TubeSpec> skin{
        {body, {0, 1.2F, 0}, 0.2F}, {head, {0, 1.7F, 0}, 0.25F}, {arms, {0, 0.95F, 0.25F}, 0.3F}};
    for (const float side : {1.0F, -1.0F}) {
        const float x = side * 0.1F + 0.004F;
        skin.push_back({rig.add(side > 0.0F ? "leg.left" : "leg.right", body, {x, 0.55F, 0}), {x, 0, 0}, 0.1F});
    }
    const HumanoidMap map = animation::mapHumanoid(makeFigure("villager", rig.joints, skin));
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::head) == "head");
    CHECK(map[Role::leftUpperLeg]);
    CHECK(map[Role::rightUpperLeg]);
    for (const Role arm : {Role::leftUpperArm, Role::leftLowerArm, Role::leftHand, Role::rightUpperArm})
        CHECK_FALSE(map[arm]);
}

TEST_CASE("a root in the middle of the body is no root", "[words]") {
    PlacedJoints rig;
    const int hips = rig.add("LowerSpin", -1, {0, 0.95F, 0});
    const int root = rig.add("Root", rig.add("Spin", hips, {0, 1.15F, 0}), {0, 1.38F, 0}, kNone);
    rig.add("Head", root, {0, 1.55F, 0});
    addArms(rig, root);
    addLegs(rig, hips);
    const HumanoidMap map = rig.map(true);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::hips) == "LowerSpin");
    CHECK(rig.nameOf(map, Role::spine) == "Spin");
    CHECK(rig.nameOf(map, Role::head) == "Head");
}

TEST_CASE("a file's root in the middle of a figure without skin is not its hips", "[words]") {
    PlacedJoints rig;
    const int armature = rig.add("Armature", rig.add("RootNode", -1, {0, 0, 0}), {0, 0, 0});
    int number = 0;
    const auto add = [&](int parent, const vec3& place) {
        return rig.add("bone_" + std::to_string(number++), parent, place);
    };
    const int hips = add(armature, {0, 0.05F, 0});
    const int chest = add(add(hips, {0, 0.2F, 0}), {0, 0.38F, 0});
    add(add(chest, {0, 0.52F, 0}), {0, 0.6F, 0.02F});
    for (const float side : {1.0F, -1.0F}) {
        add(add(add(add(chest, {side * 0.06F, 0.48F, 0}), {side * 0.18F, 0.48F, 0}), {side * 0.45F, 0.48F, 0}),
            {side * 0.7F, 0.48F, 0});
        add(add(add(hips, {side * 0.1F, 0, 0}), {side * 0.1F, -0.42F, 0.02F}), {side * 0.1F, -0.85F, 0});
    }
    const HumanoidMap map = rig.map(false);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::hips) == "bone_0");
    CHECK(rig.nameOf(map, Role::spine) == "bone_1");
}

TEST_CASE("a block below a group that is named as a part is that part's mesh", "[words]") {
    PlacedJoints rig;
    const Trunk trunk = addTrunk(rig);
    addArms(rig, trunk.chest);
    std::vector<int> blocks;
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? "_l" : "_r";
        const int thigh = rig.add("thigh" + end, trunk.hips, {side * 0.1F, 0.9F, 0});
        const int shin = rig.add("shin" + end, thigh, {side * 0.1F, 0.5F, 0.01F});
        const int foot = rig.add("foot" + end, shin, {side * 0.1F, 0.08F, 0});
        for (const int part : {thigh, shin, foot})
            blocks.push_back(rig.add("Cube.0" + std::to_string(rig.joints.size()), part,
                                     rig.placeOf(part) + vec3(0, -0.04F, 0.12F)));
    }
    animation::Character figure;
    figure.skeleton = makeSkeleton(rig.joints);
    figure.skeleton.skinWeight.assign(rig.joints.size(), 0.0F);
    for (const int block : blocks) {
        animation::SkinnedMesh mesh;
        mesh.rigid = true;
        for (int corner = 0; corner < 8; ++corner)
            mesh.positions.push_back(rig.placeOf(block) + 0.08F * vec3(corner % 2, corner / 2 % 2, corner / 4));
        mesh.joints.assign(8, {static_cast<std::uint16_t>(block), 0, 0, 0});
        mesh.weights.assign(8, {1, 0, 0, 0});
        mesh.indices = {0, 1, 2};
        figure.skeleton.skinWeight[static_cast<std::size_t>(block)] = 8.0F;
        figure.meshes.push_back(std::move(mesh));
    }
    const HumanoidMap map = animation::mapHumanoid(figure);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftLowerLeg) == "shin_l");
    CHECK(rig.nameOf(map, Role::rightFoot) == "foot_r");
    CHECK_FALSE(map[Role::leftToes]);
    CHECK_FALSE(map[Role::rightToes]);
}

TEST_CASE("a figure's own name before all names says nothing of a joint", "[words]") {
    for (const std::string figure : {"LowMan", "Footman_", "HeadHunter", "Lower.Body."}) {
        INFO(figure);
        PlacedJoints rig;
        rig.add("RootNode", -1, {0, 0, 0}, kNone);
        const int hips = rig.add(figure + "Hips", 0, {0, 0.95F, 0});
        const int chest = rig.add(figure + "Spine1", rig.add(figure + "Spine", hips, {0, 1.1F, 0}), {0, 1.25F, 0});
        rig.add(figure + "Head", rig.add(figure + "Neck", chest, {0, 1.45F, 0}), {0, 1.55F, 0});
        for (const int side : {0, 1}) {
            const std::string start = figure + (side == 0 ? "Left" : "Right");
            int joint = rig.add(start + "Shoulder", chest, onSide({0.065F, 1.35F, 0}, side), 30.0F);
            joint = rig.add(start + "Arm", joint, onSide({0.163F, 1.354F, 0}, side));
            joint = rig.add(start + "ForeArm", joint, onSide({0.415F, 1.346F, 0}, side));
            rig.add(start + "Hand", joint, onSide({0.675F, 1.348F, 0.01F}, side));
            joint = rig.add(start + "UpLeg", hips, onSide({0.1F, 0.9F, 0}, side));
            joint = rig.add(start + "Leg", joint, onSide({0.1F, 0.5F, 0.01F}, side));
            joint = rig.add(start + "Foot", joint, onSide({0.1F, 0.08F, 0}, side));
            rig.add(start + "ToeBase", joint, onSide({0.1F, 0.02F, 0.12F}, side));
        }
        const HumanoidMap map = rig.map(true);
        REQUIRE(map.humanoid);
        CHECK(rig.nameOf(map, Role::leftShoulder) == figure + "LeftShoulder");
        CHECK(rig.nameOf(map, Role::leftUpperArm) == figure + "LeftArm");
        CHECK(rig.nameOf(map, Role::rightLowerArm) == figure + "RightForeArm");
        CHECK(rig.nameOf(map, Role::rightHand) == figure + "RightHand");
        CHECK(rig.nameOf(map, Role::rightUpperLeg) == figure + "RightUpLeg");
        CHECK(rig.nameOf(map, Role::leftFoot) == figure + "LeftFoot");
        CHECK(rig.nameOf(map, Role::head) == figure + "Head");
        CHECK(map[Role::head]->reason.find(figure.substr(0, 3)) == std::string::npos);
    }
}

TEST_CASE("a hand that a clip has moved away keeps its role where the twist joint lies in its place", "[words]") {
    PlacedJoints rig;
    const Trunk trunk = addTrunk(rig);
    addLegs(rig, trunk.hips);
    for (const int side : {0, 1}) {
        const std::string end = side == 0 ? "_l" : "_r";
        const float wrist = side == 0 ? 0.807F : 1.232F;
        const int upper = rig.add("upperarm" + end, trunk.chest, onSide({0.191F, 1.39F, 0}, side));
        const int lower = rig.add("lowerarm" + end, upper, onSide({0.528F, 1.39F, 0}, side));
        rig.add("hand" + end, lower, onSide({wrist, 1.39F, 0}, side));
        rig.add("lowerarm_twist_01" + end, lower, onSide({0.528F + 0.5F * (wrist - 0.528F), 1.39F, 0}, side));
    }
    const HumanoidMap map = rig.map(false);
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftHand) == "hand_l");
    CHECK(rig.nameOf(map, Role::rightHand) == "hand_r");
}

}  // namespace lutka::test
