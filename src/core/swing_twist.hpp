#pragma once

#include "core/math.hpp"

namespace lutka {

/// A rotation taken apart as swing · twist: the twist about x first, then the swing, whose axis lies across x.
struct SwingTwist {
    vec3 swing{0, 0, 0};  ///< Rotation vector in the parent frame, x = 0, length in [0, pi].
    float twist = 0.0F;   ///< Radians about x, in [-pi, pi].
};

/// `rotation`: of a child frame in its parent frame. At a swing of half a turn the twist is undetermined and
/// comes back as 0.
[[nodiscard]] SwingTwist swingTwist(const quat& rotation);
[[nodiscard]] quat rotationOf(const SwingTwist& parts);

}  // namespace lutka
