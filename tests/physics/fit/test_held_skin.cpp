#include "physics/fit/held_skin.hpp"

#include <string>
#include <utility>

#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;

TEST_CASE("two weapons on one arm are both held, or both its skin where it has no other") {
    const bool hasOwn = GENERATE(false, true);
    auto biped = test::makeBiped();
    auto map = test::mapOfBiped(biped);
    for (const Role role : {Role::rightLowerArm, Role::rightHand})
        map.roles[animation::indexOf(role)].reset();
    const int arm = map.jointOf(Role::rightUpperArm);
    std::vector<animation::Appendage> weapons;
    for (int i = 0; i < 2; ++i) {
        animation::Skeleton& skeleton = biped.skeleton;
        const RigidTransform beside{quat(1, 0, 0, 0), {-0.5F, 0, 0.1F}};
        skeleton.names.push_back("weapon");
        skeleton.parents.push_back(arm);
        skeleton.bindModelFromJoint.push_back(skeleton.bindModelFromJoint[arm] * beside);
        skeleton.nodeParentFromJoint.push_back(beside);
        skeleton.skinWeight.push_back(20.0F);
        animation::Appendage& weapon = weapons.emplace_back();
        weapon.kind = animation::AppendageKind::weapon;
        weapon.role = Role::rightUpperArm;
        weapon.joint = biped.skeleton.jointCount() - 1;
    }
    const BodyPlan plan = planBodies(biped, map, FitOptions{}, {});
    if (!hasOwn) {
        const int body = plan.bodyOf(Role::rightUpperArm);
        for (int joint = 0; joint < biped.skeleton.jointCount() - 2; ++joint) {
            if (plan.bodyOfJoint[static_cast<std::size_t>(joint)] == body) biped.skeleton.skinWeight[joint] = 0.0F;
        }
    }
    const std::vector<bool> held = jointsOfHeldWeapons(plan, biped, weapons);
    for (const animation::Appendage& weapon : weapons)
        CHECK(held[static_cast<std::size_t>(weapon.joint)] == hasOwn);
}

TEST_CASE("what a hand holds is none of its skin where it is a rigid mesh, and where the hand has a skin") {
    const bool isRigid = GENERATE(false, true);
    const bool hasOwn = GENERATE(false, true);
    auto biped = test::makeBiped();
    const auto map = test::mapOfBiped(biped);
    const int hand = map.jointOf(Role::rightHand);
    animation::Skeleton& skeleton = biped.skeleton;
    const RigidTransform below{quat(1, 0, 0, 0), {-0.05F, 0, 0}};
    for (const char* const name : {"fist", "sword"}) {
        const int parent = name == std::string("fist") ? hand : skeleton.jointCount() - 1;
        skeleton.names.emplace_back(name);
        skeleton.parents.push_back(parent);
        skeleton.bindModelFromJoint.push_back(skeleton.bindModelFromJoint[parent] * below);
        skeleton.nodeParentFromJoint.push_back(below);
        skeleton.skinWeight.push_back(40.0F);
    }
    const int fist = skeleton.jointCount() - 2;
    const int sword = skeleton.jointCount() - 1;
    for (const int joint : {fist, sword}) {
        animation::SkinnedMesh mesh;
        mesh.rigid = joint == sword && isRigid;
        mesh.positions.assign(3, skeleton.bindModelFromJoint[joint].translation);
        mesh.joints.assign(3, {static_cast<std::uint16_t>(joint), 0, 0, 0});
        mesh.weights.assign(3, {1, 0, 0, 0});
        mesh.indices = {0, 1, 2};
        biped.meshes.push_back(std::move(mesh));
    }
    const BodyPlan plan = planBodies(biped, map, FitOptions{}, {});
    const int body = plan.bodyOf(Role::rightHand);
    for (int joint = 0; joint < sword && !hasOwn; ++joint) {
        if (plan.bodyOfJoint[static_cast<std::size_t>(joint)] == body) skeleton.skinWeight[joint] = 0.0F;
    }
    animation::Appendage weapon;  // the branch holds the fist as well
    weapon.kind = animation::AppendageKind::weapon;
    weapon.role = Role::rightHand;
    weapon.joint = fist;
    const std::vector<bool> held = jointsOfHeldWeapons(plan, biped, {&weapon, 1});
    CHECK_FALSE(held[static_cast<std::size_t>(fist)]);
    CHECK(held[static_cast<std::size_t>(sword)] == (isRigid && hasOwn));
}
