#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include "physics/bullet/geometry_cache.hpp"

namespace lutka::physics {

/// Makes AnalyticCollision for pairs of capsules, spheres, boxes (not two of them) and planes, and for capsules and
/// spheres on meshes (whose shape's user pointer is the TriangleMesh): contacts in closed form,
/// one at each end of a lying capsule, and a manifold only while there are any. Must outlive the dispatcher.
class AnalyticCollisionFactory final : public btCollisionAlgorithmCreateFunc {
  public:
    /// `margin`: how far apart, in metres, shapes have contacts already. `geometries` must outlive the factory and be
    /// fresh whenever pairs are collided.
    AnalyticCollisionFactory(float margin, const GeometryCache& geometries)
        : margin_(margin), geometries_(geometries) {}

    /// Whether the pair is ours.
    [[nodiscard]] bool handles(const btCollisionObject& a, const btCollisionObject& b) const;
    /// Collides a pair of ours without what Bullet's near callback does around it.
    void collide(btBroadphasePair& pair, btCollisionDispatcher& dispatcher);

    btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                   const btCollisionObjectWrapper* a,
                                                   const btCollisionObjectWrapper* b) override;
    void registerWith(btCollisionDispatcher& dispatcher);

  private:
    [[nodiscard]] bool farApart(const btCollisionObject& a, const btCollisionObject& b) const;

    float margin_;
    const GeometryCache& geometries_;
};

}  // namespace lutka::physics
