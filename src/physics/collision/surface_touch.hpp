#pragma once

#include <algorithm>
#include <glm/geometric.hpp>

#include "physics/collision/shape_distance.hpp"

/// How a core, a point or segment in a solid's own frame, meets the solid, whatever that is. A `Surface` has
///     SurfaceDistance at(const vec3& point) const;                    signed distance and outward normal
///     bool isFlatBetween(const vec3& a, const vec3& b) const;         whether between points with these normals none
///                                                                     is nearer
namespace lutka::physics {

/// Whether some point of a segment can be nearer than `reach`, from the distances of its ends: along it the distance
/// changes by no more than the way.
[[nodiscard]] inline bool mayComeNear(float first, float last, const Segment& segment, float reach) {
    return 0.5F * (first + last - glm::length(segment.end - segment.start)) < reach;
}

/// See deepestOnSegment().
template <class Surface>
[[nodiscard]] float deepestOn(const Surface& surface, const Segment& segment, int halvings) {
    const vec3 along = segment.end - segment.start;
    const auto slopeAt = [&](float t) { return glm::dot(surface.at(segment.at(t)).normal, along); };
    float slopeLow = slopeAt(0.0F);
    if (slopeLow > 0.0F) return 0.0F;
    float slopeHigh = slopeAt(1.0F);
    if (slopeHigh <= 0.0F) return 1.0F;
    float low = 0.0F;
    float high = 1.0F;
    for (int halving = 0; halving < halvings; ++halving) {
        const float middle = 0.5F * (low + high);
        const float slope = slopeAt(middle);
        if (slope > 0.0F) {
            high = middle;
            slopeHigh = slope;
        } else {
            low = middle;
            slopeLow = slope;
        }
    }
    // Where the slope is nearly straight, as beside an edge, its zero; where it jumps, inside the solid, the jump is
    // here.
    return low + (high - low) * (-slopeLow / (slopeHigh - slopeLow));
}

/// See touchBox().
template <class Surface>
[[nodiscard]] CoreTouches touchSurface(const Surface& surface, const Segment& core, float reach) {
    CoreTouches touches;
    const auto add = [&](float along, const SurfaceDistance& at, int part) {
        if (at.distance < reach) touches.points[touches.count++] = {along, at, part};
    };
    const SurfaceDistance first = surface.at(core.start);
    add(0.0F, first, 0);
    if (core.start == core.end) return touches;
    const SurfaceDistance last = surface.at(core.end);
    add(1.0F, last, 1);
    if (surface.isFlatBetween(first.normal, last.normal) || !mayComeNear(first.distance, last.distance, core, reach))
        return touches;
    constexpr int kHalvings = 7;
    const float deepest = deepestOn(surface, core, kHalvings);
    const float nearAnEnd = kSamePlace / glm::length(core.end - core.start);
    if (deepest > nearAnEnd && deepest < 1.0F - nearAnEnd) add(deepest, surface.at(core.at(deepest)), 2);
    return touches;
}

}  // namespace lutka::physics
