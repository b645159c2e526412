#include "physics/collision/shape_distance.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "physics/collision/surface_touch.hpp"

namespace lutka::physics {
namespace {

struct BoxSurface {
    const vec3& halfExtents;

    [[nodiscard]] SurfaceDistance at(const vec3& point) const { return distanceToBox(point, halfExtents); }
    // Both are of one and the same face.
    [[nodiscard]] static bool isFlatBetween(const vec3& a, const vec3& b) {
        return glm::dot(a, b) > 0.9999F && std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}) > 0.9999F;
    }
};

}  // namespace

SegmentPair closestBetweenSegments(const Segment& a, const Segment& b) {
    constexpr float kTiny = 1e-10F;
    const vec3 da = a.end - a.start;
    const vec3 db = b.end - b.start;
    const vec3 r = a.start - b.start;
    const float aa = glm::dot(da, da);
    const float bb = glm::dot(db, db);
    const float bR = glm::dot(db, r);
    if (aa < kTiny && bb < kTiny) return {0, 0};
    if (aa < kTiny) return {0, std::clamp(bR / bb, 0.0F, 1.0F)};
    const float aR = glm::dot(da, r);
    if (bb < kTiny) return {std::clamp(-aR / aa, 0.0F, 1.0F), 0};
    const float ab = glm::dot(da, db);
    const float denominator = aa * bb - ab * ab;
    // Parallel segments: any pair in the overlap will do; the start of `a` is as good as another.
    float s = denominator > 1e-6F * aa * bb ? std::clamp((ab * bR - aR * bb) / denominator, 0.0F, 1.0F) : 0.0F;
    float t = (ab * s + bR) / bb;
    if (t < 0.0F) {
        t = 0.0F;
        s = std::clamp(-aR / aa, 0.0F, 1.0F);
    } else if (t > 1.0F) {
        t = 1.0F;
        s = std::clamp((ab - aR) / aa, 0.0F, 1.0F);
    }
    return {s, t};
}

SurfaceDistance distanceToBox(const vec3& point, const vec3& halfExtents) {
    const vec3 beyond = glm::abs(point) - halfExtents;
    const vec3 outside = glm::max(beyond, vec3(0));
    const vec3 side(point.x < 0 ? -1.0F : 1.0F, point.y < 0 ? -1.0F : 1.0F, point.z < 0 ? -1.0F : 1.0F);
    const float gap = glm::length(outside);
    if (gap > 0.0F) return {gap, side * outside / gap};
    int axis = 0;
    if (beyond.y > beyond[axis]) axis = 1;
    if (beyond.z > beyond[axis]) axis = 2;
    vec3 normal(0);
    normal[axis] = side[axis];
    return {beyond[axis], normal};
}

float deepestOnSegment(const Segment& segment, const vec3& halfExtents, int halvings) {
    return deepestOn(BoxSurface{halfExtents}, segment, halvings);
}

vec3 boxCorner(const vec3& halfExtents, int index) {
    return halfExtents *
           vec3((index & 1) != 0 ? 1.0F : -1.0F, (index & 2) != 0 ? 1.0F : -1.0F, (index & 4) != 0 ? 1.0F : -1.0F);
}

CoreTouches touchBox(const Segment& core, const vec3& halfExtents, float reach) {
    return touchSurface(BoxSurface{halfExtents}, core, reach);
}

Segment boxEdge(const vec3& halfExtents, int index) {
    const int axis = index / 4;
    vec3 half(0);
    half[axis] = halfExtents[axis];
    vec3 middle(0);
    middle[(axis + 1) % 3] = (index & 1) != 0 ? halfExtents[(axis + 1) % 3] : -halfExtents[(axis + 1) % 3];
    middle[(axis + 2) % 3] = (index & 2) != 0 ? halfExtents[(axis + 2) % 3] : -halfExtents[(axis + 2) % 3];
    return {middle - half, middle + half};
}

EdgeTouches touchEdge(const Segment& edge, const vec3& halfExtents, float reach) {
    EdgeTouches touches;
    const SurfaceDistance first = distanceToBox(edge.start, halfExtents);
    const SurfaceDistance last = distanceToBox(edge.end, halfExtents);
    if (!mayComeNear(first.distance, last.distance, edge, reach)) return touches;
    const float deepest = deepestOnSegment(edge, halfExtents);
    const SurfaceDistance nearest = distanceToBox(edge.at(deepest), halfExtents);
    if (nearest.distance >= reach) return touches;
    int face = 0;
    for (int axis = 1; axis < 3; ++axis) {
        if (std::abs(nearest.normal[axis]) > std::abs(nearest.normal[face])) face = axis;
    }
    // What lies between the sides of the face.
    float from = 0.0F;
    float to = 1.0F;
    const vec3 along = edge.end - edge.start;
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == face) continue;
        const float half = halfExtents[axis];
        if (std::abs(along[axis]) < 1e-9F) {
            if (std::abs(edge.start[axis]) > half) to = -1.0F;
            continue;
        }
        const float low = (-half - edge.start[axis]) / along[axis];
        const float high = (half - edge.start[axis]) / along[axis];
        from = std::max(from, std::min(low, high));
        to = std::min(to, std::max(low, high));
    }
    const bool overFace = std::abs(nearest.normal[face]) > 0.9999F;
    if (!overFace || (to - from) * glm::length(along) < kSamePlace) {
        touches.points[touches.count++] = {deepest, nearest, 2};
        return touches;
    }
    vec3 normal(0);
    normal[face] = nearest.normal[face] < 0.0F ? -1.0F : 1.0F;
    for (int end = 0; end < 2; ++end) {
        const float t = end == 0 ? from : to;
        const float distance = glm::dot(normal, edge.at(t)) - halfExtents[face];
        if (distance < reach) touches.points[touches.count++] = {t, {distance, normal}, end};
    }
    return touches;
}

vec3 directionBetween(const vec3& between, const vec3& alongA, const vec3& alongB) {
    const float distance = glm::length(between);
    if (distance > 1e-6F) return between / distance;
    const vec3 across = glm::cross(alongA, alongB);
    const float length = glm::length(across);
    return length > 1e-3F ? across / length : vec3(0, 1, 0);
}

}  // namespace lutka::physics
