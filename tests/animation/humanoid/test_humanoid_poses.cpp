#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <string>

#include "animation/humanoid/map_humanoid.hpp"
#include "posed_rigs.hpp"
#include "rig_variations.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"
#include "synthetic_rigs.hpp"

namespace lutka::test {
namespace {

using animation::HumanoidMap;
using animation::Role;

constexpr const char* kConvention = "vroid";

void eraseJoint(animation::Character& character, std::size_t gone, std::uint16_t heir) {
    animation::Skeleton& skeleton = character.skeleton;
    const auto at = static_cast<std::ptrdiff_t>(gone);
    skeleton.names.erase(skeleton.names.begin() + at);
    skeleton.parents.erase(skeleton.parents.begin() + at);
    skeleton.bindModelFromJoint.erase(skeleton.bindModelFromJoint.begin() + at);
    skeleton.nodeParentFromJoint.erase(skeleton.nodeParentFromJoint.begin() + at);
    skeleton.skinWeight.erase(skeleton.skinWeight.begin() + at);
    for (int& parent : skeleton.parents)
        parent -= parent > static_cast<int>(gone) ? 1 : 0;
    for (auto& joints : character.meshes[0].joints) {
        if (joints[0] == gone) joints[0] = heir;
        if (joints[0] > gone) --joints[0];
    }
}

}  // namespace

TEST_CASE("a seated figure keeps its shins", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    turnBoth(rig, Role::leftUpperLeg, -0.5F * kPi);
    turnBoth(rig, Role::leftLowerLeg, 0.5F * kPi);
    turnBoth(rig, Role::leftUpperArm, 0.2F);
    checkWhole(rig);
}

TEST_CASE("a kneeling figure keeps its shins", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    turnBoth(rig, Role::leftLowerLeg, 0.5F * kPi);
    checkWhole(rig);
}

TEST_CASE("a figure that sits on its heels faces where its knees do", "[poses]") {
    for (const char* convention : {"vroid", "unreal", "cmu", "daz genesis 8", "character creator"}) {
        INFO(convention);
        SyntheticRig rig = makeSyntheticRig(convention, {.armsDown = 1.2F});
        turnBoth(rig, Role::leftUpperLeg, -0.2F);
        turnBoth(rig, Role::leftLowerLeg, 1.9F);
        checkWhole(rig);
        const HumanoidMap map = animation::mapHumanoid(rig.character);
        CHECK((map.standardFromModel * vec3(0, 0, 1)).z > 0.9F);
    }
}

TEST_CASE("a walking figure maps whole", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    turn(rig, Role::leftUpperLeg, -0.5F, vec3(1, 0, 0));
    turn(rig, Role::rightUpperLeg, 0.4F, vec3(1, 0, 0));
    turn(rig, Role::rightLowerLeg, 0.4F, vec3(1, 0, 0));
    checkWhole(rig);
}

TEST_CASE("a figure that leans as a whole maps as if upright", "[poses]") {
    for (const float angle : {30.0F, 45.0F, -30.0F, -45.0F}) {
        for (const vec3& axis : {vec3(0, 0, 1), vec3(1, 0, 0)}) {
            INFO(angle << " degrees about " << (axis.z > 0.0F ? "z" : "x"));
            SyntheticRig rig = makeSyntheticRig(kConvention);
            rig.character = rotated(rig.character, glm::angleAxis(radians(angle), axis));
            checkWhole(rig);
            const HumanoidMap map = animation::mapHumanoid(rig.character);
            const vec3 up = glm::angleAxis(radians(angle), axis) * vec3(0, 1, 0);
            CHECK((map.standardFromModel * up).y > (axis.z > 0.0F ? 0.95F : 0.85F));
        }
    }
}

TEST_CASE("a stump costs the other arm nothing", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    cutOff(rig, Role::rightLowerArm);
    const HumanoidMap map = animation::mapHumanoid(rig.character);
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::leftUpperArm) == jointOf(rig, Role::leftUpperArm));
    CHECK(map.jointOf(Role::leftLowerArm) == jointOf(rig, Role::leftLowerArm));
    CHECK(map.jointOf(Role::leftHand) == jointOf(rig, Role::leftHand));
    CHECK(map.jointOf(Role::rightUpperArm) == jointOf(rig, Role::rightUpperArm));
    CHECK(map.jointOf(Role::rightLowerArm) == animation::kNoJoint);
}

TEST_CASE("a peg leg costs the other leg nothing", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    cutOff(rig, Role::rightFoot);
    const HumanoidMap map = animation::mapHumanoid(rig.character);
    REQUIRE(map.humanoid);
    for (const Role role : {Role::leftUpperLeg, Role::leftLowerLeg, Role::leftFoot, Role::leftToes, Role::rightUpperLeg,
                            Role::rightLowerLeg})
        CHECK(map.jointOf(role) == jointOf(rig, role));
}

TEST_CASE("a whole arm or leg that is missing costs the figure nothing else", "[poses]") {
    for (const std::string& convention : syntheticConventions()) {
        for (const Role top : {Role::leftUpperArm, Role::rightUpperArm, Role::leftUpperLeg, Role::rightUpperLeg}) {
            SyntheticRig rig = makeSyntheticRig(convention, {.armsDown = 0.5F});
            INFO(convention << " without " << animation::roleName(top));
            cutOff(rig, top);
            checkWhatIsLeft(rig);
        }
    }
}

TEST_CASE("an arm that is missing with its shoulder costs the figure nothing else", "[poses]") {
    for (const char* convention : {"vroid", "unreal", "cmu", "xsens"}) {
        SyntheticRig rig = makeSyntheticRig(convention);
        INFO(convention);
        cutOff(rig, Role::leftShoulder);
        checkWhatIsLeft(rig);
    }
}

TEST_CASE("an arm and the leg of the other side may both be missing", "[poses]") {
    for (const std::string& convention : syntheticConventions()) {
        SyntheticRig rig = makeSyntheticRig(convention);
        INFO(convention);
        cutOff(rig, Role::leftUpperArm);
        cutOff(rig, Role::rightUpperLeg);
        checkWhatIsLeft(rig);
    }
}

TEST_CASE("a missing arm is told", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    cutOff(rig, Role::leftUpperArm);
    const HumanoidMap map = animation::mapHumanoid(rig.character);
    CHECK(std::count(map.warnings.begin(), map.warnings.end(), "the figure has no joints of a left arm") == 1);
}

TEST_CASE("a head thrust forward is the head by its name", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    turn(rig, Role::neck, 1.9F, vec3(1, 0, 0));
    checkWhole(rig);
}

TEST_CASE("short arms with long fingers keep their forearms", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    animation::Skeleton& skeleton = rig.character.skeleton;
    const auto stretch = [&](Role from, float factor) {
        const int top = jointOf(rig, from);
        const vec3 pivot = skeleton.bindModelFromJoint[top].translation;
        for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
            vec3& place = skeleton.bindModelFromJoint[joint].translation;
            if (isBelow(skeleton, top, joint)) place = pivot + factor * (place - pivot);
        }
    };
    for (const Role side : {Role::leftUpperArm, Role::rightUpperArm}) {
        stretch(side, 0.6F);
        stretch(side == Role::leftUpperArm ? Role::leftHand : Role::rightHand, 4.0F);
    }
    checkWhole(rig);
}

TEST_CASE("a flat hierarchy of a squat figure without feet keeps what its names tell", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention, {.arms = 0.5F, .legs = 1.2F, .shoulders = 1.9F});
    cutOff(rig, Role::leftFoot);
    cutOff(rig, Role::rightFoot);
    animation::Skeleton& skeleton = rig.character.skeleton;
    for (int joint = 1; joint < skeleton.jointCount(); ++joint)
        skeleton.parents[joint] = 0;
    const HumanoidMap map = animation::mapHumanoid(rig.character);
    REQUIRE(map.humanoid);
    for (const Role role : {Role::hips, Role::head, Role::leftUpperArm, Role::leftLowerArm, Role::rightHand,
                            Role::leftUpperLeg, Role::rightLowerLeg})
        CHECK(map.jointOf(role) == jointOf(rig, role));
    CHECK_FALSE(map.roles[indexOf(Role::leftFoot)]);
}

TEST_CASE("hands that hang on controls are the hands, though helpers hang on the forearms", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    animation::Skeleton& skeleton = rig.character.skeleton;
    for (const Role role : {Role::leftHand, Role::rightHand}) {
        const int hand = jointOf(rig, role);
        const int forearm = skeleton.parents[hand];
        skeleton.names.push_back(role == Role::leftHand ? "Bone.008" : "Bone.009");
        skeleton.parents.push_back(forearm);
        skeleton.bindModelFromJoint.push_back(skeleton.bindModelFromJoint[hand]);
        skeleton.bindModelFromJoint.back().translation +=
            0.6F * (skeleton.bindModelFromJoint[forearm].translation - skeleton.bindModelFromJoint[hand].translation);
        skeleton.nodeParentFromJoint.emplace_back();
        skeleton.skinWeight.push_back(60.0F);
        skeleton.parents[hand] = 0;
    }
    checkWhole(rig);
}

TEST_CASE("hips that a dancer carries to the side are the hips by their name", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    animation::Skeleton& skeleton = rig.character.skeleton;
    skeleton.bindModelFromJoint[jointOf(rig, Role::hips)].translation.x += 0.09F;
    checkWhole(rig);
}

TEST_CASE("a flat hierarchy maps by names and places", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    animation::Skeleton& skeleton = rig.character.skeleton;
    for (int joint = 1; joint < skeleton.jointCount(); ++joint)
        skeleton.parents[joint] = 0;
    checkWhole(rig);
    const HumanoidMap hanging = animation::mapHumanoid(makeSyntheticRig(kConvention).character);
    // A belly before the spine is none of its joints.
    skeleton.names.emplace_back("belly");
    skeleton.parents.push_back(0);
    skeleton.bindModelFromJoint.push_back(skeleton.bindModelFromJoint[jointOf(rig, Role::hips)]);
    skeleton.bindModelFromJoint.back().translation =
        skeleton.bindModelFromJoint[hanging.jointOf(Role::spine)].translation + vec3(0, 0.01F, 0.1F);
    skeleton.nodeParentFromJoint.emplace_back();
    skeleton.skinWeight.push_back(20.0F);
    const HumanoidMap map = animation::mapHumanoid(rig.character);
    for (const Role role : {Role::leftToes, Role::rightToes, Role::spine, Role::chest, Role::upperChest})
        CHECK(map.jointOf(role) == hanging.jointOf(role));
}

TEST_CASE("a hierarchy that does not hang together takes the confidence down, a flat one only a little", "[poses]") {
    const SyntheticRig rig = makeSyntheticRig(kConvention);
    const auto confidence = [](const SyntheticRig& of, Role role) {
        const HumanoidMap map = animation::mapHumanoid(of.character);
        REQUIRE(map.humanoid);
        REQUIRE(map[role]);
        return std::pair(map.confidence, map[role]->confidence);
    };
    const auto [whole, foot] = confidence(rig, Role::leftFoot);
    // The foot is driven from the root.
    SyntheticRig driven = rig;
    driven.character.skeleton.parents[jointOf(rig, Role::leftFoot)] = 0;
    const auto [drivenWhole, drivenFoot] = confidence(driven, Role::leftFoot);
    CHECK(drivenFoot < 0.95F * foot);
    CHECK(drivenWhole < 0.95F * whole);
    SyntheticRig flat = rig;
    for (std::size_t joint = 1; joint < flat.character.skeleton.parents.size(); ++joint)
        flat.character.skeleton.parents[joint] = 0;
    const auto [flatWhole, flatFoot] = confidence(flat, Role::leftFoot);
    CHECK(flatFoot > 0.5F);
    CHECK(flatWhole > 0.6F * whole);
}

TEST_CASE("limbs without weights beside a skinned head are found by their names", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    std::fill(rig.character.skeleton.skinWeight.begin(), rig.character.skeleton.skinWeight.end(), 0.0F);
    rig.character.skeleton.skinWeight[jointOf(rig, Role::head)] = 900.0F;
    rig.character.skeleton.skinWeight[jointOf(rig, Role::neck)] = 60.0F;
    checkWhole(rig);
}

TEST_CASE("the bones of the middle hand are not the hand", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    animation::Skeleton& skeleton = rig.character.skeleton;
    for (const Role role : {Role::leftHand, Role::rightHand}) {
        const int hand = jointOf(rig, role);
        skeleton.names.push_back(role == Role::leftHand ? "DEF-palm.02.L" : "DEF-palm.02.R");
        skeleton.parents.push_back(hand);
        const RigidTransform palm{quat(1, 0, 0, 0), vec3(role == Role::leftHand ? 0.06F : -0.06F, 0, 0)};
        skeleton.bindModelFromJoint.push_back(skeleton.bindModelFromJoint[hand]);
        skeleton.bindModelFromJoint.back().translation += palm.translation;
        skeleton.nodeParentFromJoint.push_back(palm);
        skeleton.skinWeight.push_back(400.0F);
    }
    checkWhole(rig);
}

TEST_CASE("a foot that is its own IK target is the foot", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    animation::Skeleton& skeleton = rig.character.skeleton;
    for (const Role role : {Role::leftFoot, Role::rightFoot}) {
        const int joint = jointOf(rig, role);
        skeleton.parents[joint] = 0;
        skeleton.names[joint] = role == Role::leftFoot ? "FootIK_L" : "FootIK_R";
        rig.truth.roles[indexOf(role)] = std::vector<std::string>{skeleton.names[joint]};
    }
    checkWhole(rig);
}

TEST_CASE("a spine that starts beside the pelvis, at its height, is the spine", "[poses]") {
    // As figures made for MikuMikuDance have it: a centre below, on which the lower and the upper body hang.
    SyntheticRig rig = makeSyntheticRig(kConvention);
    animation::Skeleton& skeleton = rig.character.skeleton;
    const int hips = jointOf(rig, Role::hips);
    const int spine = animation::findJoint(skeleton, "J_Bip_C_Spine");
    const int chest = animation::findJoint(skeleton, "J_Bip_C_Chest");
    REQUIRE(spine != animation::kNoJoint);
    skeleton.bindModelFromJoint[spine].translation.y = skeleton.bindModelFromJoint[hips].translation.y + 0.01F;
    skeleton.parents[spine] = skeleton.parents[hips];
    const HumanoidMap map = animation::mapHumanoid(rig.character);
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::hips) == hips);
    CHECK(map.jointOf(Role::spine) == spine);
    CHECK(map.jointOf(Role::chest) == chest);
}

TEST_CASE("blades in place of feet, and shins that slope back, do not turn the figure round", "[poses]") {
    animation::Character runner = makeBiped();
    animation::SkinnedMesh& mesh = runner.meshes[0];
    const int knee = animation::findJoint(runner.skeleton, "leftLowerLeg");
    const vec3 pivot = runner.skeleton.bindModelFromJoint[knee].translation;
    const quat back = glm::angleAxis(0.35F, vec3(1, 0, 0));
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const std::string& name = runner.skeleton.names[mesh.joints[v][0]];
        vec3& p = mesh.positions[v];
        if (name.ends_with("Foot")) p.z *= 0.15F;
        const bool below = name.ends_with("Foot") || name.ends_with("LowerLeg");
        if (below) p = vec3(p.x, 0, 0) + vec3(0, pivot.y, pivot.z) + back * vec3(0, p.y - pivot.y, p.z - pivot.z);
    }
    // A helmet that is finer behind.
    const auto head = static_cast<std::uint16_t>(animation::findJoint(runner.skeleton, "head"));
    for (int i = 0; i < 600; ++i) {
        mesh.positions.emplace_back(0.05F * std::sin(static_cast<float>(i)), 1.66F, -0.09F);
        mesh.normals.emplace_back(0, 0, -1);
        mesh.uvs.emplace_back(0, 0);
        mesh.joints.push_back({head, 0, 0, 0});
        mesh.weights.push_back({1, 0, 0, 0});
    }
    eraseJoint(runner, 18, 17);
    eraseJoint(runner, 15, 14);
    const HumanoidMap map = animation::mapHumanoid(runner);
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::leftUpperLeg) == animation::findJoint(runner.skeleton, "leftUpperLeg"));
    CHECK(map.jointOf(Role::leftHand) == animation::findJoint(runner.skeleton, "leftHand"));
}

TEST_CASE("many joints side by side are looked through in no time", "[poses]") {
    // Lamps of a hall: the time grew with the cube of their number.
    animation::Character hall;
    std::vector<JointSpec> joints{{"hall", animation::kNoJoint, vec3(0)}};
    for (int row = 0; row < 150; ++row) {
        for (const float side : {-1.0F, 1.0F}) {
            const auto place = static_cast<float>(row);
            joints.push_back({"lamp" + std::to_string(joints.size()), 0,
                              vec3(side * (1.0F + 0.01F * place), 0.1F * place, std::fmod(0.37F * place, 3.0F))});
        }
    }
    hall.skeleton = makeSkeleton(joints);
    CHECK_FALSE(animation::mapHumanoid(hall).humanoid);
}

TEST_CASE("a runner's left arm and right leg, both in front, do not make a figure that goes sideways", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention, {.armsDown = 1.3F});
    animation::Skeleton& skeleton = rig.character.skeleton;
    std::fill(skeleton.skinWeight.begin(), skeleton.skinWeight.end(), 0.0F);
    rig.character.meshes.clear();
    turn(rig, Role::hips, 0.5F, vec3(1, 0, 0));
    turn(rig, Role::leftUpperLeg, 0.4F, vec3(1, 0, 0));
    turn(rig, Role::rightUpperLeg, -1.4F, vec3(1, 0, 0));
    turn(rig, Role::leftLowerLeg, 0.3F, vec3(1, 0, 0));
    turn(rig, Role::rightLowerLeg, 1.5F, vec3(1, 0, 0));
    turn(rig, Role::leftUpperArm, -0.9F, vec3(1, 0, 0));
    turn(rig, Role::rightUpperArm, 0.8F, vec3(1, 0, 0));
    checkWhole(rig);
    // As exported for one game: the forearms are the last joints of the arms.
    const int foot = jointOf(rig, Role::leftFoot);
    const std::string name = rig.character.skeleton.names[foot];
    cutOff(rig, Role::leftHand);
    cutOff(rig, Role::rightHand);
    const HumanoidMap map = animation::mapHumanoid(rig.character);
    REQUIRE(map.humanoid);
    REQUIRE(map[Role::leftFoot]);
    CHECK(rig.character.skeleton.names[map.jointOf(Role::leftFoot)] == name);
}

TEST_CASE("a sprinter who leans far forward keeps head and neck", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention, {.armsDown = 1.3F});
    turn(rig, Role::hips, 0.75F, vec3(1, 0, 0));
    turn(rig, Role::leftUpperLeg, -0.2F, vec3(1, 0, 0));
    turn(rig, Role::rightUpperLeg, -1.5F, vec3(1, 0, 0));
    turn(rig, Role::rightLowerLeg, 1.2F, vec3(1, 0, 0));
    turn(rig, Role::neck, 0.3F, vec3(1, 0, 0));
    checkWhole(rig);
}

TEST_CASE("toes are toes by their names in a bow, too", "[poses]") {
    for (const float bow : {0.8F, 1.3F}) {
        SyntheticRig rig = makeSyntheticRig(kConvention);
        turn(rig, Role::hips, bow, vec3(1, 0, 0));
        turnBoth(rig, Role::leftUpperLeg, -bow);
        const HumanoidMap map = animation::mapHumanoid(rig.character);
        REQUIRE(map.humanoid);
        CHECK(map.jointOf(Role::leftToes) == jointOf(rig, Role::leftToes));
        CHECK(map.jointOf(Role::rightToes) == jointOf(rig, Role::rightToes));
    }
}

TEST_CASE("feet that cross stay on the sides of their legs", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    turn(rig, Role::leftUpperLeg, -0.18F, vec3(0, 0, 1));
    turn(rig, Role::rightUpperLeg, 0.18F, vec3(0, 0, 1));
    checkWhole(rig);
    rig.character = withoutNames(rig.character);
    const SyntheticRig named = makeSyntheticRig(kConvention);
    const HumanoidMap map = animation::mapHumanoid(rig.character);
    REQUIRE(map.humanoid);
    for (const Role role : {Role::leftUpperLeg, Role::leftFoot, Role::rightLowerLeg, Role::rightFoot})
        CHECK(map.jointOf(role) == jointOf(named, role));
}

TEST_CASE("arms and legs that are called left on different sides are read by their shape", "[poses]") {
    // Numbered bones of a modelling program, the arms' sides exchanged.
    const SyntheticRig named = makeSyntheticRig(kConvention);
    animation::Character character = named.character;
    for (std::size_t joint = 0; joint < character.skeleton.names.size(); ++joint)
        character.skeleton.names[joint] = "Bone." + std::to_string(joint);
    for (const Role role : {Role::leftUpperArm, Role::leftLowerArm, Role::leftHand, Role::leftUpperLeg,
                            Role::leftLowerLeg, Role::leftFoot}) {
        const bool arm = role == Role::leftUpperArm || role == Role::leftLowerArm || role == Role::leftHand;
        const std::string number = "." + std::to_string(indexOf(role));
        character.skeleton.names[jointOf(named, role)] = (arm ? "Bone_R" : "Bone_L") + number;
        character.skeleton.names[jointOf(named, animation::mirrored(role))] = (arm ? "Bone_L" : "Bone_R") + number;
    }
    const HumanoidMap map = animation::mapHumanoid(character);
    REQUIRE(map.humanoid);
    for (const Role role :
         {Role::leftUpperLeg, Role::leftLowerLeg, Role::leftFoot, Role::leftUpperArm, Role::rightHand})
        CHECK(map.jointOf(role) == jointOf(named, role));
}

}  // namespace lutka::test
