#include "physics/fit/held_skin.hpp"

#include "animation/carrying_joints.hpp"

namespace lutka::physics {
namespace {

bool isArmWithoutHand(Role role) {
    return isEitherSide(role, Role::leftUpperArm) || isEitherSide(role, Role::leftLowerArm);
}

}  // namespace

std::vector<bool> jointsOfHeldWeapons(const BodyPlan& plan, const animation::Character& character,
                                      std::span<const animation::Appendage> appendages) {
    constexpr float kFewest = 8.0F;  // vertices that the body keeps
    const animation::Skeleton& skeleton = character.skeleton;
    std::vector<bool> held(plan.bodyOfJoint.size(), false);
    const animation::CarryingJoints carrying = animation::carryingJoints(character);
    // All that hangs on the joint is rigid meshes, a model of their own each.
    const auto isModel = [&](std::size_t joint) { return carrying.rigid[joint] && !carrying.skin[joint]; };
    // All weapons of an arm first: none is the arm's own skin beside another.
    for (const animation::Appendage& appendage : appendages) {
        // A hand may be a part of the branch that ends in a weapon: only what is a model of its own is held.
        const bool hand = isEitherSide(appendage.role, Role::leftHand);
        if (appendage.kind != animation::AppendageKind::weapon || !(hand || isArmWithoutHand(appendage.role))) continue;
        const int body = plan.bodyOfJoint[static_cast<std::size_t>(appendage.joint)];
        if (body < 0 || plan.bodies[body].segment) continue;
        for (std::size_t joint = 0; joint < held.size(); ++joint) {
            if (plan.bodyOfJoint[joint] == body && (!hand || isModel(joint)) &&
                animation::isAncestorOrSelf(skeleton, appendage.joint, static_cast<int>(joint)))
                held[joint] = true;
        }
    }
    std::vector<float> own(plan.bodies.size(), 0.0F);
    for (std::size_t joint = 0; joint < held.size(); ++joint) {
        if (!held[joint] && plan.bodyOfJoint[joint] >= 0)
            own[static_cast<std::size_t>(plan.bodyOfJoint[joint])] += skeleton.skinWeight[joint];
    }
    for (std::size_t joint = 0; joint < held.size(); ++joint)
        held[joint] = held[joint] && own[static_cast<std::size_t>(plan.bodyOfJoint[joint])] >= kFewest;
    return held;
}

}  // namespace lutka::physics
