#include "physics/bullet/geometry_cache.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "physics/bullet/convert.hpp"

namespace lutka::physics {
namespace {

constexpr float kForeseen = 0.03F;  // metres of motion in a substep that the usual margin covers
constexpr float kFar = std::numeric_limits<float>::max();

}  // namespace

bool describeShape(const btCollisionShape& shape, CollisionGeometry& geometry, float& reach) {
    reach = kFar;
    switch (shape.getShapeType()) {
        case CAPSULE_SHAPE_PROXYTYPE: {
            const auto& capsule = static_cast<const btCapsuleShape&>(shape);
            geometry.radius = capsule.getRadius();
            geometry.halfLength = capsule.getHalfHeight();
            reach = geometry.radius + geometry.halfLength;
            return true;
        }
        case SPHERE_SHAPE_PROXYTYPE:
            geometry.radius = static_cast<const btSphereShape&>(shape).getRadius();
            reach = geometry.radius;
            return true;
        case BOX_SHAPE_PROXYTYPE:
            geometry.kind = ShapeKind::box;
            geometry.halfExtents = fromBullet(static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin());
            reach = glm::length(geometry.halfExtents);
            return true;
        case CONVEX_HULL_SHAPE_PROXYTYPE:
            geometry.kind = ShapeKind::hull;
            geometry.hull = static_cast<const ConvexHull*>(shape.getUserPointer());
            if (geometry.hull == nullptr) return false;
            reach = geometry.hull->reach();
            return true;
        case STATIC_PLANE_PROXYTYPE:
            geometry.kind = ShapeKind::plane;
            return true;
        case TRIANGLE_MESH_SHAPE_PROXYTYPE:
            geometry.kind = ShapeKind::mesh;
            geometry.mesh = static_cast<const TriangleMesh*>(shape.getUserPointer());
            return geometry.mesh != nullptr;
        default:
            return false;
    }
}

void GeometryCache::place(int index, const btCollisionObject& object) {
    CollisionGeometry& geometry = geometries_[index];
    geometry.worldFromShape = fromBullet(object.getWorldTransform());
    if (geometry.kind != ShapeKind::plane || known_[index] == 0) return;
    const auto& plane = static_cast<const btStaticPlaneShape&>(*object.getCollisionShape());
    const quat turn = rotationBetween({0, 1, 0}, fromBullet(plane.getPlaneNormal()));
    geometry.worldFromShape =
        geometry.worldFromShape * RigidTransform{turn, turn * vec3(0, plane.getPlaneConstant(), 0)};
}

void GeometryCache::refresh(const btCollisionObjectArray& objects, std::span<btRigidBody* const> moving,
                            float seconds) {
    const auto count = static_cast<std::size_t>(objects.size());
    if (count == geometries_.size() && !stale_) {
        for (const btRigidBody* body : moving) {
            const int index = body->getWorldArrayIndex();
            place(index, *body);
            const float reach = known_[index] != 0 ? reaches_[index] : 0.0F;
            const float moved =
                seconds * (body->getLinearVelocity().length() + reach * body->getAngularVelocity().length());
            aheads_[index] = std::max(moved - kForeseen, 0.0F);
        }
        return;
    }
    stale_ = false;
    geometries_.assign(count, {});
    reaches_.assign(count, kFar);
    aheads_.assign(count, 0.0F);
    known_.assign(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
        const btCollisionObject& object = *objects[static_cast<int>(i)];
        known_[i] = describeShape(*object.getCollisionShape(), geometries_[i], reaches_[i]) ? 1 : 0;
        place(static_cast<int>(i), object);
    }
    refresh(objects, moving, seconds);
}

}  // namespace lutka::physics
