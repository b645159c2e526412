#pragma once

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

#include "physics/bullet/bullet_world.hpp"

namespace lutka::physics {

/// Bullet's sequential impulses with what a ragdoll lacks there: joints start from their impulses of the step before,
/// and overlapping shapes part with a bounded speed.
class WarmSolver final : public btSequentialImpulseConstraintSolver {
  public:
    explicit WarmSolver(const BulletTuning& tuning) : tuning_(tuning) {}

  protected:
    void convertJoints(btTypedConstraint** constraints, int count, const btContactSolverInfo& info) override;
    void convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) override;
    btScalar solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int count,
                                           const btContactSolverInfo& info) override;

  private:
    BulletTuning tuning_;
};

}  // namespace lutka::physics
