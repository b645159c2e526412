#include "animation/humanoid/stray_joints.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "animation/humanoid/limb_evidence.hpp"

namespace lutka::animation {
namespace {

constexpr float kLeastOfOther = 0.5F;  // of the segment's length on the other side
constexpr float kMostOfOther = 2.0F;

bool isTaken(const HumanoidMap& map, int joint) {
    return std::any_of(map.roles.begin(), map.roles.end(),
                       [&](const auto& binding) { return binding && binding->joint == joint; });
}

// The only joint without a role that is named as the role's part on the role's side; kNoJoint with none or several.
int onlyNamed(const RigFeatures& rig, const HumanoidMap& map, Role role) {
    int found = kNoJoint;
    for (int joint = 0; joint < rig.count(); ++joint) {
        const NameEvidence& name = rig.names[joint];
        const bool fits = name.meaningful && name.side == sideOf(role) && !name.helper && !name.control &&
                          name.parts[partOf(role)] >= limb_bounds::kNamedPart;
        if (!fits || rig.shadow[joint] || !rig.carriesSkin(joint) || isTaken(map, joint)) continue;
        if (found != kNoJoint) return kNoJoint;
        found = joint;
    }
    return found;
}

float lengthOf(const RigFeatures& rig, int from, int to) {
    return glm::distance(rig.positions[from], rig.positions[to]);
}

bool isAsFarAsOnOtherSide(const RigFeatures& rig, const HumanoidMap& map, Role role, Role above, int joint) {
    const int other = map.jointOf(mirrored(role));
    const int otherAbove = map.jointOf(mirrored(above));
    if (other == kNoJoint || otherAbove == kNoJoint) return true;
    const float expected = lengthOf(rig, otherAbove, other);
    const float length = lengthOf(rig, map.jointOf(above), joint);
    return length >= kLeastOfOther * expected && length <= kMostOfOther * expected;
}

}  // namespace

void bindStrayJoints(const RigFeatures& rig, float confidence, HumanoidMap& map) {
    for (int index = 0; index < kRoleCount; ++index) {
        const Role role = roleAt(index);
        const std::optional<Role> above = parentRole(role);
        if (map.roles[index] || !isRequired(role) || sideOf(role) == Side::center || !above || !map[*above]) continue;
        const NameEvidence& nameAbove = rig.names[map.jointOf(*above)];
        if (nameAbove.side != Side::center && sideOf(*above) != Side::center && nameAbove.side != sideOf(role))
            continue;
        const int joint = onlyNamed(rig, map, role);
        // "leg" above "leg.001" and "leg.002" is where the leg starts, and no foot.
        if (joint == kNoJoint || rig.isAncestorOrSelf(joint, map.jointOf(*above))) continue;
        if (!isAsFarAsOnOtherSide(rig, map, role, *above, joint)) continue;
        map.roles[index] = RoleBinding{joint, confidence, "the only joint with such a name, though it hangs elsewhere"};
    }
}

}  // namespace lutka::animation
