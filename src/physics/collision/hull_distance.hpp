#pragma once

#include "physics/collision/shape_distance.hpp"
#include "physics/profile/convex_hull.hpp"

namespace lutka::physics {

/// Signed distance of a point from the surface of a hull, both in the hull's frame (negative inside), and the unit
/// outward normal there.
[[nodiscard]] SurfaceDistance distanceToHull(const vec3& point, const ConvexHull& hull);

/// What touchBox() is for a box.
[[nodiscard]] CoreTouches touchHull(const Segment& core, const ConvexHull& hull, float reach);

/// What deepestOnSegment() is for a box.
[[nodiscard]] float deepestOnSegment(const Segment& segment, const ConvexHull& hull, int halvings = 16);

/// A hull of few corners in place of that of many points.
struct ReducedHull {
    ConvexHullPtr hull;      ///< Null where the points are flat.
    float deviation = 0.0F;  ///< Metres: how far the farthest of the points lies outside of it.
};
/// The hull of at most `most` of the points (in [4, kMostPoints]): those farthest outside of the hull of the ones
/// before, until none lies farther out than `tolerance` metres.
[[nodiscard]] ReducedHull reduceHull(std::span<const vec3> points, float tolerance, int most = ConvexHull::kMostPoints);

}  // namespace lutka::physics
