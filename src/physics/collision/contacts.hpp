#pragma once

#include <array>

#include "core/rigid_transform.hpp"
#include "physics/collision/shape_distance.hpp"
#include "physics/collision/static_shape.hpp"
#include "physics/profile/body_shape.hpp"

namespace lutka::physics {

/// What collides: a capsule (a segment along y with a radius; a sphere is one of no length), a box, a convex hull, a
/// half-space below y = 0, or a triangle mesh.
struct CollisionGeometry {
    ShapeKind kind = ShapeKind::capsule;  ///< Never `sphere`.
    float radius = 0.0F;                  ///< Metres; capsule.
    float halfLength = 0.0F;              ///< Metres; capsule, 0 for a sphere.
    vec3 halfExtents{0, 0, 0};            ///< Metres; box.
    RigidTransform worldFromShape;
    const TriangleMesh* mesh = nullptr;  ///< Not null for a mesh.
    const ConvexHull* hull = nullptr;    ///< Not null for a hull.
};

[[nodiscard]] CollisionGeometry geometryOf(const PrimitiveShape& shape, const RigidTransform& worldFromShape);
[[nodiscard]] CollisionGeometry geometryOf(const StaticShape& shape);

/// Where two shapes touch or soon will.
struct SurfaceContact {
    int feature = 0;         ///< Which part of the pair it belongs to: the same one a step later has the same number.
    vec3 position{0, 0, 0};  ///< World, on B's surface.
    vec3 normal{0, 1, 0};    ///< Unit, from B towards A.
    float distance = 0.0F;   ///< Metres between the surfaces; negative: depth of the overlap.
};

/// At most eight contacts of one pair; only meshes have more than four.
struct ContactList {
    static constexpr int kMax = 8;
    std::array<SurfaceContact, kMax> contacts;
    int count = 0;

    void add(const SurfaceContact& contact) {
        if (count < kMax) contacts[count++] = contact;
    }
};

/// The contacts of A with B that are nearer than `margin` metres, in closed form:
/// - a capsule that lies has one at each end;
/// - a box or hull on a plane has one at each corner, of a box at the four lowest, of a hull at the eight lowest;
/// - a round shape on a mesh has those of touchMesh();
/// - a box or hull on a mesh has them at its own corners, at the mesh's vertices, and where its edges cross sharp ones.
///
/// There are none between two of boxes and hulls, nor between two of planes and meshes: these are not handled.
[[nodiscard]] ContactList findContacts(const CollisionGeometry& a, const CollisionGeometry& b, float margin);

}  // namespace lutka::physics
