#include <string>
#include <utility>

#include "animation/humanoid/map_humanoid.hpp"
#include "posed_rigs.hpp"
#include "rig_variations.hpp"
#include "support/catch.hpp"
#include "synthetic_rigs.hpp"

// Figures that crouch, sit, lie or cross their legs in the bind pose.
namespace lutka::test {
namespace {

using animation::HumanoidMap;
using animation::Role;

constexpr const char* kPosturesOf = "vroid";

// A joint with a little skin before the role's, in the place of the one that they both hang on.
void insertBeside(SyntheticRig& rig, Role role, const char* name) {
    animation::Skeleton& skeleton = rig.character.skeleton;
    const int next = jointOf(rig, role);
    const int above = skeleton.parents[next];
    const auto insert = [&](auto& values, const auto& value) { values.insert(values.begin() + next, value); };
    for (int& parent : skeleton.parents)
        parent += parent >= next ? 1 : 0;
    insert(skeleton.names, name);
    insert(skeleton.parents, above);
    insert(skeleton.bindModelFromJoint, RigidTransform(skeleton.bindModelFromJoint[above]));
    insert(skeleton.nodeParentFromJoint, RigidTransform());
    insert(skeleton.skinWeight, 20.0F);
}

// The same, which the role's then hangs on.
void insertAbove(SyntheticRig& rig, Role role, const char* name) {
    insertBeside(rig, role, name);
    const int below = jointOf(rig, role);
    rig.character.skeleton.parents[below] = below - 1;
}

SyntheticRig crouching(SyntheticRig rig) {
    turnBoth(rig, Role::hips, 0.9F);
    turnBoth(rig, Role::leftUpperLeg, -2.2F);
    turnBoth(rig, Role::leftLowerLeg, 1.9F);
    turn(rig, Role::leftUpperArm, -1.3F, vec3(0, 0, 1));
    turn(rig, Role::rightUpperArm, 0.7F, vec3(0, 1, 0));
    return rig;
}

// Without names, too, the left arm and the left leg are on one side.
void checkOneSide(const SyntheticRig& rig) {
    const animation::Character unnamed = withoutNames(rig.character);
    const HumanoidMap map = animation::mapHumanoid(unnamed);
    REQUIRE(map.humanoid);
    const auto place = [&](Role role) {
        REQUIRE(map.jointOf(role) != animation::kNoJoint);
        return unnamed.skeleton.bindModelFromJoint[map.jointOf(role)].translation.x;
    };
    CHECK(place(Role::leftUpperArm) * place(Role::leftUpperLeg) > 0.0F);
    CHECK(place(Role::rightUpperArm) * place(Role::rightUpperLeg) > 0.0F);
}

}  // namespace

TEST_CASE("a figure that sits cross-legged or crouches maps by its names", "[poses]") {
    SyntheticRig crossed = makeSyntheticRig(kPosturesOf);
    turn(crossed, Role::leftUpperLeg, -1.4F, vec3(1, 0, 0));
    turn(crossed, Role::rightUpperLeg, -1.4F, vec3(1, 0, 0));
    turn(crossed, Role::leftLowerLeg, -1.9F, vec3(0, 1, 0));
    turn(crossed, Role::rightLowerLeg, 1.9F, vec3(0, 1, 0));
    checkWhole(crossed);
    checkWhole(crouching(makeSyntheticRig(kPosturesOf)));
}

TEST_CASE("a figure without joints of hands and feet crouches, too", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kPosturesOf);
    for (const Role role : {Role::leftHand, Role::rightHand, Role::leftFoot, Role::rightFoot})
        cutOff(rig, role);
    checkWhatIsLeft(crouching(std::move(rig)));
}

TEST_CASE("a figure crouches whose hips are called root and carry a half of the pelvis for each leg", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kPosturesOf);
    rig.character.skeleton.names[jointOf(rig, Role::hips)] = "root";
    rig.truth.roles[indexOf(Role::hips)] = std::vector<std::string>{"root"};
    insertAbove(rig, Role::leftUpperLeg, "pelvis.L");
    insertAbove(rig, Role::rightUpperLeg, "pelvis.R");
    checkWhole(crouching(std::move(rig)));
}

TEST_CASE("a figure crouches whose head is called the last joint of its neck", "[poses]") {
    SyntheticRig rig = makeSyntheticRig("xsens");
    rig.character.skeleton.names[jointOf(rig, Role::head)] = "Neck2";
    rig.truth.roles[indexOf(Role::head)] = std::vector<std::string>{"Neck2"};
    checkWhole(crouching(std::move(rig)));
}

TEST_CASE("a figure crouches that could have a tail, whose joints move nothing", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kPosturesOf);
    animation::Skeleton& skeleton = rig.character.skeleton;
    const int hips = jointOf(rig, Role::hips);
    int above = hips;
    for (const char* name : {"mTail1", "mTail2"}) {
        skeleton.names.emplace_back(name);
        skeleton.parents.push_back(above);
        skeleton.bindModelFromJoint.push_back(skeleton.bindModelFromJoint[above]);
        skeleton.bindModelFromJoint.back().translation.z -= 0.2F;
        skeleton.nodeParentFromJoint.push_back({quat(1, 0, 0, 0), vec3(0, 0, -0.2F)});
        skeleton.skinWeight.push_back(0.0F);
        above = skeleton.jointCount() - 1;
    }
    checkWhole(crouching(std::move(rig)));
}

TEST_CASE("a figure crouches, kneels or lies in a coat whose back has joints without names", "[poses]") {
    // Five in the middle hang on the hips, longer than a thigh: no tail, which would lead away behind.
    const auto withCoat = [](SyntheticRig rig, const vec3& start, const vec3& step) {
        animation::Skeleton& skeleton = rig.character.skeleton;
        int above = jointOf(rig, Role::hips);
        vec3 place = skeleton.bindModelFromJoint[above].translation + start;
        for (int i = 0; i < 5; ++i) {
            skeleton.names.push_back("Bone.02" + std::to_string(i));
            skeleton.parents.push_back(above);
            skeleton.bindModelFromJoint.push_back({quat(1, 0, 0, 0), place});
            skeleton.nodeParentFromJoint.emplace_back();
            skeleton.skinWeight.push_back(30.0F);
            above = skeleton.jointCount() - 1;
            place += step;
        }
        return rig;
    };
    const vec3 behind(0, 0, -0.12F);
    checkWhole(withCoat(crouching(makeSyntheticRig(kPosturesOf)), behind, {0, -0.14F, -0.02F}));
    SyntheticRig kneeling = makeSyntheticRig(kPosturesOf);
    turnBoth(kneeling, Role::leftLowerLeg, 1.5F);
    turnBoth(kneeling, Role::hips, 0.9F);
    turnBoth(kneeling, Role::leftUpperLeg, -0.9F);
    checkWhole(withCoat(kneeling, behind, {0, -0.15F, -0.04F}));
    SyntheticRig lying = withCoat(makeSyntheticRig(kPosturesOf), behind, {0, -0.15F, -0.03F});
    turn(lying, Role::leftUpperLeg, -1.2F, vec3(1, 0, 0));
    turn(lying, Role::leftLowerLeg, 1.6F, vec3(1, 0, 0));
    turn(lying, Role::rightUpperArm, 1.1F, vec3(0, 1, 0));
    lying.character = rotated(lying.character, glm::angleAxis(radians(-75.0F), vec3(1, 0, 0)));
    checkWhole(lying);
}

TEST_CASE("legs that are crossed at the knees are on the sides of their thighs", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kPosturesOf);
    turn(rig, Role::leftUpperLeg, -0.75F, vec3(0, 0, 1));
    turn(rig, Role::rightUpperLeg, 0.7F, vec3(0, 0, 1));
    checkWhole(rig);
    checkOneSide(rig);
}

TEST_CASE("a shoulder that an elbow hangs on is the upper arm, whatever else hangs there", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kPosturesOf);
    const auto call = [&](Role role, const char* name) {
        rig.character.skeleton.names[jointOf(rig, role)] = name;
        rig.truth.roles[indexOf(role)] = std::vector<std::string>{name};
    };
    call(Role::leftShoulder, "mCollarLeft");
    call(Role::leftUpperArm, "mShoulderLeft");
    call(Role::leftLowerArm, "mElbowLeft");
    call(Role::rightShoulder, "mCollarRight");
    call(Role::rightUpperArm, "mShoulderRight");
    call(Role::rightLowerArm, "mElbowRight");
    insertBeside(rig, Role::leftLowerArm, "L_UPPER_ARM");
    insertBeside(rig, Role::rightLowerArm, "R_UPPER_ARM");
    checkWhole(crouching(std::move(rig)));
}

TEST_CASE("a figure that lies in some pose maps by its names", "[poses]") {
    SyntheticRig rig = makeSyntheticRig(kPosturesOf);
    turn(rig, Role::leftUpperLeg, -1.2F, vec3(1, 0, 0));
    turn(rig, Role::leftLowerLeg, 1.6F, vec3(1, 0, 0));
    turn(rig, Role::rightUpperArm, 1.1F, vec3(0, 1, 0));
    turn(rig, Role::neck, 0.9F, vec3(0, 0, 1));
    rig.character = rotated(rig.character, glm::angleAxis(radians(-75.0F), vec3(1, 0, 0)));
    checkWhole(rig);
}

}  // namespace lutka::test
