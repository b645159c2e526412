#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "animation/humanoid/map_humanoid.hpp"
#include "rig_variations.hpp"
#include "support/catch.hpp"
#include "synthetic_rigs.hpp"

namespace lutka::test {
namespace {

using animation::HumanoidMap;
using animation::Role;

constexpr const char* kConvention = "vroid";

int jointOf(const SyntheticRig& rig, Role role) {
    const auto& names = rig.character.skeleton.names;
    return static_cast<int>(std::find(names.begin(), names.end(), rig.truth.roles[indexOf(role)]->front()) -
                            names.begin());
}

bool isBelow(const animation::Skeleton& skeleton, int top, int joint) {
    while (joint != animation::kNoJoint && joint != top)
        joint = skeleton.parents[joint];
    return joint == top;
}

// Turns a role's joint and all below it about the joint itself.
void turn(SyntheticRig& rig, Role role, float angle, const vec3& axis) {
    animation::Skeleton& skeleton = rig.character.skeleton;
    const int top = jointOf(rig, role);
    const vec3 pivot = skeleton.bindModelFromJoint[top].translation;
    const quat rotation = glm::angleAxis(angle, axis);
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        if (!isBelow(skeleton, top, joint)) continue;
        vec3& place = skeleton.bindModelFromJoint[joint].translation;
        place = pivot + rotation * (place - pivot);
    }
}

void turnBoth(SyntheticRig& rig, Role left, float angle) {
    turn(rig, left, angle, vec3(1, 0, 0));
    turn(rig, animation::mirrored(left), angle, vec3(1, 0, 0));
}

// Without the joints of a role and below it.
void cutOff(SyntheticRig& rig, Role role) {
    animation::Skeleton& skeleton = rig.character.skeleton;
    const int top = jointOf(rig, role);
    animation::Skeleton left;
    std::vector<int> fresh;
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        const bool gone = isBelow(skeleton, top, joint);
        fresh.push_back(gone ? animation::kNoJoint : static_cast<int>(left.names.size()));
        if (gone) continue;
        left.names.push_back(skeleton.names[joint]);
        left.parents.push_back(skeleton.parents[joint] < 0 ? animation::kNoJoint : fresh[skeleton.parents[joint]]);
        left.bindModelFromJoint.push_back(skeleton.bindModelFromJoint[joint]);
        left.nodeParentFromJoint.push_back(skeleton.nodeParentFromJoint[joint]);
        left.skinWeight.push_back(skeleton.skinWeight[joint]);
    }
    skeleton = left;
}

void checkWhole(const SyntheticRig& rig) {
    const HumanoidMap map = animation::mapHumanoid(rig.character);
    const Score score = scoreMap(rig.truth, map, rig.character.skeleton.names);
    INFO(score.faults);
    INFO((map.warnings.empty() ? std::string() : map.warnings.front()));
    CHECK(map.humanoid);
    CHECK(score.right == score.of);
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

TEST_CASE("a head thrust forward is the head by its name", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    turn(rig, Role::neck, 1.9F, vec3(1, 0, 0));
    checkWhole(rig);
}

TEST_CASE("a flat hierarchy maps by names and places", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    animation::Skeleton& skeleton = rig.character.skeleton;
    for (int joint = 1; joint < skeleton.jointCount(); ++joint)
        skeleton.parents[joint] = 0;
    checkWhole(rig);
}

TEST_CASE("a figure that sits cross-legged or crouches maps by its names", "[poses]") {
    SyntheticRig crossed = makeSyntheticRig(kConvention);
    turn(crossed, Role::leftUpperLeg, -1.4F, vec3(1, 0, 0));
    turn(crossed, Role::rightUpperLeg, -1.4F, vec3(1, 0, 0));
    turn(crossed, Role::leftLowerLeg, -1.9F, vec3(0, 1, 0));
    turn(crossed, Role::rightLowerLeg, 1.9F, vec3(0, 1, 0));
    checkWhole(crossed);
    SyntheticRig crouched = makeSyntheticRig(kConvention);
    turnBoth(crouched, Role::hips, 0.9F);
    turnBoth(crouched, Role::leftUpperLeg, -2.2F);
    turnBoth(crouched, Role::leftLowerLeg, 1.9F);
    turn(crouched, Role::leftUpperArm, -1.3F, vec3(0, 0, 1));
    turn(crouched, Role::rightUpperArm, 0.7F, vec3(0, 1, 0));
    checkWhole(crouched);
}

TEST_CASE("a figure that lies in some pose maps by its names", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kConvention);
    turn(rig, Role::leftUpperLeg, -1.2F, vec3(1, 0, 0));
    turn(rig, Role::leftLowerLeg, 1.6F, vec3(1, 0, 0));
    turn(rig, Role::rightUpperArm, 1.1F, vec3(0, 1, 0));
    rig.character = rotated(rig.character, glm::angleAxis(radians(-75.0F), vec3(1, 0, 0)));
    checkWhole(rig);
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

}  // namespace lutka::test
