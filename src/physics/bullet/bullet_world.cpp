#include "physics/bullet/bullet_world.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>

#include "physics/bullet/contact_gatherer.hpp"
#include "physics/bullet/convert.hpp"
#include "physics/bullet/debug_draw.hpp"
#include "physics/bullet/drag_constraint.hpp"
#include "physics/bullet/dynamics_world.hpp"
#include "physics/bullet/ragdoll.hpp"
#include "physics/bullet/static_shape.hpp"
#include "physics/collision/shape.hpp"

namespace lutka::physics {
namespace {

class BulletWorld final : public World {
  public:
    BulletWorld(const WorldSettings& settings, const BulletTuning& tuning)
        : settings_(settings), tuning_(tuning), parts_(settings, tuning) {
        jointTuning_.erp = tuning.jointErp;
        jointTuning_.limitErp = tuning.limitErp;
    }
    ~BulletWorld() override;

    [[nodiscard]] int substepsPerStep() const override { return isStock() ? 1 : tuning_.substeps; }
    [[nodiscard]] double dragWork() const override { return dragWork_; }
    [[nodiscard]] double dragImpulse() const override { return dragImpulse_; }
    [[nodiscard]] double motorWork() const override { return motorWork_; }
    void getContacts(std::vector<ContactPoint>& contacts) const override;
    [[nodiscard]] std::span<const ContactReport> contactReports() const override { return gatherer_.reports(); }
    [[nodiscard]] StepTimes stepTimes() const override { return parts_.world->times(stepMs_); }
    void drawDebug(const DebugLineSink& line) const override { drawBulletDebug(*parts_.world, line); }

  private:
    [[nodiscard]] const RagdollProfile& profileAt(int doll) const override { return dolls_[doll]->profile(); }
    [[nodiscard]] vec3 inertiaAt(int doll, int body) const override {
        const RagdollProfile& profile = profileAt(doll);
        return conditionedInertia(profile, profile.bodies[body], isStock() ? 0.0F : tuning_.leastGyration);
    }
    void getBodiesAt(int doll, std::span<BodyState> bodies) const override;
    [[nodiscard]] bool isAsleepAt(int doll) const override { return dolls_[doll]->isAsleep(); }
    [[nodiscard]] const DynamicProp& propAt(int prop) const override { return propSettings_[prop]; }
    [[nodiscard]] BodyState propStateAt(int prop) const override { return stateOf(*props_[prop].body); }
    [[nodiscard]] std::optional<RayHit> castRay(const vec3& from, const vec3& to, std::uint32_t layers) const override;

    void addStaticAs(StaticId id, const StaticShape& shape) override;
    void addPropAs(PropId id, const DynamicProp& prop) override;
    void addDollAs(DollId id, const RagdollProfile& profile, std::span<const BodyState> bodies) override;
    void removeStaticAt(int fixed) override;
    void removePropAt(int prop) override;
    void removeDollAt(int doll) override;
    void advance(float dt, const std::function<void()>& afterSubstep) override;
    void useSubsteps(int substeps) override { tuning_.substeps = substeps; }
    void setBodiesAt(int doll, std::span<const BodyState> bodies) override { dolls_[doll]->setBodies(bodies); }
    void wakeAt(int doll) override { dolls_[doll]->wake(); }
    [[nodiscard]] DollState dollStateAt(int doll) const override { return dolls_[doll]->state(); }
    void setDollStateAt(int doll, const DollState& state) override {
        dolls_[doll]->setState(state, settings_.sleeping);
        listMotors();
    }
    void applyImpulseAt(int doll, int body, const vec3& impulse, const vec3& worldPoint) override;
    void applyForceAt(int doll, int body, const vec3& force, const vec3& worldPoint) override;
    void setMotorAt(int doll, int constraint, const std::optional<JointMotor>& motor) override;
    void setBodyTargetAt(int doll, int body, const std::optional<BodyTarget>& target) override;
    void setDollFilterAt(int doll, const CollisionFilter& filter) override;
    [[nodiscard]] CollisionFilter dollFilterAt(int doll) const override { return dolls_[doll]->filter(); }
    void setPropFilterAt(int prop, const CollisionFilter& filter) override;
    void addDragTo(int doll, const Drag& drag) override;
    void setDragAt(int place, int doll, const Drag& drag) override;
    void removeDragAt(int place) override;

    // A drag on a doll's body.
    struct PulledBody {
        Ragdoll* doll;
        std::unique_ptr<DragConstraint> constraint;
    };
    // A force that acts throughout the coming step.
    struct Force {
        btRigidBody* body;
        btVector3 force;
        btVector3 point;  // body space

        [[nodiscard]] btVector3 arm() const { return body->getWorldTransform().getBasis() * point; }
    };
    [[nodiscard]] bool isStock() const { return settings_.solver == SolverKind::stock; }
    void substep(float dt);
    void measureSpeeds(std::vector<vec3>& speeds) const;
    void addWork(float dt);
    void listMotors();
    void wakeTouching(const btCollisionObject& object);

    WorldSettings settings_;
    BulletTuning tuning_;
    JointTuning jointTuning_;
    BulletParts parts_;
    std::vector<BodyInWorld> statics_;
    std::vector<BodyInWorld> props_;
    std::vector<DynamicProp> propSettings_;
    std::vector<std::unique_ptr<Ragdoll>> dolls_;
    std::vector<PulledBody> drags_;
    double dragWork_ = 0.0;
    double dragImpulse_ = 0.0;              // N s
    std::vector<MotorConstraint*> motors_;  // of all dolls
    std::vector<Force> forces_;
    double motorWork_ = 0.0;
    std::vector<vec3> speedsBefore_, speedsAfter_;  // of what drags, motors and forces act on
    ContactGatherer gatherer_;
    double stepMs_ = 0.0;  // of the last step's substeps
};

BulletWorld::~BulletWorld() {
    for (const PulledBody& drag : drags_)
        parts_.world->removeConstraint(drag.constraint.get());
    dolls_.clear();
    for (const BodyInWorld& prop : props_)
        parts_.world->removeRigidBody(prop.body.get());
    for (const BodyInWorld& fixed : statics_)
        parts_.world->removeRigidBody(fixed.body.get());
}

void BulletWorld::addStaticAs(StaticId id, const StaticShape& shape) {
    BodyInWorld made = makeStaticShape(shape);
    const btRigidBody::btRigidBodyConstructionInfo info(0.0F, nullptr, made.shape.get());
    made.body = std::make_unique<btRigidBody>(info);
    name(*made.body, id);
    made.body->setWorldTransform(toBullet(shape.worldFromShape));
    made.body->setFriction(shape.friction);
    parts_.world->addRigidBody(made.body.get(), static_cast<int>(shape.filter.layers),
                               static_cast<int>(shape.filter.mask));
    statics_.push_back(std::move(made));
    for (const auto& doll : dolls_)
        doll->wake();
    for (const BodyInWorld& prop : props_)
        prop.body->activate(true);
}

void BulletWorld::wakeTouching(const btCollisionObject& object) {
    for (int i = 0; i < parts_.dispatcher->getNumManifolds(); ++i) {
        const btPersistentManifold& manifold = *parts_.dispatcher->getManifoldByIndexInternal(i);
        if (manifold.getBody0() == &object) manifold.getBody1()->activate(true);
        if (manifold.getBody1() == &object) manifold.getBody0()->activate(true);
    }
}

void BulletWorld::removeStaticAt(int fixed) {
    wakeTouching(*statics_[fixed].body);
    parts_.world->removeRigidBody(statics_[fixed].body.get());
    statics_.erase(statics_.begin() + fixed);
    gatherer_.clear();
}

void BulletWorld::removePropAt(int prop) {
    wakeTouching(*props_[prop].body);
    parts_.world->removeRigidBody(props_[prop].body.get());
    props_.erase(props_.begin() + prop);
    propSettings_.erase(propSettings_.begin() + prop);
    gatherer_.clear();
}

void BulletWorld::removeDollAt(int doll) {
    for (int i = 0; i < dolls_[doll]->bodyCount(); ++i) {
        wakeTouching(dolls_[doll]->body(i));
        std::erase_if(forces_, [&](const Force& force) { return force.body == &dolls_[doll]->body(i); });
    }
    dolls_.erase(dolls_.begin() + doll);
    listMotors();
    gatherer_.clear();
}

void BulletWorld::addPropAs(PropId id, const DynamicProp& prop) {
    props_.push_back(makeBody(prop.shape, prop.massKg, shapeInertia(prop.shape, prop.massKg), prop.state));
    propSettings_.push_back(prop);
    btRigidBody& body = *props_.back().body;
    name(body, id);
    if (!settings_.sleeping) body.setActivationState(DISABLE_DEACTIVATION);
    if (!isStock()) body.setDamping(tuning_.linearDamping, tuning_.angularDamping);
    parts_.world->addRigidBody(&body, static_cast<int>(prop.filter.layers), static_cast<int>(prop.filter.mask));
}

void BulletWorld::addDollAs(DollId id, const RagdollProfile& profile, std::span<const BodyState> bodies) {
    dolls_.push_back(std::make_unique<Ragdoll>(*parts_.world, id, profile, bodies, tuning_, jointTuning_, isStock(),
                                               settings_.sleeping));
}

// The speeds that drags, motors and forces work along.
void BulletWorld::measureSpeeds(std::vector<vec3>& speeds) const {
    speeds.clear();
    for (const PulledBody& drag : drags_)
        speeds.push_back(drag.constraint->pointVelocity());
    for (const MotorConstraint* motor : motors_)
        speeds.push_back(motor->relativeTurn());
    for (const Force& force : forces_)
        speeds.push_back(fromBullet(force.body->getVelocityInLocalPoint(force.arm())));
}

void BulletWorld::addWork(float dt) {
    std::size_t index = 0;
    const auto work = [&](const vec3& impulse) {
        const vec3 mean = 0.5F * (speedsBefore_[index] + speedsAfter_[index]);
        ++index;
        // A doll that is about to be put back (World::caught) must not spoil the sum for good.
        const auto done = static_cast<double>(glm::dot(impulse, mean));
        return std::isfinite(done) ? done : 0.0;
    };
    vec3 onBody(0);  // what its pulls have given it together: those of a body come one after the other
    for (std::size_t i = 0; i < drags_.size(); ++i) {
        const vec3 impulse = drags_[i].constraint->force() * dt;
        dragWork_ += work(impulse);
        onBody += impulse;
        if (i + 1 < drags_.size() && drags_[i + 1].doll == drags_[i].doll &&
            drags_[i + 1].constraint->drag().body == drags_[i].constraint->drag().body)
            continue;
        const auto given = static_cast<double>(glm::length(onBody));
        if (std::isfinite(given)) dragImpulse_ += given;
        onBody = vec3(0);
    }
    for (const auto& doll : dolls_)
        if (doll->led().any()) dragWork_ += doll->led().work();
    for (const MotorConstraint* motor : motors_)
        motorWork_ += work(motor->impulse());
    for (const Force& force : forces_)
        motorWork_ += work(fromBullet(force.force) * dt);
}

void BulletWorld::substep(float dt) {
    measureSpeeds(speedsBefore_);
    for (const Force& force : forces_)
        force.body->applyForce(force.force, force.arm());
    if (isStock()) {
        for (MotorConstraint* motor : motors_)
            motor->applyAsTorque(dt);
        parts_.world->stepSimulation(dt, 1, dt);
    } else {
        parts_.world->stepSimulation(dt, 0);
    }
    measureSpeeds(speedsAfter_);
    addWork(dt);
    if (settings_.contactReports) gatherer_.gather(*parts_.dispatcher);
}

void BulletWorld::advance(float dt, const std::function<void()>& afterSubstep) {
    using Clock = std::chrono::steady_clock;
    const int substeps = substepsPerStep();
    gatherer_.clear();
    parts_.world->clearTimes();
    for (const auto& doll : dolls_)
        if (doll->led().any()) doll->wake();
    stepMs_ = 0.0;
    for (int i = 0; i < substeps; ++i) {
        const auto start = Clock::now();
        const float remaining = dt * static_cast<float>(substeps - i) / static_cast<float>(substeps);
        for (MotorConstraint* motor : motors_)
            motor->setRemaining(remaining);
        for (const PulledBody& drag : drags_)
            drag.constraint->setRemaining(remaining);
        for (const auto& doll : dolls_)
            if (doll->led().any()) doll->led().lead(dt / static_cast<float>(substeps), remaining);
        substep(dt / static_cast<float>(substeps));
        stepMs_ += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        if (afterSubstep) afterSubstep();
    }
    forces_.clear();
}

void BulletWorld::getBodiesAt(int doll, std::span<BodyState> bodies) const {
    for (std::size_t i = 0; i < bodies.size(); ++i)
        bodies[i] = stateOf(dolls_[doll]->body(static_cast<int>(i)));
}

void BulletWorld::applyImpulseAt(int doll, int body, const vec3& impulse, const vec3& worldPoint) {
    dolls_[doll]->wake();
    btRigidBody& target = dolls_[doll]->body(body);
    target.applyImpulse(toBullet(impulse), toBullet(worldPoint) - target.getWorldTransform().getOrigin());
}

void BulletWorld::applyForceAt(int doll, int body, const vec3& force, const vec3& worldPoint) {
    dolls_[doll]->wake();
    btRigidBody& target = dolls_[doll]->body(body);
    forces_.push_back({&target, toBullet(force), target.getWorldTransform().invXform(toBullet(worldPoint))});
}

void BulletWorld::setMotorAt(int doll, int constraint, const std::optional<JointMotor>& motor) {
    dolls_[doll]->wake();
    dolls_[doll]->setMotor(constraint, motor);
    listMotors();
}

void BulletWorld::setBodyTargetAt(int doll, int body, const std::optional<BodyTarget>& target) {
    if (isStock()) {
        refuse("setBodyTarget", "Bullet's own solver leads no bodies");
        return;
    }
    dolls_[doll]->wake();
    dolls_[doll]->setTarget(body, target);
}

void BulletWorld::listMotors() {
    motors_.clear();
    for (const auto& doll : dolls_) {
        for (const auto& motor : doll->motors())
            if (motor != nullptr) motors_.push_back(motor.get());
    }
}

// Bullet's own test wants the ray in the body's mask as well; a ray has no layer.
struct LayeredRay final : btCollisionWorld::ClosestRayResultCallback {
    LayeredRay(const vec3& from, const vec3& to, std::uint32_t wanted)
        : ClosestRayResultCallback(toBullet(from), toBullet(to)), layers(wanted) {}
    bool needsCollision(btBroadphaseProxy* proxy) const override {
        return (static_cast<std::uint32_t>(proxy->m_collisionFilterGroup) & layers) != 0;
    }
    // Bullet turns the normal of a back towards the ray, and its own filter of backs takes planes for backs as well.
    btScalar addSingleResult(btCollisionWorld::LocalRayResult& result, bool normalInWorld) override {
        const btCollisionObject& object = *result.m_collisionObject;
        if (object.getCollisionShape()->getShapeType() == TRIANGLE_MESH_SHAPE_PROXYTYPE) {
            const auto* mesh = static_cast<const TriangleMesh*>(object.getCollisionShape()->getUserPointer());
            const vec3 normal = mesh->normals()[result.m_localShapeInfo->m_triangleIndex];
            const btVector3 along = object.getWorldTransform().getBasis().transpose() * (m_rayToWorld - m_rayFromWorld);
            if (glm::dot(normal, fromBullet(along)) >= 0.0F) return m_closestHitFraction;
        }
        return ClosestRayResultCallback::addSingleResult(result, normalInWorld);
    }
    std::uint32_t layers;
};

std::optional<RayHit> BulletWorld::castRay(const vec3& from, const vec3& to, std::uint32_t layers) const {
    // The last step's boxes are those of before its motion.
    if (auto* ours = dynamic_cast<DynamicsWorld*>(parts_.world.get()))
        ours->refreshAabbs();
    else
        parts_.world->updateAabbs();
    LayeredRay callback(from, to, layers);
    parts_.world->rayTest(toBullet(from), toBullet(to), callback);
    if (!callback.hasHit()) return std::nullopt;
    RayHit hit;
    const ContactReport::Side side = sideOf(*callback.m_collisionObject);
    hit.doll = side.doll;
    hit.body = hit.doll.isSet() ? side.body : -1;
    hit.position = fromBullet(callback.m_hitPointWorld);
    hit.normal = glm::normalize(fromBullet(callback.m_hitNormalWorld));
    hit.fraction = callback.m_closestHitFraction;
    return hit;
}

void BulletWorld::setDollFilterAt(int doll, const CollisionFilter& filter) {
    dolls_[doll]->wake();
    dolls_[doll]->setFilter(filter);
}

void BulletWorld::setPropFilterAt(int prop, const CollisionFilter& filter) {
    propSettings_[prop].filter = filter;
    setFilter(*parts_.world, *props_[prop].body, filter);
    props_[prop].body->activate(true);
}

void BulletWorld::addDragTo(int doll, const Drag& drag) {
    dolls_[doll]->wake();
    drags_.push_back({dolls_[doll].get(), std::make_unique<DragConstraint>(dolls_[doll]->body(drag.body), drag)});
    parts_.world->addConstraint(drags_.back().constraint.get());
}

void BulletWorld::setDragAt(int place, int doll, const Drag& drag) {
    PulledBody& known = drags_[place];
    dolls_[doll]->wake();
    if (known.doll == dolls_[doll].get() && known.constraint->drag().body == drag.body) {
        known.constraint->setTarget(drag);
        return;
    }
    known.doll->wake();
    parts_.world->removeConstraint(known.constraint.get());
    known = {dolls_[doll].get(), std::make_unique<DragConstraint>(dolls_[doll]->body(drag.body), drag)};
    parts_.world->addConstraint(known.constraint.get());
}

void BulletWorld::removeDragAt(int place) {
    drags_[place].doll->wake();
    parts_.world->removeConstraint(drags_[place].constraint.get());
    drags_.erase(drags_.begin() + place);
}

void BulletWorld::getContacts(std::vector<ContactPoint>& contacts) const {
    for (int i = 0; i < parts_.dispatcher->getNumManifolds(); ++i) {
        const btPersistentManifold& manifold = *parts_.dispatcher->getManifoldByIndexInternal(i);
        for (int k = 0; k < manifold.getNumContacts(); ++k) {
            const btManifoldPoint& point = manifold.getContactPoint(k);
            if (point.getDistance() > 0.005F) continue;  // only foreseen, not yet touching
            contacts.push_back(
                {fromBullet(point.getPositionWorldOnB()), fromBullet(point.m_normalWorldOnB), point.getDistance()});
        }
    }
}

}  // namespace

std::unique_ptr<World> createBulletWorld(const WorldSettings& settings, const BulletTuning& tuning) {
    BulletTuning tuned = tuning;
    tuned.substeps = settings.substeps.value_or(tuning.substeps);
    tuned.sweeps = settings.iterations.value_or(tuning.sweeps);
    tuned.leastSweeps = std::min(tuning.leastSweeps, tuned.sweeps);
    tuned.linearDamping = settings.linearDamping.value_or(tuning.linearDamping);
    tuned.angularDamping = settings.angularDamping.value_or(tuning.angularDamping);
    return std::make_unique<BulletWorld>(settings, tuned);
}

}  // namespace lutka::physics
