#include "physics/collision/hull_distance.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "core/assert.hpp"
#include "physics/collision/surface_touch.hpp"

namespace lutka::physics {
namespace {

struct HullSurface {
    const ConvexHull& hull;

    [[nodiscard]] SurfaceDistance at(const vec3& point) const { return distanceToHull(point, hull); }
    // The distance is a convex function: where its slope is the same at both ends it is straight.
    [[nodiscard]] static bool isFlatBetween(const vec3& a, const vec3& b) { return glm::dot(a, b) > 0.9999F; }
};

// Whether a point over the face's plane is over the face.
bool isOver(const ConvexHull& hull, const ConvexHull::Face& face, const vec3& point) {
    const std::span<const int> loop = hull.cornersOf(face);
    vec3 from = hull.points()[loop.back()];
    for (const int corner : loop) {
        const vec3 to = hull.points()[corner];
        if (glm::dot(glm::cross(to - from, point - from), face.normal) < 0.0F) return false;
        from = to;
    }
    return true;
}

vec3 nearestOnEdge(const vec3& from, const vec3& to, const vec3& point) {
    const vec3 along = to - from;
    return from + std::clamp(glm::dot(point - from, along) / glm::dot(along, along), 0.0F, 1.0F) * along;
}

}  // namespace

SurfaceDistance distanceToHull(const vec3& point, const ConvexHull& hull) {
    const ConvexHull::Face* nearest = nullptr;
    float distance = std::numeric_limits<float>::lowest();
    for (const ConvexHull::Face& face : hull.faces()) {
        const float above = glm::dot(face.normal, point) - face.offset;
        if (above <= distance) continue;
        distance = above;
        nearest = &face;
    }
    // No point of the hull is nearer than the farthest plane: over its face that is the distance.
    constexpr float kTouching = 1e-6F;
    if (distance <= kTouching || isOver(hull, *nearest, point)) return {distance, nearest->normal};
    vec3 onHull(0);
    float square = std::numeric_limits<float>::max();
    for (const ConvexHull::Edge& edge : hull.edges()) {
        const vec3 on = nearestOnEdge(hull.points()[edge.from], hull.points()[edge.to], point);
        const vec3 apart = point - on;
        if (glm::dot(apart, apart) >= square) continue;
        square = glm::dot(apart, apart);
        onHull = on;
    }
    const float gap = std::sqrt(square);
    return {gap, (point - onHull) / gap};
}

CoreTouches touchHull(const Segment& core, const ConvexHull& hull, float reach) {
    return touchSurface(HullSurface{hull}, core, reach);
}

float deepestOnSegment(const Segment& segment, const ConvexHull& hull, int halvings) {
    return deepestOn(HullSurface{hull}, segment, halvings);
}

namespace {

// Four to begin with: the two farthest apart, the farthest from their line, the farthest from those three's plane.
std::vector<vec3> firstFour(std::span<const vec3> points) {
    const auto farthest = [&](auto distance) {
        return *std::max_element(points.begin(), points.end(),
                                 [&](const vec3& a, const vec3& b) { return distance(a) < distance(b); });
    };
    const vec3 start = points.front();
    const vec3 a = farthest([&](const vec3& p) { return glm::distance(p, start); });
    const vec3 b = farthest([&](const vec3& p) { return glm::distance(p, a); });
    const vec3 c = farthest([&](const vec3& p) { return glm::length(glm::cross(p - a, b - a)); });
    const vec3 across = glm::cross(b - a, c - a);
    const vec3 d = farthest([&](const vec3& p) { return std::abs(glm::dot(across, p - a)); });
    return {a, b, c, d};
}

}  // namespace

ReducedHull reduceHull(std::span<const vec3> points, float tolerance, int most) {
    LUTKA_ASSERT(most >= ConvexHull::kFewestPoints && most <= ConvexHull::kMostPoints);
    const ConvexHullPtr whole = makeConvexHull(points);
    if (whole == nullptr) return {};
    std::vector<vec3> chosen = firstFour(whole->points());
    ReducedHull reduced{makeConvexHull(chosen), 0.0F};
    while (reduced.hull != nullptr) {
        const vec3* farthest = nullptr;
        reduced.deviation = 0.0F;
        for (const vec3& point : whole->points()) {
            const float out = distanceToHull(point, *reduced.hull).distance;
            if (out <= reduced.deviation) continue;
            reduced.deviation = out;
            farthest = &point;
        }
        if (farthest == nullptr || reduced.deviation <= tolerance ||
            static_cast<int>(reduced.hull->points().size()) >= most)
            return reduced;
        chosen.assign(reduced.hull->points().begin(), reduced.hull->points().end());
        chosen.push_back(*farthest);
        reduced.hull = makeConvexHull(chosen);
    }
    return {};
}

}  // namespace lutka::physics
