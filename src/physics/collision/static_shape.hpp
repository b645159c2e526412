#pragma once

#include <memory>

#include "core/rigid_transform.hpp"
#include "core/shape_kind.hpp"
#include "physics/collision/collision_filter.hpp"
#include "physics/collision/friction.hpp"
#include "physics/collision/triangle_mesh.hpp"

namespace lutka::physics {

/// Static geometry of a scene. Its distance is known in closed form, which the quality metrics use.
struct StaticShape {
    using Kind = ShapeKind;
    Kind kind = Kind::plane;
    RigidTransform worldFromShape;     ///< A plane is the shape's y = 0, solid below; a capsule lies along y; centred.
    vec3 halfExtents{1, 1, 1};         ///< Box, metres.
    float friction = kStaticFriction;  ///< Coulomb's, >= 0; a contact has it times kBodyFriction.
    float radius = 0.5F;               ///< Sphere and capsule, metres.
    float halfLength = 0.5F;           ///< Capsule: half the distance of the cap centres, metres.
    std::shared_ptr<const TriangleMesh> mesh;  ///< Mesh; not null.
    CollisionFilter filter;
};

}  // namespace lutka::physics
