#pragma once

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/math.hpp"
#include "core/result.hpp"

namespace lutka::physics {

/// The surface point of a mesh that is nearest to a point.
struct MeshDistance {
    float distance = 0.0F;  ///< Metres, negative behind the surface.
    vec3 normal{0, 1, 0};   ///< Unit, along which the distance grows fastest.
    bool found = false;     ///< False: nothing within the range that was asked for.
};

/// A static surface of triangles in its own space, metres. Corners run counter-clockwise as seen from the front; the
/// solid lies behind. Closed meshes know inside from outside everywhere, sheets near their surface. Immutable; shared
/// by any number of static shapes and worlds. Holds a tree of bounding boxes over the triangles and, for every edge and
/// vertex, what lies around it.
class TriangleMesh {
  public:
    using Triangle = std::array<int, 3>;

    /// Two triangles that share an edge; one only at a boundary.
    struct Edge {
        int start = 0, end = 0;      ///< Vertices.
        int opposite[2] = {-1, -1};  ///< The third vertex of each triangle; -1: none.
        int triangle[2] = {-1, -1};
        bool sharp = true;  ///< Convex or at a boundary: what may press between the ends of a capsule.
    };

    /// Vertices at the same place become one, triangles without area are dropped. Fails with ErrorCode::input for no
    /// triangle with area, for indices out of range, for coordinates that are not finite and for more than 10⁷ of
    /// either.
    [[nodiscard]] static Result<std::shared_ptr<const TriangleMesh>> make(std::span<const vec3> vertices,
                                                                          std::span<const Triangle> triangles);

    [[nodiscard]] std::span<const vec3> vertices() const { return vertices_; }
    [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }
    [[nodiscard]] std::span<const vec3> normals() const { return normals_; }  ///< Unit, one a triangle.
    [[nodiscard]] std::span<const Edge> edges() const { return edges_; }
    [[nodiscard]] const std::array<int, 3>& edgesOf(int triangle) const { return triangleEdges_[triangle]; }
    [[nodiscard]] vec3 low() const { return nodes_.front().low; }
    [[nodiscard]] vec3 high() const { return nodes_.front().high; }

    /// Signed distance of a point from the surface, looked for within `range` metres. The sign is that of the
    /// angle-weighted pseudo-normal at the nearest feature (Bærentzen and Aanæs 2005).
    [[nodiscard]] MeshDistance distanceTo(const vec3& point, float range) const;

    /// Where the segment from `from` to `to` first meets a front: its fraction, > 1 for a miss, and the triangle.
    struct Ray {
        float fraction = 2.0F;
        int triangle = -1;
    };
    [[nodiscard]] Ray rayTest(const vec3& from, const vec3& to) const;

    /// Calls `visit(triangle)` for all triangles whose bounds meet the box.
    template <class Visit>
    void forEachIn(const vec3& low, const vec3& high, const Visit& visit) const {
        for (int at = 0; at < static_cast<int>(nodes_.size());) {
            const Node& node = nodes_[at];
            if (!node.meets(low, high)) {
                at = node.next;
                continue;
            }
            for (int i = 0; i < node.count; ++i)
                visit(node.first + i);
            ++at;
        }
    }

    /// Whether all that meets at a feature lies behind the plane through it across `direction` (unit): the feature is
    /// then the surface's own nearest one to points along that direction.
    [[nodiscard]] bool vertexSupports(int vertex, const vec3& direction) const;
    [[nodiscard]] bool edgeSupports(int edge, const vec3& direction) const;
    /// The triangle that speaks for a vertex that several share.
    [[nodiscard]] int ownerOf(int vertex) const { return owner_[vertex]; }

  private:
    TriangleMesh() = default;

    // In depth-first order: a node's first child follows it, `next` is what follows its whole branch.
    struct Node {
        vec3 low{0, 0, 0};
        vec3 high{0, 0, 0};
        int next = 0;
        int first = 0;  // triangles of a leaf
        int count = 0;  // 0: a branch

        [[nodiscard]] bool meets(const vec3& otherLow, const vec3& otherHigh) const {
            return low.x <= otherHigh.x && otherLow.x <= high.x && low.y <= otherHigh.y && otherLow.y <= high.y &&
                   low.z <= otherHigh.z && otherLow.z <= high.z;
        }
    };
    void takeVertices(std::span<const vec3> vertices, std::span<const Triangle> triangles);
    void buildTree();
    void buildBranch(std::span<int> order, const std::vector<vec3>& centres);
    void findEdges();
    void findFans();
    [[nodiscard]] vec3 pseudoNormal(int triangle, int region) const;

    std::vector<vec3> vertices_;
    std::vector<Triangle> triangles_;
    std::vector<vec3> normals_;
    std::vector<Edge> edges_;
    std::vector<std::array<int, 3>> triangleEdges_;  // edge i runs from corner i to the next
    std::vector<vec3> vertexNormals_;                // weighted by the triangles' angles
    std::vector<int> owner_;
    std::vector<int> fanStart_;  // of a vertex's neighbours in fan_; one more than vertices
    std::vector<int> fan_;
    std::vector<Node> nodes_;
};

/// The point of a triangle nearest to `point`, and where it lies: region 0 the face, 1 to 3 the edge from corner 0, 1,
/// 2, 4 to 6 corner 0, 1, 2 (Ericson, Real-Time Collision Detection, 5.1.5).
struct TrianglePoint {
    vec3 position{0, 0, 0};
    int region = 0;
};
[[nodiscard]] TrianglePoint nearestOnTriangle(const vec3& a, const vec3& b, const vec3& c, const vec3& point);

/// Where a line meets a triangle (Möller and Trumbore 1997).
struct LineCrossing {
    float along = 0.0F;        ///< Of the line's direction, from its origin.
    float b = 0.0F, c = 0.0F;  ///< Weights of corners b and c there; that of a is what is left of 1.
};
enum class Sides { front, both };  ///< The front is where the corners run counter-clockwise.
/// Nothing where the line passes beside the triangle or along its plane. `sides`: which it may come from.
[[nodiscard]] inline std::optional<LineCrossing> crossTriangle(const vec3& a, const vec3& b, const vec3& c,
                                                               const vec3& origin, const vec3& direction, Sides sides) {
    const vec3 e1 = b - a;
    const vec3 e2 = c - a;
    const vec3 p = glm::cross(direction, e2);
    const float determinant = glm::dot(e1, p);
    const float side = determinant < 0.0F ? -1.0F : 1.0F;
    if (determinant == 0.0F || (side < 0.0F && sides == Sides::front)) return std::nullopt;
    const float scale = side * determinant;
    const vec3 offset = origin - a;
    const float u = side * glm::dot(offset, p);
    if (!(u >= 0.0F && u <= scale)) return std::nullopt;
    const vec3 q = glm::cross(offset, e1);
    const float v = side * glm::dot(direction, q);
    if (!(v >= 0.0F && u + v <= scale)) return std::nullopt;
    return LineCrossing{glm::dot(e2, q) / determinant, u / scale, v / scale};
}

/// Whether what leads `along` from a feature rises above the plane through it across `direction` (unit). What rises by
/// less than a five-hundredth of its length counts as in the plane.
[[nodiscard]] inline bool risesAbove(const vec3& direction, const vec3& along) {
    constexpr float kFlat = 2e-3F;  // sine
    return glm::dot(along, direction) > kFlat * glm::length(along);
}

}  // namespace lutka::physics
