#include "physics/collision/box_manifold.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "physics/collision/clip_polygon.hpp"
#include "physics/collision/shape_distance.hpp"

namespace lutka::physics {
namespace {

vec3 inBox(const BoxPlace& box, const vec3& point) {
    return (point - box.position) * box.axes;
}

// A quad cut by four planes.
using Polygon = ClippedPolygon<8>;

// The face of `box` that looks most against `normal` (of the world), in the axes of `reference`.
Polygon faceAgainst(const BoxPlace& box, const vec3& normal, const BoxPlace& reference, int& face) {
    const vec3 along = normal * box.axes;
    face = 0;
    for (int axis = 1; axis < 3; ++axis) {
        if (std::abs(along[axis]) > std::abs(along[face])) face = axis;
    }
    const float side = along[face] > 0.0F ? -1.0F : 1.0F;
    const int u = (face + 1) % 3;
    const int v = (face + 2) % 3;
    Polygon polygon;
    for (const auto& [signU, signV] : {std::pair(-1.0F, -1.0F), {1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, 1.0F}}) {
        vec3 corner(0);
        corner[face] = side * box.halfExtents[face];
        corner[u] = signU * box.halfExtents[u];
        corner[v] = signV * box.halfExtents[v];
        polygon.add(inBox(reference, box.position + box.axes * corner));
    }
    return polygon;
}

// The face `axis` of `reference`, which looks along `outward` (of the world), and what of the other box lies in it.
// `found`: both points in the axes of their boxes, the reference's first.
template <class Found>
void clipOnFace(const BoxPlace& reference, int axis, const vec3& outward, const BoxPlace& other, float reach,
                Found found) {
    int otherFace = 0;
    Polygon polygon = faceAgainst(other, outward, reference, otherFace);
    for (const int side : {(axis + 1) % 3, (axis + 2) % 3}) {
        vec3 across(0);
        across[side] = 1.0F;
        polygon = clipped(polygon, across, reference.halfExtents[side]);
        polygon = clipped(polygon, -across, reference.halfExtents[side]);
    }
    const float sign = glm::dot(outward, reference.axes[axis]) > 0.0F ? 1.0F : -1.0F;
    for (int i = 0; i < polygon.count; ++i) {
        const vec3& point = polygon.points[i];
        const float distance = sign * point[axis] - reference.halfExtents[axis];
        if (distance > reach) continue;
        vec3 onReference = point;
        onReference[axis] = sign * reference.halfExtents[axis];
        found(onReference, inBox(other, reference.position + reference.axes * point), distance, i);
    }
}

// The edge of `box` along `axis` that reaches farthest in a direction.
Segment edgeTowards(const BoxPlace& box, int axis, const vec3& direction) {
    const vec3 along = direction * box.axes;
    vec3 middle(0);
    for (int side = 0; side < 3; ++side) {
        if (side != axis) middle[side] = along[side] > 0.0F ? box.halfExtents[side] : -box.halfExtents[side];
    }
    vec3 half(0);
    half[axis] = box.halfExtents[axis];
    return {box.position + box.axes * (middle - half), box.position + box.axes * (middle + half)};
}

}  // namespace

BoxAxis leastOverlap(const BoxPlace& a, const BoxPlace& b, bool edgesLast) {
    constexpr float kEdgeBias = 0.001F;  // metres, and the share of the depth, by which edges must be shallower
    constexpr float kEdgeShare = 0.1F;
    const vec3 offset = a.position - b.position;
    BoxAxis best;
    best.distance = -std::numeric_limits<float>::max();
    const auto tryAxis = [&](const vec3& axis, float bias, BoxAxis found) {
        const float length = glm::length(axis);
        if (length < 1e-4F) return;  // parallel edges: the faces' axes cover them
        float reach = 0.0F;
        for (int i = 0; i < 3; ++i) {
            reach += a.halfExtents[i] * std::abs(glm::dot(a.axes[i], axis)) +
                     b.halfExtents[i] * std::abs(glm::dot(b.axes[i], axis));
        }
        const float apart = glm::dot(offset, axis);
        found.distance = (std::abs(apart) - reach) / length;
        if (found.distance - bias <= best.distance) return;
        found.normal = (apart < 0.0F ? -1.0F : 1.0F) / length * axis;
        best = found;
    };
    for (int i = 0; i < 3; ++i) {
        tryAxis(a.axes[i], 0.0F, {.faceOfA = i});
        tryAxis(b.axes[i], 0.0F, {.faceOfB = i});
    }
    const float bias = edgesLast ? kEdgeBias - kEdgeShare * std::min(best.distance, 0.0F) : 0.0F;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            tryAxis(glm::cross(a.axes[i], b.axes[j]), bias, {.edgeOfA = i, .edgeOfB = j});
    }
    return best;
}

BoxManifold touchBoxes(const BoxPlace& a, const BoxPlace& b, float reach) {
    constexpr int kOfB = 8;  // features of B's faces begin here, those of edges after them
    constexpr int kOfEdges = 16;
    BoxManifold manifold;
    const BoxAxis axis = leastOverlap(a, b, true);
    if (axis.distance >= kSamePlace) return manifold;
    manifold.normal = axis.normal;
    const auto add = [&](const vec3& onA, const vec3& onB, float distance, int feature) {
        manifold.points[manifold.count++] = {onA, onB, distance, feature};
    };
    if (axis.faceOfA >= 0) {
        clipOnFace(a, axis.faceOfA, -axis.normal, b, reach,
                   [&](const vec3& onA, const vec3& onB, float distance, int i) { add(onA, onB, distance, i); });
    } else if (axis.faceOfB >= 0) {
        clipOnFace(b, axis.faceOfB, axis.normal, a, reach,
                   [&](const vec3& onB, const vec3& onA, float distance, int i) { add(onA, onB, distance, kOfB + i); });
    } else {
        const Segment ofA = edgeTowards(a, axis.edgeOfA, -axis.normal);
        const Segment ofB = edgeTowards(b, axis.edgeOfB, axis.normal);
        const SegmentPair at = closestBetweenSegments(ofA, ofB);
        add(inBox(a, ofA.at(at.s)), inBox(b, ofB.at(at.t)), axis.distance, kOfEdges + 3 * axis.edgeOfA + axis.edgeOfB);
    }
    return manifold;
}

}  // namespace lutka::physics
