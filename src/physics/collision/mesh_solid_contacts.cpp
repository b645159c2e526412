#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <span>

#include "core/aabb.hpp"
#include "core/assert.hpp"
#include "physics/collision/mesh_contacts.hpp"
#include "physics/collision/solid_corners.hpp"

namespace lutka::physics {
namespace {

// An edge of a solid in the mesh's space.
struct OutlineEdge {
    OutlineEdge() = default;
    OutlineEdge(const Segment& s, const vec3& left, const vec3& right)
        : segment(s), along(s.end - s.start), length(glm::length(along)), normals{left, right} {}

    Segment segment;
    vec3 along{0, 0, 0};
    float length = 0.0F;
    vec3 normals[2];  // unit, out of the two sides that meet there
};

// A sharp edge of a mesh.
struct SharpEdge {
    SharpEdge(const TriangleMesh& mesh, int edge)
        : index(edge),
          start(mesh.vertices()[mesh.edges()[edge].start]),
          along(mesh.vertices()[mesh.edges()[edge].end] - start),
          length(glm::length(along)) {}

    int index;
    vec3 start;
    vec3 along;
    float length;
};

// Sine of the angle between two sides below which what they share is no edge but a line of a flat side.
constexpr float kFlatSides = 0.01F;

// The edges of a box or hull in a mesh's space.
std::span<const OutlineEdge> edgesOf(const CollisionGeometry& solid, const RigidTransform& meshFromSolid,
                                     std::array<OutlineEdge, ConvexHull::kMostEdges>& room) {
    const quat& turn = meshFromSolid.rotation;
    if (solid.kind == ShapeKind::hull) {
        LUTKA_ASSERT(solid.hull->edges().size() <= room.size());
        std::size_t count = 0;
        for (const ConvexHull::Edge& edge : solid.hull->edges()) {
            const vec3& left = solid.hull->faces()[edge.left].normal;
            const vec3& right = solid.hull->faces()[edge.right].normal;
            if (glm::length(glm::cross(left, right)) < kFlatSides) continue;
            const Segment segment{meshFromSolid * solid.hull->points()[edge.from],
                                  meshFromSolid * solid.hull->points()[edge.to]};
            room[count++] = OutlineEdge(segment, turn * left, turn * right);
        }
        return std::span(room).first(count);
    }
    constexpr int kBoxEdges = 12;
    for (int i = 0; i < kBoxEdges; ++i) {
        const Segment edge = boxEdge(solid.halfExtents, i);
        const int axis = i / 4;
        const auto normalAlong = [&](int across) {
            vec3 normal(0);
            normal[across] = edge.start[across] < 0.0F ? -1.0F : 1.0F;
            return turn * normal;
        };
        room[i] = OutlineEdge({meshFromSolid * edge.start, meshFromSolid * edge.end}, normalAlong((axis + 1) % 3),
                              normalAlong((axis + 2) % 3));
    }
    return std::span(room).first(kBoxEdges);
}

// Whether a direction leads away from both sides of an edge of a solid.
bool leadsOut(const OutlineEdge& edge, const vec3& direction) {
    const float cosine = glm::dot(edge.normals[0], edge.normals[1]);
    for (int side = 0; side < 2; ++side) {
        const vec3 inside = cosine * edge.normals[side] - edge.normals[1 - side];  // on that side, away from the edge
        if (risesAbove(direction, inside)) return false;
    }
    return true;
}

// Where an edge of a solid, moved by `shift`, and one of a mesh are nearest, if both have an outside there. Without its
// feature.
std::optional<MeshContact> crossingOf(const TriangleMesh& mesh, const SharpEdge& edge, const OutlineEdge& solid,
                                      const vec3& shift = vec3(0)) {
    constexpr float kParallel = 1e-3F;
    constexpr float kCorner = 1e-4F;  // of an edge: corners have contacts of their own
    vec3 normal = glm::cross(solid.along, edge.along);
    const float across = glm::length(normal);
    if (across < kParallel * solid.length * edge.length) return std::nullopt;
    normal /= across;
    const vec3 between = edge.start - solid.segment.start - shift;
    const float onOwn = glm::dot(glm::cross(between, edge.along), normal) / across;
    const float onMesh = glm::dot(glm::cross(between, solid.along), normal) / across;
    if (onOwn < kCorner || onOwn > 1.0F - kCorner || onMesh < kCorner || onMesh > 1.0F - kCorner) return std::nullopt;
    const auto isWayOut = [&] { return leadsOut(solid, -normal) && mesh.edgeSupports(edge.index, normal); };
    if (!isWayOut()) normal = -normal;
    if (!isWayOut()) return std::nullopt;
    const float gap = -glm::dot(normal, between);
    // The rim of a sheet keeps nothing in that is above it.
    const int(&triangles)[2] = mesh.edges()[edge.index].triangle;
    const bool isRim = triangles[1] < 0;
    if (isRim && gap < 0.0F && glm::dot(normal, mesh.normals()[triangles[0]]) < 0.0F) return std::nullopt;
    return MeshContact{solid.segment.at(onOwn) + shift, normal, gap, 0};
}

// Of two edges that cross: known by both. Others have the same number once in a million.
int featureOf(int meshEdge, std::size_t solidEdge) {
    const std::uint32_t both =
        static_cast<std::uint32_t>(meshEdge) * 2654435761U + static_cast<std::uint32_t>(solidEdge) * 40503U;
    return MeshContact::kFirstCrossing + static_cast<int>(both % MeshContact::kCrossings);
}

// How far a solid reaches beyond the surface at a contact, as if that went on for ever: what it takes to lead all of it
// out along the contact's normal.
float gapAlong(const MeshContact& contact, std::span<const OutlineEdge> edges) {
    float lowest = std::numeric_limits<float>::max();
    for (const OutlineEdge& edge : edges)
        lowest = std::min(
            {lowest, glm::dot(contact.normal, edge.segment.start), glm::dot(contact.normal, edge.segment.end)});
    return lowest - (glm::dot(contact.normal, contact.core) - contact.gap);
}

// A box or hull near a mesh.
struct SolidNearMesh {
    const TriangleMesh& mesh;
    const SolidCorners& corners;
    RigidTransform meshFromSolid;
    RigidTransform solidFromMesh;
    std::span<const OutlineEdge> edges;
    vec3 low, high;  // of the solid and what lies nearer to it than `reach`
    float reach;
};

// A contact of two edges, or of a vertex of the mesh at a side of the solid.
struct Crossing {
    MeshContact contact;
    int meshEdge = -1;
    int solidEdge = -1;
    int vertex = -1;
};

// The contact of a vertex of the mesh with a side of the solid, which has moved by `shift`.
MeshContact peakOf(const SolidNearMesh& pair, int vertex, const vec3& shift = vec3(0)) {
    const vec3 peak = pair.mesh.vertices()[vertex];
    const SurfaceDistance surface = pair.corners.wayOut(pair.solidFromMesh * (peak - shift), [&](const vec3& outward) {
        return pair.mesh.vertexSupports(vertex, pair.meshFromSolid.rotation * -outward);
    });
    const vec3 normal = pair.meshFromSolid.rotation * -surface.normal;  // from the mesh towards the solid
    return {peak + surface.distance * normal, normal, surface.distance,
            MeshContact::kFirstPeak + vertex % MeshContact::kPeaks};
}

// Calls `visit` with each contact of two edges and of a vertex that is nearer than `reach`.
template <class Visit>
void visitCrossings(const SolidNearMesh& pair, Visit visit) {
    pair.mesh.forEachIn(pair.low, pair.high, [&](int triangle) {
        for (const int index : pair.mesh.edgesOf(triangle)) {
            const TriangleMesh::Edge& edge = pair.mesh.edges()[index];
            if (!edge.sharp || edge.triangle[0] != triangle) continue;
            const SharpEdge sharp(pair.mesh, index);
            for (std::size_t i = 0; i < pair.edges.size(); ++i) {
                std::optional<MeshContact> contact = crossingOf(pair.mesh, sharp, pair.edges[i]);
                if (!contact || contact->gap > pair.reach || contact->gap < -kDeepestInMesh) continue;
                contact->feature = featureOf(index, i);
                visit(Crossing{*contact, index, static_cast<int>(i)});
            }
        }
        for (const int vertex : pair.mesh.triangles()[triangle]) {
            if (pair.mesh.ownerOf(vertex) != triangle) continue;
            const MeshContact contact = peakOf(pair, vertex);
            if (contact.gap < pair.reach) visit(Crossing{contact, -1, -1, vertex});
        }
    });
}

// A way that leads all of the solid out at one place.
struct WayOut {
    vec3 normal{0, 1, 0};
    float gap = 0.0F;  // negative
};

// Whether the solid, moved a way out, still overlaps there.
bool remainsAfter(const SolidNearMesh& pair, const Crossing& crossing, const WayOut& way) {
    constexpr float kClearM = 0.001F;
    const vec3 shift = (kClearM - way.gap) * way.normal;
    if (crossing.vertex >= 0) return peakOf(pair, crossing.vertex, shift).gap < 0.0F;
    const std::optional<MeshContact> contact =
        crossingOf(pair.mesh, SharpEdge(pair.mesh, crossing.meshEdge), pair.edges[crossing.solidEdge], shift);
    return contact && contact->gap < 0.0F;
}

// Overlaps, the shallowest first.
class Overlaps {
  public:
    void add(const Crossing& crossing) {
        int at = count_;
        if (count_ < kMost)
            ++count_;
        else if (crossing.contact.gap <= all_[kMost - 1].contact.gap)
            return;
        else
            at = kMost - 1;
        for (; at > 0 && all_[at - 1].contact.gap < crossing.contact.gap; --at)
            all_[at] = all_[at - 1];
        all_[at] = crossing;
    }
    [[nodiscard]] std::span<const Crossing> all() const { return std::span(all_).first(count_); }

  private:
    static constexpr int kMost = 32;
    std::array<Crossing, kMost> all_;
    int count_ = 0;
};

}  // namespace

void touchMesh(const TriangleMesh& mesh, const CollisionGeometry& solid, const RigidTransform& meshFromSolid,
               float reach, MeshContactList& out) {
    const SolidCorners corners(solid);
    Aabb box;
    box.add(meshFromSolid.translation);
    for (int corner = 0; corner < corners.count(); ++corner) {
        const vec3 inMesh = meshFromSolid * corners[corner];
        touchMesh(mesh, inMesh, corner, reach, out);
        box.add(inMesh);
    }
    std::array<OutlineEdge, ConvexHull::kMostEdges> room;
    const SolidNearMesh pair{mesh,
                             corners,
                             meshFromSolid,
                             inverse(meshFromSolid),
                             edgesOf(solid, meshFromSolid, room),
                             box.low - reach,
                             box.high + reach,
                             reach};
    // Edges and vertices far inside lead out, too, but by a longer way than is needed: what a shorter one clears is
    // left out. What overlaps elsewhere stays.
    constexpr int kMostWays = MeshContactList::kMax + 8;
    std::array<WayOut, kMostWays> ways;
    int wayCount = 0;
    for (int i = 0; i < out.count; ++i)
        if (out.contacts[i].gap < 0.0F)
            ways[wayCount++] = {out.contacts[i].normal, gapAlong(out.contacts[i], pair.edges)};
    Overlaps overlaps;
    visitCrossings(pair, [&](const Crossing& crossing) {
        if (crossing.contact.gap >= 0.0F)
            out.add(crossing.contact);
        else
            overlaps.add(crossing);
    });
    for (const Crossing& crossing : overlaps.all()) {
        constexpr float kSameWay = 0.9F;  // cosine
        const auto clears = [&](const WayOut& way) {
            return way.gap > crossing.contact.gap && glm::dot(way.normal, crossing.contact.normal) < kSameWay &&
                   !remainsAfter(pair, crossing, way);
        };
        if (std::any_of(ways.begin(), ways.begin() + wayCount, clears)) continue;
        out.add(crossing.contact);
        if (wayCount < kMostWays) ways[wayCount++] = {crossing.contact.normal, crossing.contact.gap};
    }
}

}  // namespace lutka::physics
