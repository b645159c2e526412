#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <span>

#include "core/rigid_transform.hpp"
#include "physics/profile/convex_hull.hpp"

namespace lutka::physics {

/// The corners of a convex polygon that is cut by planes, in their order around it; a polygon of n corners cut by m
/// planes has at most n + m.
template <int kMost>
struct ClippedPolygon {
    std::array<vec3, kMost> points;
    int count = 0;

    void add(const vec3& point) {
        if (count < kMost) points[count++] = point;
    }
};

/// What of it lies where normal · p <= offset (Sutherland and Hodgman 1974).
template <int kMost>
[[nodiscard]] ClippedPolygon<kMost> clipped(const ClippedPolygon<kMost>& polygon, const vec3& normal, float offset) {
    ClippedPolygon<kMost> out;
    for (int i = 0; i < polygon.count; ++i) {
        const vec3& from = polygon.points[i];
        const vec3& to = polygon.points[(i + 1) % polygon.count];
        const float first = glm::dot(normal, from) - offset;
        const float second = glm::dot(normal, to) - offset;
        if (first <= 0.0F) out.add(from);
        if ((first < 0.0F && second > 0.0F) || (first > 0.0F && second < 0.0F))
            out.add(from + first / (first - second) * (to - from));
    }
    return out;
}

/// Of a hull's side, and one more corner for each side of another that cuts it.
using Outline = ClippedPolygon<2 * ConvexHull::kMostPoints>;

/// The convex outline of points as seen against the unit vector `outward`, counter-clockwise from there; at most
/// ConvexHull::kMostPoints of them (Andrew's monotone chain, 1979). Fewer than three: they lie on a line.
[[nodiscard]] Outline outlineOf(std::span<const vec3> points, const vec3& outward);

}  // namespace lutka::physics
