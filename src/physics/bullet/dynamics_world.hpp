#pragma once

#include <btBulletDynamicsCommon.h>

#include <chrono>
#include <memory>
#include <vector>

#include "physics/bullet/analytic_collision.hpp"
#include "physics/bullet/bullet_world.hpp"
#include "physics/bullet/substep_solver.hpp"
#include "physics/world/world.hpp"

namespace lutka::physics {

/// btDiscreteDynamicsWorld that takes the time of its parts.
class MeasuredWorld : public btDiscreteDynamicsWorld {
  public:
    using btDiscreteDynamicsWorld::btDiscreteDynamicsWorld;

    void performDiscreteCollisionDetection() override;
    /// Of all steps since clearTimes(); the solver's is what is left of `stepMs`.
    [[nodiscard]] StepTimes times(double stepMs) const;
    void clearTimes() { times_ = {}; }

  protected:
    using Clock = std::chrono::steady_clock;
    void addTimes(Clock::duration broadphase, Clock::duration narrowphase);

  private:
    [[nodiscard]] int countIslands() const;

    StepTimes times_;
};

/// btDiscreteDynamicsWorld solved by SubstepSolver, with thresholds of its own for falling asleep (Bullet's time is a
/// global variable). A substep does only what its awake bodies need: no prediction of transforms, boxes in the
/// broadphase that are wide enough to stay for a while, pairs of our shapes collided straight from a cache of geometry.
class DynamicsWorld final : public MeasuredWorld {
  public:
    DynamicsWorld(btCollisionDispatcher* dispatcher, btBroadphaseInterface* broadphase, btConstraintSolver* solver,
                  btCollisionConfiguration* configuration, const BulletTuning& tuning, GeometryCache& geometries,
                  AnalyticCollisionFactory& analytic);

    /// One substep of `seconds`; the other arguments are not looked at.
    int stepSimulation(btScalar seconds, int maxSubSteps, btScalar fixedTimeStep) override;
    void addCollisionObject(btCollisionObject* object, int group, int mask) override;
    void solveConstraints(btContactSolverInfo& info) override;
    /// For rays: after the step, bodies have moved on.
    void refreshAabbs();
    void updateAabbs() override;
    void performDiscreteCollisionDetection() override;

  protected:
    void internalSingleStepSimulation(btScalar timeStep) override;
    void predictUnconstraintMotion(btScalar timeStep) override;
    void updateActivationState(btScalar timeStep) override;

  private:
    void listAwake();

    BulletTuning tuning_;
    GeometryCache& geometries_;
    AnalyticCollisionFactory& analytic_;
    btCollisionDispatcher& ownDispatcher_;
    SubstepSolver solver_;
    std::vector<btRigidBody*> awake_;
};

/// The objects that a Bullet world consists of, torn down in reverse order.
struct BulletParts {
    BulletParts(const WorldSettings& settings, const BulletTuning& tuning);

    std::unique_ptr<btDefaultCollisionConfiguration> configuration;
    GeometryCache geometries;
    std::unique_ptr<AnalyticCollisionFactory> analytic;  // null in a stock world
    std::unique_ptr<btCollisionDispatcher> dispatcher;
    std::unique_ptr<btBroadphaseInterface> broadphase;
    std::unique_ptr<btOverlapFilterCallback> pairFilter;  // null in a stock world
    std::unique_ptr<btConstraintSolver> solver;
    std::unique_ptr<MeasuredWorld> world;
};

}  // namespace lutka::physics
