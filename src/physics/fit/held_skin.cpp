#include "physics/fit/held_skin.hpp"

#include "animation/segments/appendages.hpp"

namespace lutka::physics {
namespace {

bool isArmWithoutHand(Role role) {
    return isEitherSide(role, Role::leftUpperArm) || isEitherSide(role, Role::leftLowerArm);
}

}  // namespace

std::vector<bool> jointsOfHeldWeapons(const BodyPlan& plan, const animation::Character& character,
                                      const animation::HumanoidMap& map) {
    constexpr float kFewest = 8.0F;  // vertices that the body keeps
    const animation::Skeleton& skeleton = character.skeleton;
    std::vector<bool> held(plan.bodyOfJoint.size(), false);
    if (!map.humanoid) return held;
    for (const animation::Appendage& appendage : animation::findAppendages(character, map)) {
        if (appendage.kind != animation::AppendageKind::weapon || !isArmWithoutHand(appendage.role)) continue;
        const int body = plan.bodyOfJoint[static_cast<std::size_t>(appendage.joint)];
        if (body < 0 || plan.bodies[body].segment) continue;
        float own = 0.0F;
        for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
            const bool weapon = animation::isAncestorOrSelf(skeleton, appendage.joint, joint);
            if (plan.bodyOfJoint[static_cast<std::size_t>(joint)] == body && !weapon) own += skeleton.skinWeight[joint];
        }
        for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
            if (own >= kFewest && animation::isAncestorOrSelf(skeleton, appendage.joint, joint))
                held[static_cast<std::size_t>(joint)] = true;
        }
    }
    return held;
}

}  // namespace lutka::physics
