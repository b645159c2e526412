#pragma once

#include <btBulletDynamicsCommon.h>

#include <span>
#include <vector>

#include "physics/collision/contacts.hpp"

namespace lutka::physics {

/// What findContacts() is to know of a Bullet shape, but for where it is; false for shapes that it does not know.
/// `reach`: radius of a ball around its centre that holds it, metres; FLT_MAX for planes and meshes.
[[nodiscard]] bool describeShape(const btCollisionShape& shape, CollisionGeometry& geometry, float& reach);

/// The geometry of every collision object of a world where it is now, worked out once a substep instead of once a pair.
class GeometryCache {
  public:
    /// Brings the moving bodies up to date, and all objects when some were added or removed. `seconds`: the substep to
    /// come.
    void refresh(const btCollisionObjectArray& objects, std::span<btRigidBody* const> moving, float seconds);

    /// Call when an object was added: it may lie where a removed one did.
    void invalidate() { stale_ = true; }

    /// Of an object that was in the world at the last refresh().
    [[nodiscard]] const CollisionGeometry& of(const btCollisionObject& object) const {
        return geometries_[object.getWorldArrayIndex()];
    }
    /// Radius of a ball around the object's centre that holds it; FLT_MAX for planes and meshes.
    [[nodiscard]] float reachOf(const btCollisionObject& object) const { return reaches_[object.getWorldArrayIndex()]; }
    /// How much farther than usual contacts of the object must be foreseen, metres: 0 but for what is fast enough to
    /// pass through the usual margin within the substep.
    [[nodiscard]] float aheadOf(const btCollisionObject& object) const { return aheads_[object.getWorldArrayIndex()]; }
    /// Whether the object is a capsule, sphere, box, hull, plane or mesh, as findContacts() knows them.
    [[nodiscard]] bool knows(const btCollisionObject& object) const { return known_[object.getWorldArrayIndex()] != 0; }

  private:
    void place(int index, const btCollisionObject& object);

    std::vector<CollisionGeometry> geometries_;
    std::vector<float> reaches_;
    std::vector<float> aheads_;
    std::vector<char> known_;
    bool stale_ = true;
};

}  // namespace lutka::physics
