#include "scene/draw/draw_hull.hpp"

#include <glm/geometric.hpp>

namespace lutka::scene {

void addHull(render::LineBatch& lines, const RigidTransform& worldFromHull, const physics::ConvexHull& hull,
             render::Color color) {
    constexpr float kOneSide = 0.998F;  // cosine
    for (const physics::ConvexHull::Edge& edge : hull.edges()) {
        if (glm::dot(hull.faces()[edge.left].normal, hull.faces()[edge.right].normal) > kOneSide) continue;
        lines.add(worldFromHull * hull.points()[edge.from], worldFromHull * hull.points()[edge.to], color);
    }
}

void addHull(render::SolidBatch& solids, const RigidTransform& worldFromHull, const physics::ConvexHull& hull,
             render::Color color) {
    for (const physics::ConvexHull::Face& face : hull.faces()) {
        const vec3 normal = worldFromHull.rotation * face.normal;
        const std::span<const int> loop = hull.cornersOf(face);
        for (std::size_t i = 1; i + 1 < loop.size(); ++i)
            for (const int corner : {loop[0], loop[i], loop[i + 1]})
                solids.vertices.push_back({worldFromHull * hull.points()[corner], normal, color});
    }
}

}  // namespace lutka::scene
