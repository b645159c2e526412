#pragma once

#include "core/math.hpp"

namespace lutka::animation {

/// How far a joint may turn from a neutral pose: its rotation is taken apart as swing · twist, the twist about the limb
/// first, then the swing across it (as physics::ConeTwistLimits does). Angles in radians.
struct SwingTwistRange {
    quat parentFromNeutral{1, 0, 0, 0};  ///< The range's axes in the joint's parent: x along the limb.
    quat jointFromNeutral{1, 0, 0, 0};   ///< The same axes in the joint, which lie on the others in the neutral pose.
    float mostSwingY = kPi;              ///< Semi-axes of the ellipse that bounds the swing's rotation vector, > 0.
    float mostSwingZ = kPi;
    float leastTwist = -kPi;  ///< <= 0
    float mostTwist = kPi;    ///< >= 0
};

/// The rotation of the range that is nearest in swing and in twist: continuous but at a swing of half a turn. A
/// rotation within the range comes back as it is.
[[nodiscard]] quat clampedTo(const SwingTwistRange& range, const quat& parentFromJoint);

/// How far outside of the range a rotation is: the larger of swing and twist, radians; 0 inside.
[[nodiscard]] float excessOf(const SwingTwistRange& range, const quat& parentFromJoint);

/// `value` where it lies deep within [low, high]; nearer to an end than `softness` it comes ever slower towards that
/// end, which it never reaches: end - s·exp(-(value - (end - s)) / s), continuous with its first derivative (Nicholson
/// 2008, "Soft IK"). `softness` 0 clamps hard; it is cut to a quarter of the interval.
[[nodiscard]] float softlyClamped(float value, float low, float high, float softness);

}  // namespace lutka::animation
