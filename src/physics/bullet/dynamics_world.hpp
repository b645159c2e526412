#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>

#include "physics/bullet/analytic_collision.hpp"
#include "physics/bullet/bullet_world.hpp"
#include "physics/bullet/substep_solver.hpp"
#include "physics/world.hpp"

namespace lutka::physics {

/// btDiscreteDynamicsWorld solved by SubstepSolver, with thresholds of its own for falling asleep (Bullet's time is a
/// global variable).
class DynamicsWorld final : public btDiscreteDynamicsWorld {
  public:
    DynamicsWorld(btDispatcher* dispatcher, btBroadphaseInterface* broadphase, btConstraintSolver* solver,
                  btCollisionConfiguration* configuration, const BulletTuning& tuning)
        : btDiscreteDynamicsWorld(dispatcher, broadphase, solver, configuration), tuning_(tuning), solver_(tuning) {}

    void solveConstraints(btContactSolverInfo& info) override;

  protected:
    void integrateTransforms(btScalar timeStep) override;
    void updateActivationState(btScalar timeStep) override;

  private:
    BulletTuning tuning_;
    SubstepSolver solver_;
};

/// The objects that a Bullet world consists of, torn down in reverse order.
struct BulletParts {
    BulletParts(const WorldSettings& settings, const BulletTuning& tuning);

    std::unique_ptr<btDefaultCollisionConfiguration> configuration;
    std::unique_ptr<AnalyticCollisionFactory> analytic;  // null in a stock world
    std::unique_ptr<btCollisionDispatcher> dispatcher;
    std::unique_ptr<btBroadphaseInterface> broadphase;
    std::unique_ptr<btOverlapFilterCallback> pairFilter;  // null in a stock world
    std::unique_ptr<btConstraintSolver> solver;
    std::unique_ptr<btDiscreteDynamicsWorld> world;
};

}  // namespace lutka::physics
