#pragma once

#include <optional>
#include <vector>

#include "core/rigid_transform.hpp"
#include "physics/fit/fit_shapes.hpp"
#include "physics/fit/skin_point.hpp"

namespace lutka::physics {

/// What several capsules for one body must keep to.
struct CapsuleBounds {
    RigidTransform standardFromAxes;  ///< Capsules lie along these axes: x across, y up, z ahead; near the skin.
    bool symmetric = false;           ///< They stand in the plane x = 0 of the axes, or in pairs beside it.
    float smallestRadius = 0.01F;     ///< Metres.
    float largestRadius = 1.0F;       ///< Metres.
    float cutoff = 0.1F;              ///< Metres: skin farther from the surface counts no more than that.
    float nearM = 0.02F;              ///< Metres: skin nearer to the surface counts as covered.
};

/// Two or three capsules in place of `single` where their union lies clearly nearer to the skin: its mean distance is
/// at most 0.65 of the single one's, the share of the skin within `nearM` a tenth of all the skin more, and they hold
/// no less of what the skin encloses, but for 2 %. A third must do as much as to leave 0.8 of the distance of two. The
/// first is the largest, or the one between a pair. At most `most` of them, 2 or 3.
///
/// A coordinate search over centres, half lengths and radii of all together, from one that stands or lies across and
/// others where it leaves skin uncovered.
[[nodiscard]] std::optional<std::vector<Capsule>> fitSeveralCapsules(const std::vector<SkinPoint>& points,
                                                                     const Capsule& single, const CapsuleBounds& bounds,
                                                                     int most);

}  // namespace lutka::physics
