#pragma once

#include <optional>
#include <span>

#include "animation/ik/swing_twist_range.hpp"
#include "animation/skeleton.hpp"

namespace lutka::animation {

/// An arm or a leg: two bones from `upper` over `middle` to `end`, each joint somewhere below the one before it. Joints
/// between them are carried along as they are.
struct TwoBone {
    int upper = kNoJoint;
    int middle = kNoJoint;
    int end = kNoJoint;
    vec3 bendInUpper{0, 0, 1};  ///< Unit, in the upper joint's frame: where the middle joint goes when the limb bends
                                ///< from straight. Read where the pose is too straight to show it.
    float leastFlexion = 0.0F;  ///< Of the middle joint, the angle between the bones, 0 = straight; radians.
    float mostFlexion = radians(165.0F);
    std::optional<SwingTwistRange> range;  ///< Of the upper joint.
};

/// Model space, metres.
struct TwoBoneGoal {
    vec3 target{0, 0, 0};             ///< Where the end joint is to be.
    std::optional<vec3> pole;         ///< The direction that the middle joint bends towards; unset: the pose's own.
    std::optional<quat> endRotation;  ///< modelFromEnd to be had; unset: it goes with the lower bone.
    float softness = 0.02F;           ///< Of the limb's length, what softlyClamped() takes; 0: hard.
};

/// What came of a solve.
struct Reached {
    float errorM = 0.0F;  ///< From the target.
};

/// Bends the limb to the target (law of cosines), in place on a parent-relative pose of jointCount() frames. Only the
/// rotations of upper and middle joint change, and the end's with `endRotation`; the way of least turning is taken
/// about the limb. Where flexion or the target are out of reach the limb comes softly to its end; where the upper
/// joint's range forbids the pose, the joint stays on its edge and the end misses. Pure: the same input gives the same
/// bits; continuous in the target but where it meets the upper joint or the line of the pole.
Reached solveTwoBone(const Skeleton& skeleton, const TwoBone& limb, const TwoBoneGoal& goal,
                     std::span<RigidTransform> parentFromJoint);

/// The same for three points, without a skeleton: how the bones turn, in the points' own space. Points that coincide
/// give no turns.
struct BoneTurns {
    quat upper{1, 0, 0, 0};  ///< About `start`, of the bone start–middle.
    quat lower{1, 0, 0, 0};  ///< Of the bone middle–end, in all (not on top of the upper one).
    vec3 end{0, 0, 0};       ///< Where the end comes to.
};
struct BonePoints {
    vec3 start, middle, end;
};
/// `bend` is TwoBone::bendInUpper in the points' space, of any length above zero.
[[nodiscard]] BoneTurns turnsToReach(const BonePoints& points, const TwoBone& limb, const vec3& bend,
                                     const TwoBoneGoal& goal);

}  // namespace lutka::animation
