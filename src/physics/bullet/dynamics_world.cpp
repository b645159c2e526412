#include "physics/bullet/dynamics_world.hpp"

#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>

#include "physics/bullet/convert.hpp"
#include "physics/bullet/ragdoll.hpp"

namespace lutka::physics {
namespace {

// Pairs that never collide don't even become pairs of the broadphase.
struct PairFilter final : btOverlapFilterCallback {
    bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
        if ((a->m_collisionFilterGroup & b->m_collisionFilterMask) == 0 ||
            (b->m_collisionFilterGroup & a->m_collisionFilterMask) == 0)
            return false;
        const auto* first = static_cast<const btCollisionObject*>(a->m_clientObject);
        const auto* second = static_cast<const btCollisionObject*>(b->m_clientObject);
        if (first->getUserIndex() < 0 || first->getUserIndex() != second->getUserIndex()) return true;
        return static_cast<const Ragdoll*>(first->getUserPointer())
            ->mayCollide(first->getUserIndex2(), second->getUserIndex2());
    }
};

template <class T>
std::span<T* const> spanOf(const btAlignedObjectArray<T*>& array) {
    return array.size() > 0 ? std::span<T* const>(&array[0], array.size()) : std::span<T* const>();
}

}  // namespace

void DynamicsWorld::solveConstraints(btContactSolverInfo& info) {
    // Islands decide only what sleeps and what wakes; all that is awake is solved in one go.
    m_islandManager->buildIslands(getDispatcher(), this);
    solver_.solve(spanOf(m_nonStaticRigidBodies), spanOf(m_constraints), *getDispatcher(), info.m_timeStep);
}

void DynamicsWorld::integrateTransforms(btScalar timeStep) {
    solver_.moveBodies(timeStep);
}

void DynamicsWorld::updateActivationState(btScalar timeStep) {
    for (int i = 0; i < m_nonStaticRigidBodies.size(); ++i) {
        btRigidBody& body = *m_nonStaticRigidBodies[i];
        const int state = body.getActivationState();
        if (state == DISABLE_DEACTIVATION || state == DISABLE_SIMULATION) continue;
        if (state == ISLAND_SLEEPING) {
            body.setLinearVelocity(btVector3(0, 0, 0));
            body.setAngularVelocity(btVector3(0, 0, 0));
            continue;
        }
        const bool slow = body.getLinearVelocity().length2() < tuning_.sleepSpeed * tuning_.sleepSpeed &&
                          body.getAngularVelocity().length2() < tuning_.sleepTurn * tuning_.sleepTurn;
        body.setDeactivationTime(slow ? body.getDeactivationTime() + timeStep : 0.0F);
        body.setActivationState(body.getDeactivationTime() > tuning_.sleepSeconds ? WANTS_DEACTIVATION : ACTIVE_TAG);
    }
}

BulletParts::BulletParts(const WorldSettings& settings, const BulletTuning& tuning)
    : configuration(std::make_unique<btDefaultCollisionConfiguration>()),
      dispatcher(std::make_unique<btCollisionDispatcher>(configuration.get())),
      broadphase(std::make_unique<btDbvtBroadphase>()) {
    if (settings.solver == SolverKind::stock) {
        solver = std::make_unique<btSequentialImpulseConstraintSolver>();
        world = std::make_unique<btDiscreteDynamicsWorld>(dispatcher.get(), broadphase.get(), solver.get(),
                                                          configuration.get());
    } else {
        analytic = std::make_unique<AnalyticCollisionFactory>(tuning.contactMargin);
        analytic->registerWith(*dispatcher);
        solver = std::make_unique<btSequentialImpulseConstraintSolver>();
        world = std::make_unique<DynamicsWorld>(dispatcher.get(), broadphase.get(), solver.get(), configuration.get(),
                                                tuning);
        pairFilter = std::make_unique<PairFilter>();
        broadphase->getOverlappingPairCache()->setOverlapFilterCallback(pairFilter.get());
    }
    world->setGravity(toBullet(settings.gravity));
}

}  // namespace lutka::physics
