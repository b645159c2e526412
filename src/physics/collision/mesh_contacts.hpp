#pragma once

#include <array>

#include "physics/collision/contacts.hpp"
#include "physics/collision/shape_distance.hpp"
#include "physics/collision/triangle_mesh.hpp"

namespace lutka::physics {

/// Where a shape's core (a point of it, mesh space) is near a mesh.
struct MeshContact {
    vec3 core{0, 0, 0};
    vec3 normal{0, 1, 0};  ///< Unit, out of the solid.
    float gap = 0.0F;      ///< Metres from the surface to the core point; negative behind the surface.
    int feature = 0;  ///< The same a step later where the core's part and about the same slope meet: below kFirstPeak;
                      ///< of the mesh's vertices and of two edges from there on.

    static constexpr int kFirstPeak = 1 << 19;
    static constexpr int kPeaks = 1 << 19;
    static constexpr int kFirstCrossing = 1 << 21;  ///< Beyond what crowd/static_contacts adds to others, 2²⁰.
    static constexpr int kCrossings = 1 << 20;
};

/// At most eight contacts, the deepest where there are more.
struct MeshContactList {
    static constexpr int kMax = 8;
    std::array<MeshContact, kMax> contacts;
    int count = 0;

    void add(const MeshContact& contact);
};

/// Contacts of one point of a core, number `part` in [0, 63), nearer to the surface than `reach` metres. There is one
/// for each local minimum of the distance to the surface: neighbouring triangles of a plane give one contact with the
/// plane's normal, so that nothing bumps into the edge between them, and the two sides of a valley give one each. A
/// point behind the surface, up to kDeepestInMesh, has one contact that leads out the shortest way.
void touchMesh(const TriangleMesh& mesh, const vec3& point, int part, float reach, MeshContactList& out);

/// Contacts of a capsule's core (both ends, and sharp edges and corners that come near in between).
void touchMesh(const TriangleMesh& mesh, const Segment& core, float reach, MeshContactList& out);

/// Contacts of a box or hull, added to `out`: its corners as above, the mesh's vertices at its sides, and where its
/// edges cross sharp ones of the mesh, if the line between the two leads out of both (their arcs on the Gauss map
/// cross: Gregorius, The Separating Axis Test between Convex Polyhedra, 2013). Of vertices and crossings that overlap
/// those are left out that a shorter way out at another contact clears. `solid` is taken where `meshFromSolid` puts it,
/// metres, not at its own `worldFromShape`.
void touchMesh(const TriangleMesh& mesh, const CollisionGeometry& solid, const RigidTransform& meshFromSolid,
               float reach, MeshContactList& out);

/// How far behind the surface a point is still led out, metres.
inline constexpr float kDeepestInMesh = 0.3F;

}  // namespace lutka::physics
