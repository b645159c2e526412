#include "physics/collision/shape_distance.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace lutka::physics {

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
    const vec3 along = segment.end - segment.start;
    const auto slopeAt = [&](float t) { return glm::dot(distanceToBox(segment.at(t), halfExtents).normal, along); };
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
    // Where the slope is nearly straight, as beside an edge, its zero; where it jumps, inside the box, the jump is
    // here.
    return low + (high - low) * (-slopeLow / (slopeHigh - slopeLow));
}

vec3 boxCorner(const vec3& halfExtents, int index) {
    return halfExtents *
           vec3((index & 1) != 0 ? 1.0F : -1.0F, (index & 2) != 0 ? 1.0F : -1.0F, (index & 4) != 0 ? 1.0F : -1.0F);
}

namespace {

// Whether some point of a segment can be nearer than `reach`, from the distances of its ends: along it the distance
// changes by no more than the way.
bool mayComeNear(float first, float last, const Segment& segment, float reach) {
    return 0.5F * (first + last - glm::length(segment.end - segment.start)) < reach;
}

// Whether two normals are those of one and the same face, so that nothing between the points can be nearer.
bool sameFace(const vec3& a, const vec3& b) {
    return glm::dot(a, b) > 0.9999F && std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}) > 0.9999F;
}

}  // namespace

BoxTouches touchBox(const Segment& core, const vec3& halfExtents, float reach) {
    BoxTouches touches;
    const auto add = [&](float along, const SurfaceDistance& surface, int part) {
        if (surface.distance < reach) touches.points[touches.count++] = {along, surface, part};
    };
    const SurfaceDistance first = distanceToBox(core.start, halfExtents);
    add(0.0F, first, 0);
    if (core.start == core.end) return touches;
    const SurfaceDistance last = distanceToBox(core.end, halfExtents);
    add(1.0F, last, 1);
    if (sameFace(first.normal, last.normal) || !mayComeNear(first.distance, last.distance, core, reach)) return touches;
    constexpr int kHalvings = 7;
    const float deepest = deepestOnSegment(core, halfExtents, kHalvings);
    const float nearAnEnd = kSamePlace / glm::length(core.end - core.start);
    if (deepest > nearAnEnd && deepest < 1.0F - nearAnEnd)
        add(deepest, distanceToBox(core.at(deepest), halfExtents), 2);
    return touches;
}

vec3 directionBetween(const vec3& between, const vec3& alongA, const vec3& alongB) {
    const float distance = glm::length(between);
    if (distance > 1e-6F) return between / distance;
    const vec3 across = glm::cross(alongA, alongB);
    const float length = glm::length(across);
    return length > 1e-3F ? across / length : vec3(0, 1, 0);
}

float distanceBetweenBoxes(const vec3& halfExtentsA, const RigidTransform& worldFromA, const vec3& halfExtentsB,
                           const RigidTransform& worldFromB) {
    const mat3 a = glm::mat3_cast(worldFromA.rotation);
    const mat3 b = glm::mat3_cast(worldFromB.rotation);
    const vec3 offset = worldFromB.translation - worldFromA.translation;
    float best = -std::numeric_limits<float>::max();
    const auto tryAxis = [&](const vec3& axis) {
        const float length = glm::length(axis);
        if (length < 1e-4F) return;  // parallel edges: the faces' axes cover them
        float reach = 0.0F;
        for (int i = 0; i < 3; ++i)
            reach +=
                halfExtentsA[i] * std::abs(glm::dot(a[i], axis)) + halfExtentsB[i] * std::abs(glm::dot(b[i], axis));
        best = std::max(best, (std::abs(glm::dot(offset, axis)) - reach) / length);
    };
    for (int i = 0; i < 3; ++i) {
        tryAxis(a[i]);
        tryAxis(b[i]);
        for (int j = 0; j < 3; ++j)
            tryAxis(glm::cross(a[i], b[j]));
    }
    return best;
}

}  // namespace lutka::physics
