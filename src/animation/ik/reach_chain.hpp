#pragma once

#include <span>

#include "animation/ik/two_bone.hpp"

namespace lutka::animation {

/// A chain of any number of joints, such as a spine or a tail, that is to bring a point to a target.
struct ReachChain {
    std::span<const int> joints;  ///< Those that turn, from the top down, each below the one before it.
    int tip = kNoJoint;           ///< The joint whose point is brought; the last of them or below it.
    vec3 pointInTip{0, 0, 0};
    std::span<const SwingTwistRange> ranges;  ///< One a joint, or empty: free.
    std::span<const float> stiffness;         ///< One a joint, [0, 1): 0 gives way fully; empty: all 0.
};

struct ReachSettings {
    float toleranceM = 5e-4F;
    int mostPasses = 128;
    float softness = 0.02F;  ///< As TwoBoneGoal's, where the target is out of reach.
};

/// Cyclic coordinate descent (Wang and Chen 1991) with limits: pass after pass each joint, from the tip up, turns half
/// of what would point the tip at the target, within its range. Half, because whole turns curl the joints by the tip
/// and leave the others. In place on a parent-relative pose; only rotations of `joints` change. `target` in model
/// space. Pure and without allocation. A straight chain doesn't bend towards a target on its own line.
Reached solveReachChain(const Skeleton& skeleton, const ReachChain& chain, const vec3& target,
                        std::span<RigidTransform> parentFromJoint, const ReachSettings& settings = {});

}  // namespace lutka::animation
