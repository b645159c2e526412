#pragma once

#include <array>
#include <span>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "animation/skeleton.hpp"

namespace lutka::animation {

/// How much of a layer each joint takes: 0 none of it, 1 all.
struct JointMask {
    std::vector<float> weights;  ///< One a joint, [0, 1]; empty: all 1.

    [[nodiscard]] float operator[](std::size_t joint) const { return weights.empty() ? 1.0F : weights[joint]; }
};

/// The joints and all that hangs below them.
[[nodiscard]] JointMask maskBelow(const Skeleton& skeleton, std::span<const int> joints);

/// Each joint has the weight of its own role, else of the nearest joint above it that has one; 0 above the hips. A
/// joint of two roles (hips and spine in one) has the weight of the first.
[[nodiscard]] JointMask maskOfRoles(const Skeleton& skeleton, const HumanoidMap& map,
                                    const std::array<float, kRoleCount>& weightOfRole);

/// Spine, chest, neck, head and arms with what hangs on them; neither hips nor legs.
[[nodiscard]] JointMask upperBodyMask(const Skeleton& skeleton, const HumanoidMap& map);

/// One minus the mask; an empty one becomes all zeros of `joints` joints.
[[nodiscard]] JointMask inverted(const JointMask& mask, int joints);

}  // namespace lutka::animation
