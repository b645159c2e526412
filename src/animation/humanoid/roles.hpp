#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace lutka::animation {

/// The body parts of the VRM 1.0 humanoid (without eyes and jaw), left being the character's own left.
enum class Role {
    hips,
    spine,
    chest,
    upperChest,
    neck,
    head,
    leftShoulder,
    leftUpperArm,
    leftLowerArm,
    leftHand,
    leftUpperLeg,
    leftLowerLeg,
    leftFoot,
    leftToes,
    rightShoulder,
    rightUpperArm,
    rightLowerArm,
    rightHand,
    rightUpperLeg,
    rightLowerLeg,
    rightFoot,
    rightToes,
};
inline constexpr int kRoleCount = 22;

enum class Side { center, left, right };

[[nodiscard]] constexpr Side otherSide(Side side) {
    return side == Side::left ? Side::right : side == Side::right ? Side::left : Side::center;
}

[[nodiscard]] constexpr Role roleAt(int index) {
    return static_cast<Role>(index);
}
[[nodiscard]] constexpr int indexOf(Role role) {
    return static_cast<int>(role);
}

/// In the extras of a glTF node that we write: the role that the file which the figure came from told of it.
inline constexpr const char* kRoleExtra = "lutkaRole";

/// "leftUpperArm" …, the VRM name.
[[nodiscard]] std::string_view roleName(Role role);
[[nodiscard]] std::optional<Role> roleFromName(std::string_view name);

[[nodiscard]] Side sideOf(Role role);
/// leftX ↔ rightX; the middle ones are their own mirror.
[[nodiscard]] Role mirrored(Role role);

/// Whether it is `left` or its counterpart on the right.
[[nodiscard]] bool isEitherSide(Role role, Role left);
/// spine, chest or upperChest.
[[nodiscard]] bool isSpine(Role role);
/// hips or one of the spine.
[[nodiscard]] bool isTrunk(Role role);

/// hips, spine, head and, on both sides, upper and lower arm, hand, upper and lower leg, foot.
[[nodiscard]] bool isRequired(Role role);

/// The role above this one in a whole humanoid (spine → hips, leftHand → leftLowerArm); nothing for hips.
/// A ragdoll walks up this tree to the nearest role that has a body.
[[nodiscard]] std::optional<Role> parentRole(Role role);

}  // namespace lutka::animation
