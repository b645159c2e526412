#include "physics/collision/mesh_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lutka::physics {
namespace {

constexpr int kParts = 64;
constexpr int kBetween = 63;  // the part of a capsule between its ends

// A part and a direction in steps of an eighth: what a contact is known by from step to step.
int featureOf(int part, const vec3& normal) {
    const auto step = [](float x) { return static_cast<int>(std::lround(8.0F * x)) + 8; };
    return (((step(normal.x) * 17) + step(normal.y)) * 17 + step(normal.z)) * kParts + part;
}

void add(MeshContactList& out, const vec3& core, const vec3& away, float gap, int part) {
    const vec3 normal = away / gap;
    out.add({core, normal, gap, featureOf(part, normal)});
}

// The triangle's own nearest point to one in front of the mesh, if the surface has none nearer around it.
void touchTriangle(const TriangleMesh& mesh, int triangle, const vec3& point, int part, float reach,
                   MeshContactList& out) {
    const auto vertices = mesh.vertices();
    const TriangleMesh::Triangle& corners = mesh.triangles()[triangle];
    const TrianglePoint on = nearestOnTriangle(vertices[corners[0]], vertices[corners[1]], vertices[corners[2]], point);
    const vec3 away = point - on.position;
    const float gap = glm::length(away);
    if (gap > reach || gap < 1e-6F) return;
    bool own = false;
    if (on.region == 0) {
        own = glm::dot(away, mesh.normals()[triangle]) > 0.0F;
    } else if (on.region < 4) {
        const int edge = mesh.edgesOf(triangle)[on.region - 1];
        own = mesh.edges()[edge].triangle[0] == triangle && mesh.edgeSupports(edge, away / gap);
    } else {
        const int vertex = corners[on.region - 4];
        own = mesh.ownerOf(vertex) == triangle && mesh.vertexSupports(vertex, away / gap);
    }
    if (own) add(out, point, away, gap, part);
}

// A sharp edge against the inner part of a core.
void touchEdge(const TriangleMesh& mesh, int index, const Segment& core, float length, float reach,
               MeshContactList& out) {
    const TriangleMesh::Edge& edge = mesh.edges()[index];
    const Segment line{mesh.vertices()[edge.start], mesh.vertices()[edge.end]};
    const SegmentPair at = closestBetweenSegments(core, line);
    const float nearAnEnd = kSamePlace / length;
    if (at.s < nearAnEnd || at.s > 1.0F - nearAnEnd) return;
    const vec3 onCore = core.at(at.s);
    vec3 away = onCore - line.at(at.t);
    float gap = glm::length(away);
    if (gap > reach) return;
    vec3 outward = mesh.normals()[edge.triangle[0]];
    if (edge.triangle[1] >= 0) outward += mesh.normals()[edge.triangle[1]];
    const bool behind = edge.triangle[1] >= 0 && glm::dot(away, outward) < 0.0F;
    vec3 normal = gap > 1e-5F ? away / (behind ? -gap : gap) : glm::normalize(outward);
    constexpr float kCorner = 1e-4F;  // of the edge
    const bool owned = at.t < kCorner          ? mesh.vertexSupports(edge.start, normal)
                       : at.t > 1.0F - kCorner ? mesh.vertexSupports(edge.end, normal)
                                               : mesh.edgeSupports(index, normal);
    if (!owned) return;
    out.add({onCore, normal, behind ? -gap : gap, featureOf(kBetween, normal)});
}

}  // namespace

void MeshContactList::add(const MeshContact& contact) {
    int shallowest = 0;
    for (int i = 0; i < count; ++i) {
        if (contacts[i].feature == contact.feature) {
            if (contact.gap < contacts[i].gap) contacts[i] = contact;
            return;
        }
        if (contacts[i].gap > contacts[shallowest].gap) shallowest = i;
    }
    if (count < kMax)
        contacts[count++] = contact;
    else if (contact.gap < contacts[shallowest].gap)
        contacts[shallowest] = contact;
}

void touchMesh(const TriangleMesh& mesh, const vec3& point, int part, float reach, MeshContactList& out) {
    const MeshDistance nearest = mesh.distanceTo(point, std::max(reach, kDeepestInMesh));
    if (!nearest.found || nearest.distance > reach) return;
    if (nearest.distance <= 1e-6F) {
        out.add({point, nearest.normal, nearest.distance, featureOf(part, nearest.normal)});
        return;
    }
    mesh.forEachIn(point - reach, point + reach,
                   [&](int triangle) { touchTriangle(mesh, triangle, point, part, reach, out); });
}

void touchMesh(const TriangleMesh& mesh, const Segment& core, float reach, MeshContactList& out) {
    touchMesh(mesh, core.start, 0, reach, out);
    const float length = glm::length(core.end - core.start);
    if (length <= 0.0F) return;
    touchMesh(mesh, core.end, 1, reach, out);
    if (length <= 2.0F * kSamePlace) return;
    mesh.forEachIn(glm::min(core.start, core.end) - reach, glm::max(core.start, core.end) + reach, [&](int triangle) {
        for (const int edge : mesh.edgesOf(triangle)) {
            if (mesh.edges()[edge].sharp && mesh.edges()[edge].triangle[0] == triangle)
                touchEdge(mesh, edge, core, length, reach, out);
        }
    });
}

}  // namespace lutka::physics
