#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/rigid_transform.hpp"
#include "physics/fit/skin_point.hpp"

namespace lutka::physics {

struct Capsule;

/// A box in the standard stance's axes, metres.
struct PlacedBox {
    RigidTransform standardFromBox;  ///< From its middle.
    vec3 halfExtents{0, 0, 0};
};

/// What a box for one body must keep to.
struct BoxBounds {
    quat standardFromAxes{1, 0, 0, 0};  ///< The box's axes, but for a turn about `turnAxis` that the search finds.
    vec3 turnAxis{0, 1, 0};             ///< In the box's axes: x or y.
    bool alsoUpright = false;  ///< A box may stand along the standard stance's axes, where that is clearly nearer.
    bool symmetric = false;    ///< Its middle stands at x = middleX.
    float middleX = 0.0F;
    float smallestHalf = 0.01F;  ///< Metres.
    float largestHalf = 1.0F;    ///< Metres.
    float cutoff = 0.1F;         ///< Metres: skin farther from the surface counts no more than that.
    float nearM = 0.02F;         ///< Metres: skin nearer to the surface counts as covered.
};

/// A box in place of `capsule` where the skin is a block, as in figures made of blocks. All of this must hold:
/// - the skin's mean distance from the box's surface is at most half of that from the capsule's, or a quarter where the
///   box brings less than 0.15 of the skin to within `nearM`;
/// - that distance is at most 0.12 of the box's smallest half extent, which no round part keeps to;
/// - at least 0.9 of the skin is within `nearM`;
/// - the box is at least 0.4 as thick as it is wide: thin plates slip through one another.
///
/// The search tries 18 turns in a quarter about the axis, each with the box of the skin's quantiles, and takes the
/// nearest. A coordinate search over middle and half extents follows. A limb whose joints lie at the corners of its
/// blocks has its box upright.
[[nodiscard]] std::optional<PlacedBox> fitBox(const std::vector<SkinPoint>& points, const Capsule& capsule,
                                              const BoxBounds& bounds);

}  // namespace lutka::physics
