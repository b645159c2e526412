#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "animation/character.hpp"
#include "animation/humanoid/map_humanoid.hpp"
#include "animation/retarget/finger_chains.hpp"
#include "animation/retarget/limb_ends.hpp"
#include "core/result.hpp"

namespace lutka::animation {

/// A figure's joints with axes that mean the same in every figure, whatever its file's joint axes and bind pose.
///
/// In the bind pose, in standard space (HumanoidMap::standardFromModel: +Y up, facing +Z, left at +X), each role has
/// anatomical axes, of which x points along its bone. Arms begin from a T-pose: from the direction to the side each
/// bone is turned the shortest way to the one above it and on to itself, so that a T-pose and an A-pose have the same
/// axes but for the turn between them. Legs do so from straight down. The trunk, neck and shoulders share one frame: x
/// to the left along hips and shoulders, y from the hips to the neck. The head's is upright, and the feet's are x ahead
/// along the level sole, y up.
struct AnatomicalRig {
    /// A joint of the trunk; all on the way from the hips to the neck, in order, mapped or not.
    struct TrunkJoint {
        int joint = kNoJoint;
        float at = 0.0F;  ///< Share of the way from hips to neck, [0, 1).
        quat jointFromAnatomy{1, 0, 0, 0};
    };
    struct Foot {
        int joint = kNoJoint;
        vec3 ballInFoot{0, 0, 0};  ///< Where the toes begin; ahead on the sole in a figure without toes.
        float ankleHeight = 0.0F;  ///< Over the sole in the bind pose, metres.
        float ballHeight = 0.0F;
        vec3 upInJoint{0, 1, 0};  ///< Up from the sole, in the foot's joint.

        /// The ball in a pose of all joints, in that pose's space.
        [[nodiscard]] vec3 ballIn(std::span<const RigidTransform> pose) const { return pose[joint] * ballInFoot; }
    };
    struct FingerJoint {
        int joint = kNoJoint;
        quat jointFromAnatomy{1, 0, 0, 0};
    };

    std::shared_ptr<const Skeleton> skeleton;  ///< With the ends of limbs that were added (LimbEnds).
    int fileJoints = 0;                        ///< The first of its joints, those of the file.
    std::vector<StiffLimb> stiffLimbs;
    quat standardFromModel{1, 0, 0, 0};
    std::array<int, kRoleCount> joint{};
    std::array<quat, kRoleCount> jointFromAnatomy{};                            ///< Of the roles that have a joint.
    std::vector<TrunkJoint> trunk;                                              ///< Begins with the hips.
    std::array<Foot, 2> feet;                                                   ///< Left, right.
    std::array<std::array<std::vector<FingerJoint>, kFingerCount>, 2> fingers;  ///< Left, right.
    float floor = 0.0F;                        ///< Standard height of the soles in the bind pose, its own or added.
    float legLength = 0.0F;                    ///< From the hip joint over the knee to the ankle, mean of both, metres.
    std::vector<RigidTransform> standardBind;  ///< Standard from joint in the bind pose, one a joint.

    [[nodiscard]] int jointOf(Role role) const { return joint[indexOf(role)]; }
    [[nodiscard]] bool has(Role role) const { return jointOf(role) != kNoJoint; }
    [[nodiscard]] vec3 bindOf(Role role) const { return standardBind[jointOf(role)].translation; }
    /// Whether the role's joint was added.
    [[nodiscard]] bool isAdded(Role role) const { return jointOf(role) >= fileJoints; }
    /// Whether a leg has no knee of its own.
    [[nodiscard]] bool hasStiffLegs() const {
        return std::any_of(stiffLimbs.begin(), stiffLimbs.end(), [](const StiffLimb& limb) { return limb.leg; });
    }
    /// Whether the figure has legs of its own.
    [[nodiscard]] bool hasLegs() const { return !isAdded(Role::leftUpperLeg); }
    /// Of the ankles over the soles, mean of both.
    [[nodiscard]] float ankleHeight() const { return (feet[0].ankleHeight + feet[1].ankleHeight) * 0.5F; }
    /// The neck, or the head of a figure without one.
    [[nodiscard]] int neckOrHead() const { return has(Role::neck) ? jointOf(Role::neck) : jointOf(Role::head); }
};

/// The height in standard space of what a figure stands on in its bind pose, metres: the lowest of its skin, or of what
/// hangs on its feet where the skin says nothing of it. The origin of a file may be elsewhere: in BVH it is mostly at
/// the hips.
[[nodiscard]] float floorOf(const Character& character, const HumanoidMap& map);

/// Fails with ErrorCode::input when the map is none of a humanoid, lacks a role other than an arm's that addLimbEnds()
/// can't add, or a leg has no length. `character` must outlive the rig.
[[nodiscard]] Result<AnatomicalRig> makeAnatomicalRig(const Character& character, const HumanoidMap& map);

/// Which role a limb's bone ends at; nothing for those whose end is no role's joint.
[[nodiscard]] std::optional<Role> endOfBone(Role role);

}  // namespace lutka::animation
