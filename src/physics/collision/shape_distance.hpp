#pragma once

#include <utility>

#include "core/rigid_transform.hpp"

namespace lutka::physics {

/// Contacts of one pair that are nearer to each other than this say the same, metres.
inline constexpr float kSamePlace = 0.005F;

/// A line segment; a sphere's centre is one of length 0.
struct Segment {
    vec3 start{0, 0, 0};
    vec3 end{0, 0, 0};

    [[nodiscard]] vec3 at(float t) const { return start + t * (end - start); }
};

/// The closest points of two segments, as fractions of each in [0, 1] (Ericson, Real-Time Collision Detection, 5.1.9).
struct SegmentPair {
    float s = 0.0F;
    float t = 0.0F;
};
[[nodiscard]] SegmentPair closestBetweenSegments(const Segment& a, const Segment& b);

/// Signed distance of a point from the surface of a box centred at the origin (negative inside) and the unit outward
/// normal there.
struct SurfaceDistance {
    float distance = 0.0F;
    vec3 normal{0, 1, 0};
};
[[nodiscard]] SurfaceDistance distanceToBox(const vec3& point, const vec3& halfExtents);

/// The fraction along the segment, in [0, 1], where its signed distance from the box is least. The distance is a convex
/// function along a line, so that halving the interval by the sign of its slope finds it, to 2^-halvings of the length.
[[nodiscard]] float deepestOnSegment(const Segment& segment, const vec3& halfExtents, int halvings = 16);

/// Signed distance of two boxes along the best of the 15 axes of the separating-axis test: negative, the depth of the
/// overlap; positive, a lower bound of the gap (Gottschalk, Lin and Manocha 1996).
[[nodiscard]] float distanceBetweenBoxes(const vec3& halfExtentsA, const RigidTransform& worldFromA,
                                         const vec3& halfExtentsB, const RigidTransform& worldFromB);

}  // namespace lutka::physics
