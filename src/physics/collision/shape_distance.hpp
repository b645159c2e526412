#pragma once

#include <algorithm>
#include <array>
#include <cmath>
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

/// Its distance alone, at a fraction of the cost.
[[nodiscard]] inline float distanceFromBox(const vec3& point, const vec3& halfExtents) {
    const vec3 beyond(std::abs(point.x) - halfExtents.x, std::abs(point.y) - halfExtents.y,
                      std::abs(point.z) - halfExtents.z);
    const vec3 outside(std::max(beyond.x, 0.0F), std::max(beyond.y, 0.0F), std::max(beyond.z, 0.0F));
    const float gap = std::sqrt(outside.x * outside.x + outside.y * outside.y + outside.z * outside.z);
    return gap > 0.0F ? gap : std::max({beyond.x, beyond.y, beyond.z});
}

/// One of a box's eight corners in its own frame: bit 0 of `index` tells the side along x, 1 along y, 2 along z.
[[nodiscard]] vec3 boxCorner(const vec3& halfExtents, int index);

/// A point of a core near a box or convex hull.
struct CoreTouch {
    float along = 0.0F;  ///< Fraction of the core.
    SurfaceDistance surface;
    int part = 0;  ///< 0: the core's start, 1: its end, 2: in between.
};
/// The points of a core (in the box's frame) that touch a box: each end that is nearer to it than `reach` metres, and
/// the nearest point in between where an edge or corner of the box presses. There is none in between where both ends
/// are over the same face. A core of no length has its start alone.
struct CoreTouches {
    std::array<CoreTouch, 3> points;
    int count = 0;
};
[[nodiscard]] CoreTouches touchBox(const Segment& core, const vec3& halfExtents, float reach);

/// One of a box's twelve edges in its own frame: `index` % 4 tells the corner of its face, `index` / 4 its axis.
[[nodiscard]] Segment boxEdge(const vec3& halfExtents, int index);

/// Where the edge of another box (in this box's frame) is nearer to the box than `reach` metres. Where a face is
/// nearest: the two ends of what lies over it. Where an edge or corner is: the one nearest point.
struct EdgeTouches {
    std::array<CoreTouch, 2> points;  ///< `part`: 0 and 1 the ends, 2 the one point.
    int count = 0;
};
[[nodiscard]] EdgeTouches touchEdge(const Segment& edge, const vec3& halfExtents, float reach);

/// The unit vector along `between`, which leads from a point of one core to a point of another. Where the cores cross
/// it is across both (unit vectors along them), or up where they are parallel.
[[nodiscard]] vec3 directionBetween(const vec3& between, const vec3& alongA, const vec3& alongB);

/// The fraction along the segment, in [0, 1], where its signed distance from the box is least. The distance is a convex
/// function along a line: the interval is halved by the sign of its slope, to 2^-halvings of the length, and the
/// slope's zero is taken by a straight line between the interval's ends.
[[nodiscard]] float deepestOnSegment(const Segment& segment, const vec3& halfExtents, int halvings = 16);

}  // namespace lutka::physics
