#include "physics/fit/held_skin.hpp"

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
