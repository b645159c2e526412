// Figures whose names tell more than their bind pose.

#include <algorithm>
#include <array>
#include <random>
#include <string>

#include "animation/humanoid/map_humanoid.hpp"
#include "posed_rigs.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

namespace lutka::test {
namespace {

using animation::HumanoidMap;
using animation::Role;

// As a clip without its skin is exported: the first frame is all the pose that there is.
SyntheticRig bareRig(const std::string& convention, const Build& build) {
    SyntheticRig rig = makeSyntheticRig(convention, build);
    std::vector<float>& weights = rig.character.skeleton.skinWeight;
    std::fill(weights.begin(), weights.end(), 0.0F);
    rig.character.meshes.clear();
    return rig;
}

// Poses of a fight, within what joints can do; the same number gives the same pose.
void fight(SyntheticRig& rig, int number) {
    std::mt19937 random(static_cast<unsigned>(number));
    const auto between = [&](float low, float high) {
        return low + (high - low) * static_cast<float>(random() % 1000U) / 999.0F;
    };
    const vec3 x(1, 0, 0);
    const vec3 y(0, 1, 0);
    turn(rig, Role::hips, between(-0.6F, 0.6F), y);
    const float lean = between(0.0F, 0.5F);
    turn(rig, Role::hips, lean, x);
    for (const Role left : {Role::leftUpperLeg, Role::rightUpperLeg}) {
        const float thigh = between(-1.3F, 0.5F);
        turn(rig, left, thigh - lean, x);
        turn(rig, left == Role::leftUpperLeg ? Role::leftLowerLeg : Role::rightLowerLeg,
             between(0.1F, 1.2F) - 0.5F * thigh, x);
    }
    for (const Role left : {Role::leftUpperArm, Role::rightUpperArm}) {
        const bool right = left == Role::rightUpperArm;
        turn(rig, left, between(-1.6F, 0.8F), x);
        turn(rig, right ? Role::rightLowerArm : Role::leftLowerArm, (right ? 1.0F : -1.0F) * between(0.0F, 1.2F), y);
        turn(rig, right ? Role::rightLowerArm : Role::leftLowerArm, -between(0.2F, 1.6F), x);
    }
}

}  // namespace

TEST_CASE("where names tell all limbs, a fighter's poses cost no limb", "[named]") {
    for (const char* convention : {"advanced skeleton", "vroid", "cmu"}) {
        for (int seed = 0; seed < 300; ++seed) {
            SyntheticRig rig = bareRig(convention, {.armsDown = 1.2F});
            fight(rig, seed);
            const animation::HumanoidMap map = animation::mapHumanoid(rig.character);
            const Score score = scoreMap(rig.truth, map, rig.character.skeleton.names);
            INFO(convention << " in pose " << seed << ": " << score.faults);
            REQUIRE(score.right == score.of);
        }
    }
}

TEST_CASE("names that exchange the arms but not the legs are told", "[named]") {
    SyntheticRig rig = makeSyntheticRig("cmu", {});
    const auto saysSo = [](const animation::HumanoidMap& map) {
        return std::any_of(map.warnings.begin(), map.warnings.end(),
                           [](const std::string& text) { return text.find("some of them are wrong") != text.npos; });
    };
    CHECK_FALSE(saysSo(animation::mapHumanoid(rig.character)));
    std::vector<std::string>& names = rig.character.skeleton.names;
    for (const auto& [left, right] :
         {std::pair(Role::leftShoulder, Role::rightShoulder), std::pair(Role::leftUpperArm, Role::rightUpperArm),
          std::pair(Role::leftLowerArm, Role::rightLowerArm), std::pair(Role::leftHand, Role::rightHand)}) {
        std::swap(names[jointOf(rig, left)], names[jointOf(rig, right)]);
    }
    const animation::HumanoidMap map = animation::mapHumanoid(rig.character);
    CHECK(map.humanoid);
    CHECK(saysSo(map));
}

TEST_CASE("hips that hang on the trunk and carry the legs are the hips by their name", "[named]") {
    // As a robot is rigged whose body is the root.
    std::vector<JointSpec> joints{{"root", animation::kNoJoint, vec3(0)},
                                  {"torso", 0, vec3(0, 0.6F, 0)},
                                  {"hips", 1, vec3(0, 0.6F, 0)},
                                  {"neck", 1, vec3(0, 1.0F, 0)},
                                  {"head", 3, vec3(0, 1.1F, 0.02F)}};
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? ".L" : ".R";
        const auto add = [&](const char* name, int parent, const vec3& place) {
            joints.push_back({name + end, parent, vec3(side, 1, 1) * place});
            return static_cast<int>(joints.size()) - 1;
        };
        const int thigh = add("upperleg", 2, vec3(0.13F, 0.55F, 0));
        add("foot", add("lowerleg", thigh, vec3(0.13F, 0.35F, 0.02F)), vec3(0.13F, 0.12F, 0));
        const int arm = add("upperarm", 1, vec3(0.2F, 0.95F, 0));
        add("hand", add("lowerarm", arm, vec3(0.42F, 0.95F, 0)), vec3(0.6F, 0.95F, 0));
    }
    animation::Character robot;
    robot.skeleton = makeSkeleton(joints);
    robot.skeleton.skinWeight.assign(joints.size(), 100.0F);
    robot.skeleton.skinWeight[0] = 0.0F;
    const animation::HumanoidMap map = animation::mapHumanoid(robot);
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::hips) == 2);
    CHECK(map.jointOf(Role::spine) == 1);
}

TEST_CASE("the end of a shin that is called foot is no tip of a foot", "[named]") {
    // Blender writes an end for every last bone; that of a shin lies behind the knee. This one faces -Z.
    std::vector<JointSpec> joints{{"hips", animation::kNoJoint, vec3(0, 0.9F, 0)},
                                  {"chest", 0, vec3(0, 1.1F, 0)},
                                  {"head", 1, vec3(0, 1.4F, 0)},
                                  {"head_end", 2, vec3(0, 1.7F, 0)}};
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? ".R" : ".L";
        const auto add = [&](const std::string& name, int parent, const vec3& place) {
            joints.push_back({name, parent, vec3(side, 1, 1) * place});
            return static_cast<int>(joints.size()) - 1;
        };
        const int foot = add("foot" + end, add("noga" + end, 0, vec3(0.1F, 0.85F, 0)), vec3(0.12F, 0.5F, -0.01F));
        add("foot" + end + "_end", foot, vec3(0.13F, 0.05F, 0.15F));
        const int hand = add("hand" + end, add("arm" + end, 1, vec3(0.2F, 1.35F, 0)), vec3(0.45F, 1.35F, 0));
        add("hand" + end + "_end", hand, vec3(0.75F, 1.35F, 0));
    }
    animation::Character figure;
    figure.skeleton = makeSkeleton(joints);
    for (const JointSpec& joint : joints) {
        figure.skeleton.skinWeight.push_back(joint.name.ends_with("_end") ? 0.0F : 100.0F);
    }
    const animation::HumanoidMap map = animation::mapHumanoid(figure);
    REQUIRE(map.humanoid);
    const auto nameOf = [&](Role role) { return figure.skeleton.names[map.jointOf(role)]; };
    CHECK(nameOf(Role::leftUpperLeg) == "noga.L");
    CHECK(nameOf(Role::rightUpperArm) == "arm.R");
}

TEST_CASE("the mesh that hangs on the joint of its name does not take its role", "[named]") {
    // A figure of rigid meshes on joints "..._jnt"; those of hats and head hang in the middle of the skull.
    SyntheticRig rig = bareRig("unreal", {});
    animation::Skeleton& skeleton = rig.character.skeleton;
    const auto hang = [&](const char* name, int parent, const vec3& from) {
        const vec3 place = skeleton.bindModelFromJoint[parent].translation + from;
        const auto node = static_cast<std::uint16_t>(skeleton.jointCount());
        skeleton.names.emplace_back(name);
        skeleton.parents.push_back(parent);
        skeleton.bindModelFromJoint.push_back({quat(1, 0, 0, 0), place});
        skeleton.nodeParentFromJoint.emplace_back();
        skeleton.skinWeight.push_back(8.0F);
        animation::SkinnedMesh part;
        part.rigid = true;
        for (const vec3& corner : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 1), vec3(0, -1, -1)})
            part.positions.push_back(place + 0.1F * corner);
        part.joints.assign(part.positions.size(), std::array<std::uint16_t, 4>{node, 0, 0, 0});
        part.weights.assign(part.positions.size(), std::array<float, 4>{1, 0, 0, 0});
        part.indices = {0, 1, 2, 0, 1, 3};
        rig.character.meshes.push_back(std::move(part));
    };
    const int neck = jointOf(rig, Role::neck);
    const int head = jointOf(rig, Role::head);
    skeleton.names[neck] = "Spine_top";
    skeleton.names[head] = "Head_jnt";
    rig.truth.roles[indexOf(Role::head)] = std::vector<std::string>{"Head_jnt"};
    skeleton.bindModelFromJoint[head].translation = skeleton.bindModelFromJoint[neck].translation + vec3(0, 0.01F, 0);
    hang("Head", head, vec3(0, 0.18F, 0));
    hang("Hat", head, vec3(0, 0.3F, 0));
    hang("Body", animation::findJoint(skeleton, "spine_02"), vec3(0, 0.1F, 0));
    const animation::HumanoidMap map = animation::mapHumanoid(rig.character);
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::head) == head);
    // A mesh of the hips that lies on the first joint of the spine, in a figure whose trunk has a skin.
    SyntheticRig cop = makeSyntheticRig("unreal");
    animation::Skeleton& bones = cop.character.skeleton;
    const int pelvis = jointOf(cop, Role::hips);
    bones.names[pelvis] = "spine1_loRes";
    bones.names.emplace_back("male_hips");
    bones.parents.push_back(pelvis);
    bones.bindModelFromJoint.push_back(bones.bindModelFromJoint[pelvis]);
    bones.nodeParentFromJoint.emplace_back();
    bones.skinWeight.push_back(900.0F);
    animation::SkinnedMesh part;
    part.rigid = true;
    const vec3 place = bones.bindModelFromJoint[pelvis].translation;
    part.positions = {place, place + vec3(0.1F, 0, 0), place + vec3(0, 0.1F, 0.1F)};
    part.joints.assign(3, {static_cast<std::uint16_t>(bones.jointCount() - 1), 0, 0, 0});
    part.weights.assign(3, {1, 0, 0, 0});
    cop.character.meshes.push_back(part);
    CHECK(animation::mapHumanoid(cop.character).jointOf(Role::hips) == pelvis);
}

TEST_CASE("a control rig that copies the skeleton in its place takes no trunk away", "[named]") {
    // As motion builders write it. The copy has no fingers on one side, so that it is no image of itself.
    SyntheticRig rig = bareRig("valve", {.armsDown = 0.25F});
    animation::Skeleton& skeleton = rig.character.skeleton;
    const int count = skeleton.jointCount();
    std::vector<int> copyOf(static_cast<std::size_t>(count), animation::kNoJoint);
    for (int joint = 0; joint < count; ++joint) {
        const std::string& name = skeleton.names[joint];
        if (name.find("L_Finger") != std::string::npos) continue;
        const int parent = skeleton.parents[joint];
        copyOf[joint] = skeleton.jointCount();
        skeleton.names.push_back(name + " 1");
        skeleton.parents.push_back(parent == animation::kNoJoint ? animation::kNoJoint : copyOf[parent]);
        skeleton.bindModelFromJoint.push_back(skeleton.bindModelFromJoint[joint]);
        skeleton.nodeParentFromJoint.push_back(skeleton.nodeParentFromJoint[joint]);
        skeleton.skinWeight.push_back(0.0F);
    }
    const animation::HumanoidMap map = animation::mapHumanoid(rig.character);
    CAPTURE(map.warnings);
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::spine) != map.jointOf(Role::hips));
    std::vector<std::string> names = skeleton.names;
    for (std::string& name : names)
        name = name.substr(0, name.find(" 1"));  // copies do as well
    const Score score = scoreMap(rig.truth, map, names);
    INFO(score.faults);
    CHECK(score.right == score.of);
    // All of it is of one of the two.
    for (const Role role : {Role::head, Role::leftHand, Role::rightUpperArm})
        CHECK(animation::isAncestorOrSelf(skeleton, map.jointOf(Role::chest), map.jointOf(role)));
    for (const Role role : {Role::chest, Role::leftFoot, Role::rightUpperLeg})
        CHECK(animation::isAncestorOrSelf(skeleton, map.jointOf(Role::hips), map.jointOf(role)));
}

TEST_CASE("trousers with the skeleton of the whole figure map as it", "[named]") {
    for (const bool legs : {true, false}) {
        INFO((legs ? "trousers" : "a shirt"));
        animation::Character garment = makeBiped();
        animation::SkinnedMesh& mesh = garment.meshes[0];
        const animation::SkinnedMesh whole = mesh;
        mesh = {};
        std::fill(garment.skeleton.skinWeight.begin(), garment.skeleton.skinWeight.end(), 0.0F);
        for (std::size_t v = 0; v < whole.positions.size(); ++v) {
            const std::string& name = garment.skeleton.names[whole.joints[v][0]];
            const bool ofLeg = name.ends_with("UpperLeg") || name.ends_with("LowerLeg");
            const bool ofShirt = name.ends_with("UpperArm") || name.ends_with("LowerArm") || name == "chest";
            if (legs ? !ofLeg : !ofShirt) continue;
            mesh.positions.push_back(whole.positions[v]);
            mesh.joints.push_back(whole.joints[v]);
            mesh.weights.push_back(whole.weights[v]);
            garment.skeleton.skinWeight[whole.joints[v][0]] += 1.0F;
        }
        const animation::HumanoidMap map = animation::mapHumanoid(garment);
        REQUIRE(map.humanoid);
        CHECK(map.missing.empty());
        CHECK(map.jointOf(Role::head) == animation::findJoint(garment.skeleton, "head"));
        CHECK(map.jointOf(Role::leftHand) == animation::findJoint(garment.skeleton, "leftHand"));
        CHECK(map.warnings.front().find("only a part of the figure has skin") == 0);
    }
}

TEST_CASE("a cape hangs behind, and the finer side of a box of a head proves nothing", "[named]") {
    // Faces -Z, as figures of some block games do: a box of a head with a brim towards +Z.
    animation::Character block;
    block.skeleton = makeSkeleton({{"Player", -1, {0, 0, 0}},
                                   {"Body", 0, {0, 0.67F, 0}},
                                   {"Leg_Right", 1, {0.1F, 0.67F, 0}},
                                   {"Leg_Left", 1, {-0.1F, 0.67F, 0}},
                                   {"Cape", 1, {0, 1.3F, 0.12F}},
                                   {"Arm_Right", 1, {0.3F, 1.25F, 0}},
                                   {"Arm_Left", 1, {-0.3F, 1.25F, 0}},
                                   {"Head", 1, {0, 1.35F, 0}}});
    animation::SkinnedMesh mesh;
    const auto box = [&](int joint, const vec3& low, const vec3& high) {
        for (int corner = 0; corner < 8; ++corner) {
            mesh.positions.emplace_back((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                                        (corner & 4) != 0 ? high.z : low.z);
            mesh.joints.push_back({static_cast<std::uint16_t>(joint), 0, 0, 0});
            mesh.weights.push_back({1, 0, 0, 0});
        }
        block.skeleton.skinWeight[static_cast<std::size_t>(joint)] += 8.0F;
    };
    box(1, {-0.2F, 0.67F, -0.1F}, {0.2F, 1.35F, 0.1F});
    box(2, {0, 0, -0.1F}, {0.2F, 0.67F, 0.1F});
    box(3, {-0.2F, 0, -0.1F}, {0, 0.67F, 0.1F});
    box(4, {-0.2F, 0.7F, 0.12F}, {0.2F, 1.3F, 0.14F});
    box(5, {0.2F, 0.67F, -0.1F}, {0.4F, 1.35F, 0.1F});
    box(6, {-0.4F, 0.67F, -0.1F}, {-0.2F, 1.35F, 0.1F});
    box(7, {-0.2F, 1.35F, -0.2F}, {0.2F, 1.75F, 0.2F});
    box(7, {-0.2F, 1.7F, 0.18F}, {0.2F, 1.75F, 0.2F});
    block.meshes.push_back(mesh);
    const animation::HumanoidMap map = animation::mapHumanoid(block);
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::leftUpperArm) == 6);
    CHECK(map.jointOf(Role::leftUpperLeg) == 3);
    CHECK((map.standardFromModel * vec3(0, 0, -1)).z > 0.9F);
    animation::MapOptions unnamed;
    unnamed.useNames = false;
    CHECK(animation::mapHumanoid(block, unnamed).humanoid);
}

TEST_CASE("a hub that carries the collarbones is the chest, and one at the end of a long spine the head", "[named]") {
    // As 3ds Max's CAT builds figures: hubs with spines between them, here with a neck of five joints.
    std::vector<JointSpec> joints{{"Hub1", -1, {0, 0.6F, 0}}};
    for (int i = 0; i < 4; ++i)
        joints.push_back({"Spine" + std::to_string(i + 1), i, {0, 0.65F + 0.08F * static_cast<float>(i), 0}});
    joints.push_back({"Hub2", 4, {0, 1.0F, -0.02F}});
    for (int i = 0; i < 5; ++i)
        joints.push_back({"Spine" + std::to_string(i + 5), 5 + i, {0, 1.02F + 0.08F * static_cast<float>(i), -0.02F}});
    joints.push_back({"Hub3", 10, {0, 1.4F, -0.02F}});
    for (const bool left : {true, false}) {
        const std::string side = left ? "L" : "R";
        const float x = left ? 1.0F : -1.0F;
        const auto at = static_cast<int>(joints.size());
        joints.push_back({side + "ArmCollarbone", 5, {0.03F * x, 1.0F, -0.02F}});
        joints.push_back({side + "UpperArm", at, {0.2F * x, 1.0F, -0.02F}});
        joints.push_back({side + "Forearm", at + 1, {0.41F * x, 0.98F, 0}});
        joints.push_back({side + "Palm", at + 2, {0.63F * x, 0.94F, 0}});
        joints.push_back({side + "Thigh", 0, {0.13F * x, 0.6F, 0}});
        joints.push_back({side + "Calf", at + 4, {0.13F * x, 0.32F, 0.03F}});
        joints.push_back({side + "Ankle", at + 5, {0.13F * x, 0.03F, 0}});
    }
    animation::Character figure;
    figure.skeleton = makeSkeleton(joints);
    std::fill(figure.skeleton.skinWeight.begin(), figure.skeleton.skinWeight.end(), 50.0F);
    for (int i = 6; i < 11; ++i)
        figure.skeleton.skinWeight[i] = 8.0F;
    figure.skeleton.skinWeight[11] = 230.0F;
    const HumanoidMap map = animation::mapHumanoid(figure);
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::head) == 11);
    CHECK(map.jointOf(Role::upperChest) == 5);
    CHECK(map.jointOf(Role::neck) == 6);
    CHECK(map.jointOf(Role::hips) == 0);
}

TEST_CASE("hips that carry the legs beside the spine are the hips, not the joint of the whole body above both",
          "[named]") {
    // As a game of 2004 has its monsters.
    std::vector<JointSpec> joints{{"origin", -1, {0, 0, 0}},
                                  {"Body", 0, {0, 1.01F, 0}},
                                  {"Body2", 1, {0, 1.01F, 0}},
                                  {"Hips", 2, {0, 0.99F, -0.02F}},
                                  {"waist", 2, {0, 1.006F, -0.02F}},
                                  {"chest", 4, {0, 1.27F, -0.1F}},
                                  {"shoulders", 5, {0, 1.56F, -0.09F}},
                                  {"loneck", 6, {0, 1.64F, -0.09F}},
                                  {"head", 7, {0, 1.76F, -0.07F}}};
    for (const bool left : {true, false}) {
        const std::string side = left ? "L" : "R";
        const float x = left ? 1.0F : -1.0F;
        const auto at = static_cast<int>(joints.size());
        joints.push_back({side + "upleg", 3, {0.13F * x, 0.99F, -0.04F}});
        joints.push_back({side + "loleg", at, {0.2F * x, 0.48F, -0.02F}});
        joints.push_back({side + "ankle", at + 1, {0.25F * x, 0.1F, -0.1F}});
        joints.push_back({side + "uparm", 6, {0.19F * x, 1.54F, -0.07F}});
        joints.push_back({side + "loarm", at + 3, {0.49F * x, 1.43F, -0.11F}});
        joints.push_back({side + "hand", at + 4, {0.67F * x, 1.36F, -0.1F}});
    }
    animation::Character figure;
    figure.skeleton = makeSkeleton(joints);
    std::fill(figure.skeleton.skinWeight.begin(), figure.skeleton.skinWeight.end(), 60.0F);
    figure.skeleton.skinWeight[0] = 0.0F;
    figure.skeleton.skinWeight[1] = 1.6F;
    figure.skeleton.skinWeight[2] = 17.8F;
    const HumanoidMap map = animation::mapHumanoid(figure);
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::hips) == 3);
    CHECK(map.jointOf(Role::spine) == 4);
    CHECK(map.jointOf(Role::chest) == 5);
    CHECK(map.jointOf(Role::head) == 8);
}

TEST_CASE("a goblin whose forearms end at the ground is a figure by its names, and what its ears hang on is its head",
          "[named]") {
    std::vector<JointSpec> joints{
        {"Base", -1, {0, 0.03F, 0.4F}}, {"Body", 0, {0, 0.38F, 0}}, {"Body.001", 1, {0, 0.64F, 0}}};
    for (const char* side : {".L", ".R"}) {
        const float x = side[1] == 'L' ? 1.0F : -1.0F;
        const auto at = static_cast<int>(joints.size());
        joints.push_back({"Thigh" + std::string(side), 1, {0.13F * x, 0.4F, -0.05F}});
        joints.push_back({"Calf" + std::string(side), at, {0.13F * x, 0.24F, -0.05F}});
        joints.push_back({"Foot" + std::string(side), at + 1, {0.13F * x, 0.06F, -0.05F}});
        joints.push_back({"Bicep" + std::string(side), 1, {0.25F * x, 0.62F, -0.07F}});
        joints.push_back({"Forearm" + std::string(side), at + 3, {0.33F * x, 0.46F, -0.07F}});
        joints.push_back({"Forearm" + std::string(side) + "_end", at + 4, {0.36F * x, 0.05F, -0.05F}});
        joints.push_back({"Ear" + std::string(side), 2, {0.28F * x, 0.99F, -0.15F}});
    }
    animation::Character goblin;
    goblin.skeleton = makeSkeleton(joints);
    for (std::size_t i = 0; i < joints.size(); ++i)
        goblin.skeleton.skinWeight[i] = joints[i].name.ends_with("_end") ? 0.0F : 50.0F;
    goblin.skeleton.skinWeight[2] = 400.0F;
    const HumanoidMap map = animation::mapHumanoid(goblin);
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::head) == 2);
    CHECK(map.jointOf(Role::hips) == 1);
    CHECK(goblin.skeleton.names[map.jointOf(Role::leftLowerArm)] == "Forearm.L");
    CHECK(goblin.skeleton.names[map.jointOf(Role::rightFoot)] == "Foot.R");
}

TEST_CASE("who bows deeply is a figure by his names, and stands upright on his legs", "[named]") {
    for (const std::string& convention : syntheticConventions()) {
        // Their legs do not hang on their hips; the third has numbers for parts.
        if (convention == "rigify control rig" || convention == "rigify deforming joints" || convention == "mgear")
            continue;
        for (const float bow : {0.8F, 1.2F, 1.6F}) {
            for (const bool armsHang : {false, true}) {
                INFO(convention << " bows by " << bow << (armsHang ? ", arms down" : ""));
                SyntheticRig rig = makeSyntheticRig(convention, {.armsDown = 1.3F});
                turn(rig, Role::hips, bow, vec3(1, 0, 0));
                turnBoth(rig, Role::leftUpperLeg, -bow);
                if (armsHang) turnBoth(rig, Role::leftUpperArm, -bow);
                checkWhole(rig);
                const animation::HumanoidMap map = animation::mapHumanoid(rig.character);
                CHECK((map.standardFromModel * vec3(0, 1, 0)).y > 0.95F);
                CHECK((map.standardFromModel * vec3(0, 0, 1)).z > 0.95F);
            }
        }
    }
}

TEST_CASE("the node of an armature, which moves no skin, is not the hips beside the first joint of the spine",
          "[named]") {
    std::vector<JointSpec> joints{{"Armature", -1, {0.01F, 0.655F, 0.06F}},
                                  {"Spine1", 0, {0, 0.704F, 0}},
                                  {"Spine2", 1, {0, 0.97F, 0}},
                                  {"Spine3", 2, {0, 1.27F, 0}},
                                  {"Spine4", 3, {0, 1.54F, 0}},
                                  {"Head", 4, {0, 1.715F, -0.05F}}};
    for (const bool left : {true, false}) {
        const std::string side = left ? ".l" : ".r";
        const float x = left ? 1.0F : -1.0F;
        const auto at = static_cast<int>(joints.size());
        joints.push_back({"UpperArm" + side, 4, {0.2F * x, 1.57F, -0.02F}});
        joints.push_back({"LowerArm" + side, at, {0.45F * x, 1.566F, -0.06F}});
        joints.push_back({"Hand" + side, at + 1, {0.746F * x, 1.56F, -0.15F}});
        joints.push_back({"UpperLeg" + side, 0, {0.16F * x, 0.68F, 0}});
        joints.push_back({"LowerLeg" + side, at + 3, {0.17F * x, 0.4F, 0}});
    }
    animation::Character figure;
    figure.skeleton = makeSkeleton(joints);
    std::fill(figure.skeleton.skinWeight.begin(), figure.skeleton.skinWeight.end(), 100.0F);
    figure.skeleton.skinWeight[0] = 0.0F;
    const HumanoidMap map = animation::mapHumanoid(figure);
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::hips) == 1);
    CHECK(map.jointOf(Role::spine) == 2);
    CHECK(map.jointOf(Role::upperChest) == 4);
    CHECK(map.jointOf(Role::head) == 5);
}

}  // namespace lutka::test
