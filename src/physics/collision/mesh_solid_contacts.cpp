#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <span>

#include "physics/collision/mesh_contacts.hpp"
#include "physics/collision/solid_corners.hpp"

namespace lutka::physics {
namespace {

// An edge of a solid in the mesh's space.
struct SolidEdge {
    Segment segment;
    vec3 normals[2];  // unit, out of the two sides that meet there
};

// The edges of a box or hull in a mesh's space.
std::span<const SolidEdge> edgesOf(const CollisionGeometry& solid, const RigidTransform& meshFromSolid,
                                   std::array<SolidEdge, ConvexHull::kMostEdges>& room) {
    const quat& turn = meshFromSolid.rotation;
    if (solid.kind == ShapeKind::hull) {
        const std::span<const ConvexHull::Edge> edges = solid.hull->edges();
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const Segment segment{meshFromSolid * solid.hull->points()[edges[i].from],
                                  meshFromSolid * solid.hull->points()[edges[i].to]};
            room[i] = {segment, turn * solid.hull->faces()[edges[i].left].normal,
                       turn * solid.hull->faces()[edges[i].right].normal};
        }
        return std::span(room).first(edges.size());
    }
    constexpr int kBoxEdges = 12;
    for (int i = 0; i < kBoxEdges; ++i) {
        const Segment edge = boxEdge(solid.halfExtents, i);
        const int axis = i / 4;
        room[i].segment = {meshFromSolid * edge.start, meshFromSolid * edge.end};
        for (int side = 0; side < 2; ++side) {
            const int across = (axis + 1 + side) % 3;
            vec3 normal(0);
            normal[across] = edge.start[across] < 0.0F ? -1.0F : 1.0F;
            room[i].normals[side] = turn * normal;
        }
    }
    return std::span(room).first(kBoxEdges);
}

// What lies beside an edge of a solid on its sides, away from the edge and across it.
bool leadsOut(const SolidEdge& edge, const vec3& direction) {
    constexpr float kFlat = 2e-3F;  // as TriangleMesh's
    const float cosine = glm::dot(edge.normals[0], edge.normals[1]);
    return glm::dot(direction, cosine * edge.normals[0] - edge.normals[1]) < kFlat &&
           glm::dot(direction, cosine * edge.normals[1] - edge.normals[0]) < kFlat;
}

// Where an edge of a solid and one of a mesh are nearest, if both have an outside there. Without its feature.
std::optional<MeshContact> crossingOf(const TriangleMesh& mesh, int index, const SolidEdge& solid) {
    constexpr float kParallel = 1e-3F;
    constexpr float kCorner = 1e-4F;  // of an edge: corners have contacts of their own
    const TriangleMesh::Edge& edge = mesh.edges()[index];
    const vec3 start = mesh.vertices()[edge.start];
    const vec3 along = mesh.vertices()[edge.end] - start;
    const vec3 own = solid.segment.end - solid.segment.start;
    vec3 normal = glm::cross(own, along);
    const float across = glm::length(normal);
    if (across < kParallel * glm::length(own) * glm::length(along)) return std::nullopt;
    normal /= across;
    const vec3 between = start - solid.segment.start;
    const float onOwn = glm::dot(glm::cross(between, along), normal) / across;
    const float onMesh = glm::dot(glm::cross(between, own), normal) / across;
    if (onOwn < kCorner || onOwn > 1.0F - kCorner || onMesh < kCorner || onMesh > 1.0F - kCorner) return std::nullopt;
    if (!(leadsOut(solid, -normal) && mesh.edgeSupports(index, normal))) normal = -normal;
    if (!(leadsOut(solid, -normal) && mesh.edgeSupports(index, normal))) return std::nullopt;
    return MeshContact{solid.segment.at(onOwn), normal, -glm::dot(normal, between), 0};
}

// Of two edges that cross: known by both.
int featureOf(int meshEdge, std::size_t solidEdge) {
    constexpr int kFirst = 1 << 22;
    constexpr std::int64_t kPairs = 1 << 20;
    constexpr std::int64_t kStride = 97;  // more than a hull has edges
    return kFirst + static_cast<int>((meshEdge * kStride + static_cast<std::int64_t>(solidEdge)) % kPairs);
}

// How far a solid reaches beyond the surface at a contact, as if that went on for ever: what it takes to lead all of it
// out along the contact's normal.
float gapAlong(const MeshContact& contact, std::span<const SolidEdge> edges) {
    float lowest = std::numeric_limits<float>::max();
    for (const SolidEdge& edge : edges)
        lowest = std::min(
            {lowest, glm::dot(contact.normal, edge.segment.start), glm::dot(contact.normal, edge.segment.end)});
    return lowest - (glm::dot(contact.normal, contact.core) - contact.gap);
}

// A box or hull near a mesh.
struct Pair {
    const TriangleMesh& mesh;
    const SolidCorners& corners;
    const RigidTransform& meshFromSolid;
    std::span<const SolidEdge> edges;
    vec3 low, high;  // of the solid and what lies nearer to it than `reach`
    float reach;
};

// Calls `visit` with each crossing of two edges.
template <class Visit>
void visitCrossings(const Pair& pair, Visit visit) {
    pair.mesh.forEachIn(pair.low, pair.high, [&](int triangle) {
        for (const int index : pair.mesh.edgesOf(triangle)) {
            const TriangleMesh::Edge& edge = pair.mesh.edges()[index];
            if (!edge.sharp || edge.triangle[0] != triangle) continue;
            for (std::size_t i = 0; i < pair.edges.size(); ++i) {
                std::optional<MeshContact> crossing = crossingOf(pair.mesh, index, pair.edges[i]);
                if (!crossing || crossing->gap > pair.reach || crossing->gap < -kDeepestInMesh) continue;
                crossing->feature = featureOf(index, i);
                visit(*crossing);
            }
        }
    });
}

// Calls `visit` with each vertex of the mesh at a side of the solid.
template <class Visit>
void visitPeaks(const Pair& pair, Visit visit) {
    const RigidTransform solidFromMesh = inverse(pair.meshFromSolid);
    pair.mesh.forEachIn(pair.low, pair.high, [&](int triangle) {
        for (const int vertex : pair.mesh.triangles()[triangle]) {
            if (pair.mesh.ownerOf(vertex) != triangle) continue;
            const vec3 peak = pair.mesh.vertices()[vertex];
            const SurfaceDistance surface = pair.corners.wayOut(solidFromMesh * peak, [&](const vec3& outward) {
                return pair.mesh.vertexSupports(vertex, pair.meshFromSolid.rotation * -outward);
            });
            if (surface.distance >= pair.reach) continue;
            const vec3 normal = pair.meshFromSolid.rotation * -surface.normal;  // from the mesh towards the solid
            constexpr int kFirstPeak = 1 << 19;                                 // beyond the numbers of points
            visit(MeshContact{peak + surface.distance * normal, normal, surface.distance, kFirstPeak + vertex});
        }
    });
}

}  // namespace

void touchMesh(const TriangleMesh& mesh, const CollisionGeometry& solid, const RigidTransform& meshFromSolid,
               float reach, MeshContactList& out) {
    const SolidCorners corners(solid);
    vec3 low = meshFromSolid.translation;
    vec3 high = low;
    for (int corner = 0; corner < corners.count(); ++corner) {
        const vec3 inMesh = meshFromSolid * corners[corner];
        touchMesh(mesh, inMesh, corner, reach, out);
        low = glm::min(low, inMesh);
        high = glm::max(high, inMesh);
    }
    std::array<SolidEdge, ConvexHull::kMostEdges> room;
    const Pair pair{mesh,        corners,      meshFromSolid, edgesOf(solid, meshFromSolid, room),
                    low - reach, high + reach, reach};
    // Edges and peaks far inside lead out, too, but by a longer way than is needed.
    MeshContact way;
    way.gap = std::numeric_limits<float>::lowest();
    const auto take = [&](const MeshContact& contact, float gap) {
        if (contact.gap >= 0.0F || gap <= way.gap) return;
        way = contact;
        way.gap = gap;
    };
    for (int i = 0; i < out.count; ++i)
        take(out.contacts[i], gapAlong(out.contacts[i], pair.edges));
    const auto takeOwn = [&](const MeshContact& contact) { take(contact, contact.gap); };
    visitCrossings(pair, takeOwn);
    visitPeaks(pair, takeOwn);
    const auto keep = [&](const MeshContact& contact) {
        constexpr float kSameWay = 0.9F;  // cosine
        constexpr float kSameDepth = 0.002F;
        if (contact.gap >= 0.0F || contact.gap > way.gap - kSameDepth ||
            glm::dot(contact.normal, way.normal) > kSameWay)
            out.add(contact);
    };
    visitCrossings(pair, keep);
    visitPeaks(pair, keep);
}

}  // namespace lutka::physics
