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

// An edge of a box, and which of the two it is where two reach as far: 0 or 1.
struct Edge {
    Segment ends;
    int side;
};

// The edges of `box` along `axis` that reach farthest in a direction: one, or both of a face that looks nearly that
// way. Of these one or the other reaches farther by a breath. Returns how many there are.
int edgesTowards(const BoxPlace& box, int axis, const vec3& direction, Edge (&out)[2]) {
    constexpr float kFlat = 0.2F;  // sine
    const vec3 along = direction * box.axes;
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const int across = std::abs(along[u]) < std::abs(along[v]) ? u : v;  // the face's other direction
    const int count = std::abs(along[across]) < kFlat ? 2 : 1;
    vec3 half(0);
    half[axis] = box.halfExtents[axis];
    for (int i = 0; i < count; ++i) {
        vec3 middle(0);
        for (const int side : {u, v})
            middle[side] = along[side] > 0.0F ? box.halfExtents[side] : -box.halfExtents[side];
        if (i == 1) middle[across] = -middle[across];
        out[i] = {{box.position + box.axes * (middle - half), box.position + box.axes * (middle + half)},
                  middle[across] > 0.0F ? 1 : 0};
    }
    return count;
}

// Where two edges touch: found(s, t, index), parameters along both. Edges that cross do so where they are nearest. Of
// edges that are nearly parallel that is one end or the other, at a breath; these touch at both ends of what they
// share.
template <class Found>
void touchEdges(const Segment& a, const Segment& b, Found found) {
    constexpr float kParallel = 0.2F;  // sine
    const vec3 alongA = a.end - a.start;
    const vec3 alongB = b.end - b.start;
    const float a2 = glm::dot(alongA, alongA);
    const float b2 = glm::dot(alongB, alongB);
    const vec3 across = glm::cross(alongA, alongB);
    const float first = glm::dot(b.start - a.start, alongA) / a2;
    const float last = glm::dot(b.end - a.start, alongA) / a2;
    const float from = std::clamp(std::min(first, last), 0.0F, 1.0F);
    const float to = std::clamp(std::max(first, last), 0.0F, 1.0F);
    if (glm::dot(across, across) > kParallel * kParallel * a2 * b2 || (to - from) * std::sqrt(a2) < kSamePlace) {
        const SegmentPair at = closestBetweenSegments(a, b);
        found(at.s, at.t, 0);
        return;
    }
    for (int end = 0; end < 2; ++end) {
        const float s = end == 0 ? from : to;
        found(s, std::clamp(glm::dot(a.at(s) - b.start, alongB) / b2, 0.0F, 1.0F), end);
    }
}

}  // namespace

BoxAxis leastOverlap(const BoxPlace& a, const BoxPlace& b, bool edgesLast) {
    constexpr float kEdgeBias = 0.001F;  // metres, and the share of the depth, by which edges must be shallower
    constexpr float kEdgeShare = 0.1F;
    const vec3 offset = a.position - b.position;
    BoxAxis face;
    BoxAxis edge;
    face.distance = edge.distance = -std::numeric_limits<float>::max();
    const auto tryAxis = [&](const vec3& axis, BoxAxis found, BoxAxis& best) {
        const float length = glm::length(axis);
        if (length < 1e-4F) return;  // parallel edges: the faces' axes cover them
        float reach = 0.0F;
        for (int i = 0; i < 3; ++i) {
            reach += a.halfExtents[i] * std::abs(glm::dot(a.axes[i], axis)) +
                     b.halfExtents[i] * std::abs(glm::dot(b.axes[i], axis));
        }
        const float apart = glm::dot(offset, axis);
        found.distance = (std::abs(apart) - reach) / length;
        if (found.distance <= best.distance) return;
        found.normal = (apart < 0.0F ? -1.0F : 1.0F) / length * axis;
        best = found;
    };
    for (int i = 0; i < 3; ++i) {
        tryAxis(a.axes[i], {.faceOfA = i}, face);
        tryAxis(b.axes[i], {.faceOfB = i}, face);
    }
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            tryAxis(glm::cross(a.axes[i], b.axes[j]), {.edgeOfA = i, .edgeOfB = j}, edge);
    }
    // Among edges the shallowest counts, by however little.
    const float bias = edgesLast ? kEdgeBias - kEdgeShare * std::min(face.distance, 0.0F) : 0.0F;
    return edge.distance - bias > face.distance ? edge : face;
}

BoxManifold touchBoxes(const BoxPlace& a, const BoxPlace& b, float reach) {
    constexpr int kOfB = 8;  // features of B's faces begin here, those of edges after them
    constexpr int kOfEdges = 16;
    constexpr int kEdgePairs = 9;
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
        Edge ofA[2];
        Edge ofB[2];
        const int countA = edgesTowards(a, axis.edgeOfA, -axis.normal, ofA);
        const int countB = edgesTowards(b, axis.edgeOfB, axis.normal, ofB);
        const auto touch = [&](const Edge& edgeA, const Edge& edgeB, bool isFarthest) {
            const int which = 2 * edgeA.side + 4 * edgeB.side;
            touchEdges(edgeA.ends, edgeB.ends, [&](float s, float t, int end) {
                const vec3 between = edgeA.ends.at(s) - edgeB.ends.at(t);
                const float distance = glm::dot(axis.normal, between);
                // Those that reach less far touch only where they cross.
                const bool crosses = glm::distance(between, distance * axis.normal) < kSamePlace;
                if (!isFarthest && (distance > reach || !crosses)) return;
                const int feature = kOfEdges + 3 * axis.edgeOfA + axis.edgeOfB + (end + which) * kEdgePairs;
                add(inBox(a, edgeA.ends.at(s)), inBox(b, edgeB.ends.at(t)), distance, feature);
            });
        };
        touch(ofA[0], ofB[0], true);
        if (countA > 1) touch(ofA[1], ofB[0], false);
        if (countB > 1) touch(ofA[0], ofB[1], false);
    }
    return manifold;
}

}  // namespace lutka::physics
