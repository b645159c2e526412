#pragma once

#include <array>

#include "physics/profile/profile.hpp"

namespace lutka::exporting {

/// A cone-twist joint as three hinges in a row, for engines whose ball joints have no elliptic cone: two that swing
/// about the frame's y and z, then one that twists about x. R = R(first) · R(second) · R_x(twist).
///
/// The swing's ellipse becomes an octagon about it in the plane of the two swing angles: a range a hinge, and two sums
/// of both. An engine without limits of sums has the rectangle alone. Three hinges in a row lock where the second
/// stands at a right angle, so the narrower swing is the second.
struct ThreeHinges {
    bool yFirst = true;  ///< Order of the swings: y then z, or z then y.
    float firstMax = 0;  ///< Radians: the first stays in [-firstMax, firstMax].
    float secondMax = 0;
    float twistMax = 0;

    /// Sums that stay in [-1, 1]: first · sumFirst ± second · sumSecond.
    float sumFirst = 0;
    float sumSecond = 0;

    // How far this goes past the ellipse, radians: with the sums, and with the rectangle alone.
    float octagonExcess = 0;
    float rectangleExcess = 0;
    /// Two swings in a row also turn about x, against a swing about one axis: at most by this within the ellipse.
    float twistError = 0;
};
[[nodiscard]] ThreeHinges threeHinges(const physics::ConeTwistLimits& limits);

/// The angles of first swing, second swing and twist that make the rotation, radians. Of the two sets that do, the one
/// with the smaller swings.
[[nodiscard]] std::array<float, 3> hingeAngles(const quat& rotation, bool yFirst);
[[nodiscard]] quat rotationOfHinges(const std::array<float, 3>& angles, bool yFirst);

}  // namespace lutka::exporting
