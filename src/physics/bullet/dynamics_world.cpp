#include "physics/bullet/dynamics_world.hpp"

#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>

#include <algorithm>
#include <vector>

#include "physics/bullet/contact_gatherer.hpp"
#include "physics/bullet/convert.hpp"
#include "physics/bullet/ragdoll.hpp"

namespace lutka::physics {
namespace {

bool isKinematicBody(const btCollisionObject& object) {
    const btRigidBody* body = btRigidBody::upcast(&object);
    return body != nullptr && LedBodies::isHeavy(*body);
}

// Pairs that never collide don't even become pairs of the broadphase.
struct PairFilter final : btOverlapFilterCallback {
    bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
        if ((a->m_collisionFilterGroup & b->m_collisionFilterMask) == 0 ||
            (b->m_collisionFilterGroup & a->m_collisionFilterMask) == 0)
            return false;
        const auto* first = static_cast<const btCollisionObject*>(a->m_clientObject);
        const auto* second = static_cast<const btCollisionObject*>(b->m_clientObject);
        // What follows its target exactly is stopped by nothing.
        const bool isFirstFixed = first->isStaticObject() || isKinematicBody(*first);
        if (isFirstFixed && (second->isStaticObject() || isKinematicBody(*second))) return false;
        const auto* doll = static_cast<const Ragdoll*>(first->getUserPointer());
        if (doll == nullptr || doll != second->getUserPointer()) return true;
        return doll->mayCollide(sideOf(*first).body, sideOf(*second).body);
    }
};

template <class T>
std::span<T* const> spanOf(const btAlignedObjectArray<T*>& array) {
    return array.size() > 0 ? std::span<T* const>(&array[0], array.size()) : std::span<T* const>();
}

}  // namespace

// As btCollisionWorld has it, with a clock.
void MeasuredWorld::performDiscreteCollisionDetection() {
    const auto start = Clock::now();
    updateAabbs();
    computeOverlappingPairs();
    const auto paired = Clock::now();
    getDispatcher()->dispatchAllCollisionPairs(getBroadphase()->getOverlappingPairCache(), getDispatchInfo(),
                                               getDispatcher());
    addTimes(paired - start, Clock::now() - paired);
}

void MeasuredWorld::addTimes(Clock::duration broadphase, Clock::duration narrowphase) {
    times_.broadphaseMs += std::chrono::duration<double, std::milli>(broadphase).count();
    times_.narrowphaseMs += std::chrono::duration<double, std::milli>(narrowphase).count();
}

StepTimes MeasuredWorld::times(double stepMs) const {
    StepTimes times = times_;
    times.solverMs = std::max(stepMs - times.broadphaseMs - times.narrowphaseMs, 0.0);
    times.islands = countIslands();
    return times;
}

int MeasuredWorld::countIslands() const {
    std::vector<int> tags;
    for (int i = 0; i < m_nonStaticRigidBodies.size(); ++i) {
        if (m_nonStaticRigidBodies[i]->isActive()) tags.push_back(m_nonStaticRigidBodies[i]->getIslandTag());
    }
    std::sort(tags.begin(), tags.end());
    return static_cast<int>(std::unique(tags.begin(), tags.end()) - tags.begin());
}

DynamicsWorld::DynamicsWorld(btCollisionDispatcher* dispatcher, btBroadphaseInterface* broadphase,
                             btConstraintSolver* solver, btCollisionConfiguration* configuration,
                             const BulletTuning& tuning, GeometryCache& geometries, AnalyticCollisionFactory& analytic)
    : MeasuredWorld(dispatcher, broadphase, solver, configuration),
      tuning_(tuning),
      geometries_(geometries),
      analytic_(analytic),
      ownDispatcher_(*dispatcher),
      solver_(tuning) {}

void DynamicsWorld::listAwake() {
    awake_.clear();
    for (int i = 0; i < m_nonStaticRigidBodies.size(); ++i) {
        btRigidBody* body = m_nonStaticRigidBodies[i];
        if (body->isActive() && !body->isStaticOrKinematicObject()) awake_.push_back(body);
    }
}

int DynamicsWorld::stepSimulation(btScalar seconds, int /*maxSubSteps*/, btScalar /*fixedTimeStep*/) {
    listAwake();
    if (awake_.empty()) return 0;  // all asleep: nothing can change
    for (btRigidBody* body : awake_)
        body->applyGravity();
    internalSingleStepSimulation(seconds);
    for (btRigidBody* body : awake_)
        body->clearForces();
    return 1;
}

void DynamicsWorld::addCollisionObject(btCollisionObject* object, int group, int mask) {
    geometries_.invalidate();
    btDiscreteDynamicsWorld::addCollisionObject(object, group, mask);
}

void DynamicsWorld::internalSingleStepSimulation(btScalar timeStep) {
    predictUnconstraintMotion(timeStep);
    getDispatchInfo().m_timeStep = timeStep;
    getDispatchInfo().m_stepCount = 0;
    performDiscreteCollisionDetection();
    calculateSimulationIslands();
    getSolverInfo().m_timeStep = timeStep;
    solveConstraints(getSolverInfo());
    updateActions(timeStep);
    updateActivationState(timeStep);
}

void DynamicsWorld::predictUnconstraintMotion(btScalar timeStep) {
    for (btRigidBody* body : awake_)
        body->applyDamping(timeStep);
}

void DynamicsWorld::refreshAabbs() {
    listAwake();
    updateAabbs();
}

void DynamicsWorld::updateAabbs() {
    geometries_.refresh(getCollisionObjectArray(), awake_, getDispatchInfo().m_timeStep);
    // A box wider than it must be, and longer where the body goes, stays right for some substeps.
    const btVector3 spare(0.05F, 0.05F, 0.05F);
    const btScalar ahead = 4.0F * getDispatchInfo().m_timeStep;
    for (btRigidBody* body : awake_) {
        btVector3 low;
        btVector3 high;
        body->getCollisionShape()->getAabb(body->getWorldTransform(), low, high);
        const float margin = 0.5F * tuning_.contactMargin + geometries_.aheadOf(*body);
        low -= btVector3(margin, margin, margin);
        high += btVector3(margin, margin, margin);
        const btBroadphaseProxy& proxy = *body->getBroadphaseHandle();
        const btVector3& wideLow = proxy.m_aabbMin;
        const btVector3& wideHigh = proxy.m_aabbMax;
        const bool inside = low.x() >= wideLow.x() && low.y() >= wideLow.y() && low.z() >= wideLow.z() &&
                            high.x() <= wideHigh.x() && high.y() <= wideHigh.y() && high.z() <= wideHigh.z();
        if (inside) continue;
        btVector3 goesLow = ahead * body->getLinearVelocity();
        btVector3 goesHigh = goesLow;
        goesLow.setMin(btVector3(0, 0, 0));
        goesHigh.setMax(btVector3(0, 0, 0));
        m_broadphasePairCache->setAabb(body->getBroadphaseHandle(), low - spare + goesLow, high + spare + goesHigh,
                                       m_dispatcher1);
    }
}

void DynamicsWorld::performDiscreteCollisionDetection() {
    const auto start = Clock::now();
    updateAabbs();
    m_broadphasePairCache->calculateOverlappingPairs(m_dispatcher1);
    const auto paired = Clock::now();
    btBroadphasePairArray& pairs = m_broadphasePairCache->getOverlappingPairCache()->getOverlappingPairArray();
    for (int i = 0; i < pairs.size(); ++i) {
        btBroadphasePair& pair = pairs[i];
        const auto& a = *static_cast<const btCollisionObject*>(pair.m_pProxy0->m_clientObject);
        const auto& b = *static_cast<const btCollisionObject*>(pair.m_pProxy1->m_clientObject);
        if ((!a.isActive() || a.isStaticObject()) && (!b.isActive() || b.isStaticObject())) continue;
        if (analytic_.handles(a, b))
            analytic_.collide(pair, ownDispatcher_);
        else
            ownDispatcher_.getNearCallback()(pair, ownDispatcher_, getDispatchInfo());
    }
    addTimes(paired - start, Clock::now() - paired);
}

void DynamicsWorld::solveConstraints(btContactSolverInfo& info) {
    // Islands decide only what sleeps and what wakes; all that is awake is solved in one go.
    m_islandManager->buildIslands(getDispatcher(), this);
    for (btRigidBody* body : awake_) {
        if (body->isActive()) continue;  // just fell asleep
        body->setLinearVelocity(btVector3(0, 0, 0));
        body->setAngularVelocity(btVector3(0, 0, 0));
        body->clearForces();
    }
    listAwake();
    solver_.solve(awake_, spanOf(m_constraints), *getDispatcher(), info.m_timeStep);
}

void DynamicsWorld::updateActivationState(btScalar timeStep) {
    for (btRigidBody* awake : awake_) {
        btRigidBody& body = *awake;
        if (body.getActivationState() == DISABLE_DEACTIVATION) continue;
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
        world = std::make_unique<MeasuredWorld>(dispatcher.get(), broadphase.get(), solver.get(), configuration.get());
    } else {
        analytic = std::make_unique<AnalyticCollisionFactory>(tuning.contactMargin, geometries);
        analytic->registerWith(*dispatcher);
        solver = std::make_unique<btSequentialImpulseConstraintSolver>();
        world = std::make_unique<DynamicsWorld>(dispatcher.get(), broadphase.get(), solver.get(), configuration.get(),
                                                tuning, geometries, *analytic);
        pairFilter = std::make_unique<PairFilter>();
        broadphase->getOverlappingPairCache()->setOverlapFilterCallback(pairFilter.get());
    }
    world->setGravity(toBullet(settings.gravity));
}

}  // namespace lutka::physics
