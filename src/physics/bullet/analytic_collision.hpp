#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

namespace lutka::physics {

/// Makes AnalyticCollision for pairs of capsules, spheres, boxes (not two of them) and planes, and for capsules and
/// spheres on meshes (whose shape's user pointer is the TriangleMesh): contacts in closed form,
/// one at each end of a lying capsule, and a manifold only while there are any. Must outlive the dispatcher.
class AnalyticCollisionFactory final : public btCollisionAlgorithmCreateFunc {
  public:
    /// `margin`: how far apart, in metres, shapes have contacts already.
    explicit AnalyticCollisionFactory(float margin) : margin_(margin) {}

    btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                   const btCollisionObjectWrapper* a,
                                                   const btCollisionObjectWrapper* b) override;
    void registerWith(btCollisionDispatcher& dispatcher);

  private:
    float margin_;
};

}  // namespace lutka::physics
