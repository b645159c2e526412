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

/// A box in place of `capsule` where the skin is one, as the parts of figures made of blocks are: its mean distance
/// from the box's surface is at most half of that from the capsule's (a quarter, where no 0.15 of the skin come within
/// `nearM` that were not), and at most 0.12 of the box's thinnest half, which no round part keeps to; at least 0.9 of
/// the skin is within `nearM`. Plates, thinner than 0.4 of their width, stay capsules: they slip through one another.
///
/// The turn is the one of 18 in a quarter about the axis whose box of the skin's quantiles is nearest (a limb whose
/// joints lie at the corners of its blocks has its box upright); then a coordinate search over middle and half extents.
[[nodiscard]] std::optional<PlacedBox> fitBox(const std::vector<SkinPoint>& points, const Capsule& capsule,
                                              const BoxBounds& bounds);

}  // namespace lutka::physics
