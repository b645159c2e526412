#pragma once

#include <glm/common.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/rigid_transform.hpp"

namespace lutka::physics {

/// A closed convex polyhedron, metres. Never changed once made, so that copies of a shape share one.
class ConvexHull {
  public:
    static constexpr int kFewestPoints = 4;
    /// The most corners of one. 32 leave the limbs and trunks of figures within half a percent of their height, and
    /// contacts of two take some microseconds.
    static constexpr int kMostPoints = 32;
    static constexpr int kMostEdges = 3 * kMostPoints - 6;  ///< By Euler's formula.

    /// A flat side: the hull lies where normal · p <= offset.
    struct Face {
        vec3 normal{0, 1, 0};  ///< Unit, outward.
        float offset = 0.0F;
        int first = 0;  ///< Its corners are corners()[first, first + count), counter-clockwise from outside.
        int count = 0;
    };
    struct Edge {
        int from = 0;  ///< Vertices.
        int to = 0;
        int left = 0;  ///< The face whose corners go from `from` to `to`.
        int right = 0;
    };

    [[nodiscard]] std::span<const vec3> points() const { return points_; }
    [[nodiscard]] std::span<const Face> faces() const { return faces_; }
    [[nodiscard]] std::span<const Edge> edges() const { return edges_; }
    [[nodiscard]] std::span<const int> corners() const { return corners_; }
    [[nodiscard]] std::span<const int> cornersOf(const Face& face) const {
        return std::span(corners_).subspan(static_cast<std::size_t>(face.first), static_cast<std::size_t>(face.count));
    }

    [[nodiscard]] float volume() const { return volume_; }            ///< Cubic metres.
    [[nodiscard]] const vec3& centroid() const { return centroid_; }  ///< Of the solid.
    /// The mean of the solid's points p pᵀ about the origin, square metres: what moments of inertia are made of
    /// (Eberly, Polyhedral Mass Properties, 2002, here by tetrahedra).
    [[nodiscard]] const mat3& meanSquare() const { return meanSquare_; }
    [[nodiscard]] float reach() const { return reach_; }          ///< Of the farthest corner from the origin.
    [[nodiscard]] float thickness() const { return thickness_; }  ///< Least width across one of its faces.
    [[nodiscard]] const vec3& low() const { return low_; }        ///< Corners of the box around it.
    [[nodiscard]] const vec3& high() const { return high_; }
    /// Half the sides of the box about the origin that holds it.
    [[nodiscard]] vec3 halfBounds() const { return glm::max(high_, -low_); }

  private:
    friend class HullMaker;
    std::vector<vec3> points_;
    std::vector<Face> faces_;
    std::vector<Edge> edges_;
    std::vector<int> corners_;
    float volume_ = 0.0F;
    vec3 centroid_{0, 0, 0};
    mat3 meanSquare_{0.0F};
    float reach_ = 0.0F;
    float thickness_ = 0.0F;
    vec3 low_{0, 0, 0};
    vec3 high_{0, 0, 0};
};

using ConvexHullPtr = std::shared_ptr<const ConvexHull>;

/// The hull of finite points; its corners are those of them that lie on its surface and in no side's or edge's middle,
/// in the order given. Null where it would be flat: a thousandth as thick as it is long, or less.
[[nodiscard]] ConvexHullPtr makeConvexHull(std::span<const vec3> points);

/// The hull of a hull's corners, each as `move` puts it. Null where they come to lie flat.
template <class Move>
[[nodiscard]] ConvexHullPtr movedHull(const ConvexHull& hull, Move move) {
    std::vector<vec3> points(hull.points().begin(), hull.points().end());
    for (vec3& point : points)
        point = move(point);
    return makeConvexHull(points);
}

/// Whether they have the same corners in the same order; null is like null alone.
[[nodiscard]] bool sameHull(const ConvexHullPtr& a, const ConvexHullPtr& b);

}  // namespace lutka::physics
