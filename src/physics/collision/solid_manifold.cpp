#include "physics/collision/solid_manifold.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "physics/collision/clip_polygon.hpp"
#include "physics/collision/shape_distance.hpp"

namespace lutka::physics {
namespace {

constexpr int kMostPoints = ConvexHull::kMostPoints;
constexpr int kMostFaces = 2 * kMostPoints - 4;  // by Euler's formula, where all are triangles
constexpr int kMostEdges = ConvexHull::kMostEdges;

struct Plane {
    vec3 normal;
    float offset;
};
struct SolidEdge {
    int from;
    int to;
    vec3 along;
    vec3 left;  // the normals of its two faces
    vec3 right;
    vec3 turn;  // across both
};

// A solid in the world's axes about some origin.
class Solid {
  public:
    Solid(const SolidPlace& place, const vec3& origin) : middle_(place.position - origin) {
        if (place.hull != nullptr)
            takeHull(*place.hull, place.axes);
        else
            takeBox(place.halfExtents, place.axes);
    }

    [[nodiscard]] std::span<const vec3> points() const {
        return {points_.data(), static_cast<std::size_t>(pointCount_)};
    }
    [[nodiscard]] std::span<const Plane> faces() const { return {faces_.data(), static_cast<std::size_t>(faceCount_)}; }
    [[nodiscard]] std::span<const SolidEdge> edges() const {
        return {edges_.data(), static_cast<std::size_t>(edgeCount_)};
    }
    [[nodiscard]] const vec3& middle() const { return middle_; }
    [[nodiscard]] const vec3& low() const { return low_; }
    [[nodiscard]] const vec3& high() const { return high_; }
    [[nodiscard]] Segment segmentOf(const SolidEdge& edge) const { return {points_[edge.from], points_[edge.to]}; }

    // How far it reaches along a direction.
    [[nodiscard]] float support(const vec3& direction) const {
        float most = std::numeric_limits<float>::lowest();
        for (const vec3& point : points())
            most = std::max(most, glm::dot(direction, point));
        return most;
    }

  private:
    void addPoint(const vec3& point) {
        points_[pointCount_++] = point;
        low_ = glm::min(low_, point);
        high_ = glm::max(high_, point);
    }
    void addEdge(int from, int to, const vec3& left, const vec3& right) {
        edges_[edgeCount_++] = {from, to, points_[to] - points_[from], left, right, glm::cross(right, left)};
    }

    void takeHull(const ConvexHull& hull, const mat3& axes) {
        for (const vec3& point : hull.points())
            addPoint(middle_ + axes * point);
        for (const ConvexHull::Face& face : hull.faces()) {
            const vec3 normal = axes * face.normal;
            faces_[faceCount_++] = {normal, face.offset + glm::dot(normal, middle_)};
        }
        for (const ConvexHull::Edge& edge : hull.edges())
            addEdge(edge.from, edge.to, faces_[edge.left].normal, faces_[edge.right].normal);
    }

    void takeBox(const vec3& half, const mat3& axes) {
        for (int corner = 0; corner < 8; ++corner)
            addPoint(middle_ + axes * boxCorner(half, corner));
        for (int axis = 0; axis < 3; ++axis) {
            for (const float side : {1.0F, -1.0F}) {
                const vec3 normal = side * axes[axis];
                faces_[faceCount_++] = {normal, half[axis] + glm::dot(normal, middle_)};
            }
        }
        for (int axis = 0; axis < 3; ++axis) {
            const int u = (axis + 1) % 3;
            const int v = (axis + 2) % 3;
            for (int side = 0; side < 4; ++side) {
                const int from = ((side & 1) << u) | ((side >> 1) << v);
                const vec3 first = (side & 1) != 0 ? axes[u] : -axes[u];
                const vec3 second = (side & 2) != 0 ? axes[v] : -axes[v];
                addEdge(from, from | 1 << axis, first, second);
            }
        }
    }

    std::array<vec3, kMostPoints> points_;
    std::array<Plane, kMostFaces> faces_;
    std::array<SolidEdge, kMostEdges> edges_;
    int pointCount_ = 0;
    int faceCount_ = 0;
    int edgeCount_ = 0;
    vec3 middle_;
    vec3 low_{1e30F, 1e30F, 1e30F};
    vec3 high_{-1e30F, -1e30F, -1e30F};
};

// The axis along which two solids overlap least, or are apart.
struct SolidAxis {
    float distance = std::numeric_limits<float>::lowest();
    vec3 normal{0, 1, 0};  // from B to A
    bool onFaceOfA = false;
    bool onFaceOfB = false;
    const SolidEdge* edgeOfA = nullptr;
    const SolidEdge* edgeOfB = nullptr;
};

void tryFaces(const Solid& of, const Solid& other, bool ofA, SolidAxis& best) {
    for (const Plane& face : of.faces()) {
        // One point that is as deep as what was found already is enough to leave the face.
        float distance = std::numeric_limits<float>::max();
        for (const vec3& point : other.points()) {
            distance = std::min(distance, glm::dot(face.normal, point) - face.offset);
            if (distance <= best.distance) break;
        }
        if (distance <= best.distance) continue;
        best = {distance, ofA ? -face.normal : face.normal, ofA, !ofA, nullptr, nullptr};
    }
}

// Whether the edges' arcs on the sphere of normals, the second's turned inside out, cross: only then do the two span a
// face of the solids' difference.
bool spanAFace(const SolidEdge& a, const SolidEdge& b) {
    const float cba = -glm::dot(b.left, a.turn);
    const float dba = -glm::dot(b.right, a.turn);
    if (!(cba * dba < 0.0F)) return false;  // so are most pairs
    const float adc = glm::dot(a.left, b.turn);
    const float bdc = glm::dot(a.right, b.turn);
    return adc * bdc < 0.0F && cba * bdc > 0.0F;
}

// Some edges of a solid.
struct ChosenEdges {
    std::array<const SolidEdge*, kMostEdges> edges;
    int count = 0;

    template <class Test>
    ChosenEdges(const Solid& solid, Test test) {
        for (const SolidEdge& edge : solid.edges())
            if (test(edge)) edges[count++] = &edge;
    }
    [[nodiscard]] std::span<const SolidEdge* const> all() const {
        return {edges.data(), static_cast<std::size_t>(count)};
    }
};

// Those that can have a normal towards the other solid's middle. An axis of separation, or of an overlap that is not
// deeper than both solids reach, is such a normal.
ChosenEdges edgesTowards(const Solid& solid, const Solid& other) {
    const vec3 towards = other.middle() - solid.middle();
    return {solid, [&](const SolidEdge& edge) {
                return glm::dot(edge.left, towards) > 0.0F || glm::dot(edge.right, towards) > 0.0F;
            }};
}

// Those that come within `range` of the other's box.
ChosenEdges edgesNear(const Solid& solid, const Solid& other, float range) {
    return {solid, [&](const SolidEdge& edge) {
                const auto [from, to] = solid.segmentOf(edge);
                return glm::all(glm::lessThanEqual(glm::min(from, to) - range, other.high())) &&
                       glm::all(glm::greaterThanEqual(glm::max(from, to) + range, other.low()));
            }};
}

// By how much an edge must be shallower than all faces, which have more than one point to hold a solid by.
float biasOf(const SolidAxis& ofFaces) {
    constexpr float kEdgeBias = 0.001F;  // metres, and the share of the depth
    constexpr float kEdgeShare = 0.1F;
    return kEdgeBias - kEdgeShare * std::min(ofFaces.distance, 0.0F);
}

void tryEdges(const Solid& a, const Solid& b, float bias, SolidAxis& best) {
    constexpr float kParallel = 1e-6F;
    const ChosenEdges ofA = edgesTowards(a, b);
    const ChosenEdges ofB = edgesTowards(b, a);
    for (const SolidEdge* edgeA : ofA.all()) {
        for (const SolidEdge* edgeB : ofB.all()) {
            if (!spanAFace(*edgeA, *edgeB)) continue;
            vec3 axis = glm::cross(edgeA->along, edgeB->along);
            const float square = glm::dot(axis, axis);
            if (square < kParallel * glm::dot(edgeA->along, edgeA->along) * glm::dot(edgeB->along, edgeB->along))
                continue;
            axis /= std::sqrt(square);
            const vec3 onA = a.points()[edgeA->from];
            if (glm::dot(axis, onA - a.middle()) > 0.0F) axis = -axis;  // out of A's edge is into B
            const float distance = glm::dot(axis, onA - b.points()[edgeB->from]);
            if (distance - bias <= best.distance) continue;
            best = {distance, axis, false, false, edgeA, edgeB};
        }
    }
}

// What a manifold is gathered in, before the few that are kept.
struct Candidates {
    static constexpr int kMost = 2 * kMostPoints;
    struct Candidate {
        vec3 onReference;
        vec3 onOther;
        float distance;
        int feature;
    };
    std::array<Candidate, kMost> found;
    int count = 0;

    void add(const Candidate& candidate) {
        constexpr float kSame = 0.5F * kSamePlace;
        for (int i = 0; i < count; ++i)
            if (glm::distance(found[i].onOther, candidate.onOther) < kSame) return;
        if (count < kMost) found[count++] = candidate;
    }
    // Puts the deepest first, then what is farthest from those before, and drops the rest.
    void keep(int most) {
        if (count <= most) return;
        const auto deepest = std::min_element(found.begin(), found.begin() + count,
                                              [](const auto& p, const auto& q) { return p.distance < q.distance; });
        std::swap(found[0], *deepest);
        for (int next = 1; next < most; ++next) {
            int farthest = next;
            float most2 = -1.0F;
            for (int i = next; i < count; ++i) {
                float nearest = std::numeric_limits<float>::max();
                for (int kept = 0; kept < next; ++kept)
                    nearest = std::min(nearest, glm::distance(found[i].onOther, found[kept].onOther));
                if (nearest <= most2) continue;
                most2 = nearest;
                farthest = i;
            }
            std::swap(found[next], found[farthest]);
        }
        count = most;
    }
};

// The outline of the points that reach farthest along `outward`, or less by `depth`, as seen against it.
Outline outlineTowards(const Solid& solid, const vec3& outward, float depth) {
    const float least = solid.support(outward) - depth;
    std::array<vec3, kMostPoints> seen;
    int count = 0;
    for (const vec3& point : solid.points())
        if (glm::dot(outward, point) >= least) seen[count++] = point;
    return outlineOf(std::span(seen.data(), static_cast<std::size_t>(count)), outward);
}

// What of the other solid lies over or in the flat side of `reference` that looks along `outward`.
void gatherOverSide(const Solid& reference, const Solid& other, const vec3& outward, float range, Candidates& out) {
    constexpr float kFlat = 0.002F;  // metres: corners of one side, as near as skins have them
    constexpr int kFirstCrossing = kMostPoints;
    const float plane = reference.support(outward);
    const Outline side = outlineTowards(reference, outward, kFlat);
    if (side.count < 3) return;
    // Out of the side across the edge of its outline that begins at corner i.
    const auto outOf = [&](int i) { return glm::cross(side.points[(i + 1) % side.count] - side.points[i], outward); };
    const auto add = [&](const vec3& point, int feature) {
        const float distance = glm::dot(outward, point) - plane;
        if (distance < range) out.add({point - distance * outward, point, distance, feature});
    };
    const auto isOver = [&](const vec3& point) {
        for (int i = 0; i < side.count; ++i)
            if (glm::dot(outOf(i), point - side.points[i]) > 0.0F) return false;
        return true;
    };
    for (int i = 0; i < static_cast<int>(other.points().size()); ++i)
        if (isOver(other.points()[i])) add(other.points()[i], i);
    const float least = -other.support(-outward) - plane;
    Outline cut = outlineTowards(other, -outward, std::max(range - least, kFlat));
    for (int i = 0; i < side.count && cut.count > 0; ++i)
        cut = clipped(cut, outOf(i), glm::dot(outOf(i), side.points[i]));
    for (int i = 0; i < cut.count; ++i)
        add(cut.points[i], kFirstCrossing + i);
}

// The depth along the axis of least overlap is what holds the two apart, also where the deepest corner is beside the
// side: sides of round hulls are small.
void addDeepest(const Solid& other, const vec3& outward, float depth, Candidates& out) {
    constexpr float kMissed = 0.001F;  // metres
    for (int i = 0; i < out.count; ++i)
        if (out.found[i].distance < depth + kMissed) return;
    const std::span<const vec3> points = other.points();
    const auto deepest = std::min_element(points.begin(), points.end(), [&](const vec3& p, const vec3& q) {
        return glm::dot(outward, p) < glm::dot(outward, q);
    });
    out.add({*deepest - depth * outward, *deepest, depth, static_cast<int>(deepest - points.begin())});
}

void gatherOnFace(const Solid& reference, const Solid& other, const vec3& outward, float depth, float range,
                  Candidates& out) {
    gatherOverSide(reference, other, outward, range, out);
    if (depth < 0.0F) addDeepest(other, outward, depth, out);
}

// The balls around edges, by which most pairs are seen to be too far apart.
struct EdgeBalls {
    std::array<vec3, kMostEdges> middles;
    std::array<float, kMostEdges> radii;

    EdgeBalls(const Solid& solid, const ChosenEdges& chosen) {
        for (int i = 0; i < chosen.count; ++i) {
            const Segment segment = solid.segmentOf(*chosen.edges[i]);
            middles[i] = 0.5F * (segment.start + segment.end);
            radii[i] = 0.5F * glm::distance(segment.start, segment.end);
        }
    }
};

// The nearest points of two edges of solids that are apart.
void gatherBetweenEdges(const Solid& a, const Solid& b, float range, vec3& normal, Candidates& out) {
    constexpr float kSlack = 1e-5F;  // metres: more than rounding brings a ball nearer
    const ChosenEdges ofA = edgesNear(a, b, range);
    const ChosenEdges ofB = edgesNear(b, a, range);
    const EdgeBalls ballsA(a, ofA);
    const EdgeBalls ballsB(b, ofB);
    float least = range;
    for (int i = 0; i < ofA.count; ++i) {
        const Segment first = a.segmentOf(*ofA.edges[i]);
        for (int k = 0; k < ofB.count; ++k) {
            const vec3 apart = ballsA.middles[i] - ballsB.middles[k];
            const float reach = least + ballsA.radii[i] + ballsB.radii[k] + kSlack;
            if (glm::dot(apart, apart) > reach * reach) continue;
            const Segment second = b.segmentOf(*ofB.edges[k]);
            const SegmentPair at = closestBetweenSegments(first, second);
            const vec3 between = first.at(at.s) - second.at(at.t);
            const float gap = glm::length(between);
            if (gap >= least || gap < 1e-6F) continue;
            least = gap;
            normal = between / gap;
            out.count = 0;
            out.add({second.at(at.t), first.at(at.s), gap, 0});
        }
    }
}

SolidAxis leastOverlap(const Solid& a, const Solid& b, float range) {
    SolidAxis axis;
    tryFaces(a, b, true, axis);
    if (axis.distance >= range) return axis;
    tryFaces(b, a, false, axis);
    return axis;
}

}  // namespace

float distanceBetweenSolids(const SolidPlace& placeA, const SolidPlace& placeB) {
    const Solid a(placeA, placeB.position);
    const Solid b(placeB, placeB.position);
    SolidAxis axis = leastOverlap(a, b, std::numeric_limits<float>::max());
    if (axis.distance < 0.0F) tryEdges(a, b, 0.0F, axis);
    return axis.distance;
}

SolidManifold touchSolids(const SolidPlace& placeA, const SolidPlace& placeB, float range, int most) {
    constexpr int kOfB = 128;  // features of B's faces begin here
    SolidManifold manifold;
    const vec3 origin = placeB.position;
    const Solid a(placeA, origin);
    const Solid b(placeB, origin);
    SolidAxis axis = leastOverlap(a, b, range);
    if (axis.distance >= range) return manifold;
    tryEdges(a, b, biasOf(axis), axis);
    if (axis.distance >= range) return manifold;
    vec3 normal = axis.normal;
    Candidates found;
    bool flip = false;  // whether A is the reference
    if (axis.onFaceOfA) {
        flip = true;
        gatherOnFace(a, b, -normal, axis.distance, range, found);
    } else if (axis.onFaceOfB) {
        gatherOnFace(b, a, normal, axis.distance, range, found);
    }
    if (found.count == 0 && axis.distance > 0.0F) {
        flip = false;
        gatherBetweenEdges(a, b, range, normal, found);
    } else if (found.count == 0 && axis.edgeOfA != nullptr) {
        const Segment first = a.segmentOf(*axis.edgeOfA);
        const Segment second = b.segmentOf(*axis.edgeOfB);
        const SegmentPair at = closestBetweenSegments(first, second);
        found.add({second.at(at.t), first.at(at.s), axis.distance, 0});
    }
    found.keep(std::min(most, SolidManifold::kMost));
    manifold.normal = normal;
    for (int i = 0; i < found.count; ++i) {
        const Candidates::Candidate& point = found.found[i];
        const vec3& inA = flip ? point.onReference : point.onOther;
        const vec3& inB = flip ? point.onOther : point.onReference;
        manifold.points[manifold.count++] = {(inA - a.middle()) * placeA.axes, inB * placeB.axes, point.distance,
                                             (flip ? 0 : kOfB) + point.feature};
    }
    return manifold;
}

}  // namespace lutka::physics
