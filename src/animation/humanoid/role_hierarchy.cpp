#include "animation/humanoid/role_hierarchy.hpp"

#include "core/assert.hpp"

namespace lutka::animation {
namespace {

bool isRoleAbove(Role role, Role other) {
    std::optional<Role> above = parentRole(role);
    while (above && *above != other)
        above = parentRole(*above);
    return above.has_value();
}

// The trunk and what continues it carry all limbs in some rigs, and a foot may hang below its own toes' control.
bool isLimbOfOthers(Role other, Role role) {
    if (isTrunk(other) || other == Role::neck || other == Role::head) return false;
    return !isEitherSide(other, Role::leftToes) || sideOf(other) != sideOf(role);
}

}  // namespace

Hanging hangingOf(const HumanoidMap& map, std::span<const int> parents, Role role, Role above) {
    const int joint = map.jointOf(role);
    const int parent = map.jointOf(above);
    LUTKA_ASSERT(joint != kNoJoint && parent != kNoJoint);
    if (joint != parent && isAncestorOrSelf(parents, joint, parent)) return Hanging::reversed;
    for (int index = 0; index < kRoleCount; ++index) {
        const Role other = roleAt(index);
        const int top = map.jointOf(other);
        if (top == kNoJoint || top == joint || !isLimbOfOthers(other, role) || isRoleAbove(role, other)) continue;
        if (isAncestorOrSelf(parents, top, joint)) return Hanging::astray;
    }
    return isAncestorOrSelf(parents, parent, joint) ? Hanging::below : Hanging::beside;
}

bool hangsFlat(const HumanoidMap& map, std::span<const int> parents) {
    int bound = 0;
    int beside = 0;
    for (int index = 0; index < kRoleCount; ++index) {
        const std::optional<Role> above = parentRole(roleAt(index));
        bound += map.roles[index] ? 1 : 0;
        if (!map.roles[index] || !above || !map[*above]) continue;
        beside += hangingOf(map, parents, roleAt(index), *above) == Hanging::beside ? 1 : 0;
    }
    return 2 * beside > bound;
}

}  // namespace lutka::animation
