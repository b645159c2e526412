#include "physics/bullet/bullet_world.hpp"

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <map>

#include "core/assert.hpp"
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

    int addStatic(const StaticShape& shape) override;
    void removeStatic(int index) override;
    void removeProp(int prop) override;
    void removeDoll(int doll) override;
    int addProp(const DynamicProp& prop) override;
    int addDoll(const RagdollProfile& profile, std::span<const BodyState> bodies) override;
    void step(float dt, const std::function<void()>& afterSubstep) override;
    [[nodiscard]] int substepsPerStep() const override { return isStock() ? 1 : tuning_.substeps; }
    void setSubsteps(int substeps) override { tuning_.substeps = substeps; }

    [[nodiscard]] int dollCount() const override { return static_cast<int>(dolls_.size()); }
    [[nodiscard]] const RagdollProfile& profileOf(int doll) const override { return dolls_[doll]->profile(); }
    [[nodiscard]] vec3 inertiaOf(int doll, int body) const override {
        const RagdollProfile& profile = profileOf(doll);
        return conditionedInertia(profile, profile.bodies[body], isStock() ? 0.0F : tuning_.leastGyration);
    }
    void getBodies(int doll, std::span<BodyState> bodies) const override;
    void setBodies(int doll, std::span<const BodyState> bodies) override { dolls_[doll]->setBodies(bodies); }
    [[nodiscard]] bool isAsleep(int doll) const override { return dolls_[doll]->isAsleep(); }
    void wake(int doll) override { dolls_[doll]->wake(); }
    [[nodiscard]] DollState dollState(int doll) const override { return dolls_[doll]->state(); }
    void setDollState(int doll, const DollState& state) override {
        dolls_[doll]->setState(state, settings_.sleeping);
        listMotors();
    }
    [[nodiscard]] int propCount() const override { return static_cast<int>(props_.size()); }
    [[nodiscard]] const DynamicProp& propOf(int prop) const override { return propSettings_[prop]; }
    [[nodiscard]] BodyState propState(int prop) const override { return stateOf(*props_[prop].body); }
    void applyImpulse(int doll, int body, const vec3& impulse, const vec3& worldPoint) override;
    void applyForce(int doll, int body, const vec3& force, const vec3& worldPoint) override;
    void setMotor(int doll, int constraint, const std::optional<JointMotor>& motor) override;
    [[nodiscard]] double motorWork() const override { return motorWork_; }
    [[nodiscard]] std::optional<RayHit> rayTest(const vec3& from, const vec3& to, std::uint32_t layers) const override;
    void setDollFilter(int doll, const CollisionFilter& filter) override;
    [[nodiscard]] CollisionFilter dollFilter(int doll) const override { return dolls_[doll]->filter(); }
    void setPropFilter(int prop, const CollisionFilter& filter) override;
    void setDrag(int id, const Drag& drag) override;
    void removeDrag(int id) override;
    [[nodiscard]] double dragWork() const override { return dragWork_; }
    [[nodiscard]] std::vector<std::pair<int, Drag>> dragsOf(int doll) const override;
    [[nodiscard]] StepTimes stepTimes() const override { return parts_.world->times(stepMs_); }
    void getContacts(std::vector<ContactPoint>& contacts) const override;
    [[nodiscard]] std::span<const ContactReport> contactReports() const override { return gatherer_.reports(); }
    void drawDebug(const DebugLineSink& line) override { drawBulletDebug(*parts_.world, line); }

  private:
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
    std::map<int, std::unique_ptr<DragConstraint>> drags_;
    double dragWork_ = 0.0;
    std::vector<MotorConstraint*> motors_;  // of all dolls
    std::vector<Force> forces_;
    double motorWork_ = 0.0;
    std::vector<vec3> speedsBefore_, speedsAfter_;  // of what drags, motors and forces act on
    ContactGatherer gatherer_;
    double stepMs_ = 0.0;  // of the last step's substeps
};

BulletWorld::~BulletWorld() {
    for (const auto& [id, drag] : drags_)
        parts_.world->removeConstraint(drag.get());
    dolls_.clear();
    for (const BodyInWorld& prop : props_)
        parts_.world->removeRigidBody(prop.body.get());
    for (const BodyInWorld& fixed : statics_)
        parts_.world->removeRigidBody(fixed.body.get());
}

int BulletWorld::addStatic(const StaticShape& shape) {
    BodyInWorld made = makeStaticShape(shape);
    const btRigidBody::btRigidBodyConstructionInfo info(0.0F, nullptr, made.shape.get());
    made.body = std::make_unique<btRigidBody>(info);
    made.body->setUserIndex(kStaticUser);
    made.body->setUserIndex2(static_cast<int>(statics_.size()));
    made.body->setWorldTransform(toBullet(shape.worldFromShape));
    made.body->setFriction(shape.friction);
    parts_.world->addRigidBody(made.body.get(), static_cast<int>(shape.filter.layers),
                               static_cast<int>(shape.filter.mask));
    statics_.push_back(std::move(made));
    for (const auto& doll : dolls_)
        doll->wake();
    for (const BodyInWorld& prop : props_)
        prop.body->activate(true);
    return static_cast<int>(statics_.size()) - 1;
}

void BulletWorld::wakeTouching(const btCollisionObject& object) {
    for (int i = 0; i < parts_.dispatcher->getNumManifolds(); ++i) {
        const btPersistentManifold& manifold = *parts_.dispatcher->getManifoldByIndexInternal(i);
        if (manifold.getBody0() == &object) manifold.getBody1()->activate(true);
        if (manifold.getBody1() == &object) manifold.getBody0()->activate(true);
    }
}

void BulletWorld::removeStatic(int index) {
    wakeTouching(*statics_[index].body);
    parts_.world->removeRigidBody(statics_[index].body.get());
    statics_.erase(statics_.begin() + index);
    for (std::size_t i = index; i < statics_.size(); ++i)
        statics_[i].body->setUserIndex2(static_cast<int>(i));
    gatherer_.clear();
}

void BulletWorld::removeProp(int prop) {
    wakeTouching(*props_[prop].body);
    parts_.world->removeRigidBody(props_[prop].body.get());
    props_.erase(props_.begin() + prop);
    propSettings_.erase(propSettings_.begin() + prop);
    for (std::size_t i = prop; i < props_.size(); ++i)
        props_[i].body->setUserIndex2(static_cast<int>(i));
    gatherer_.clear();
}

void BulletWorld::removeDoll(int doll) {
    for (const auto& [id, drag] : dragsOf(doll))
        removeDrag(id);
    for (int i = 0; i < dolls_[doll]->bodyCount(); ++i) {
        wakeTouching(dolls_[doll]->body(i));
        std::erase_if(forces_, [&](const Force& force) { return force.body == &dolls_[doll]->body(i); });
    }
    dolls_.erase(dolls_.begin() + doll);
    for (int i = doll; i < dollCount(); ++i)
        dolls_[i]->setIndex(i);
    for (const auto& [id, drag] : drags_) {
        Drag moved = drag->drag();
        if (moved.doll > doll) --moved.doll;
        drag->setTarget(moved);
    }
    listMotors();
    gatherer_.clear();
}

int BulletWorld::addProp(const DynamicProp& prop) {
    props_.push_back(makeBody(prop.shape, prop.massKg, shapeInertia(prop.shape, prop.massKg), prop.state));
    propSettings_.push_back(prop);
    btRigidBody& body = *props_.back().body;
    body.setUserIndex(kPropUser);
    body.setUserIndex2(propCount() - 1);
    if (!settings_.sleeping) body.setActivationState(DISABLE_DEACTIVATION);
    if (!isStock()) body.setDamping(tuning_.linearDamping, tuning_.angularDamping);
    parts_.world->addRigidBody(&body, static_cast<int>(prop.filter.layers), static_cast<int>(prop.filter.mask));
    return propCount() - 1;
}

int BulletWorld::addDoll(const RagdollProfile& profile, std::span<const BodyState> bodies) {
    dolls_.push_back(std::make_unique<Ragdoll>(*parts_.world, dollCount(), profile, bodies, tuning_, jointTuning_,
                                               isStock(), settings_.sleeping));
    return dollCount() - 1;
}

// The speeds that drags, motors and forces work along.
void BulletWorld::measureSpeeds(std::vector<vec3>& speeds) const {
    speeds.clear();
    for (const auto& [id, drag] : drags_)
        speeds.push_back(drag->pointVelocity());
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
        return static_cast<double>(glm::dot(impulse, mean));
    };
    for (const auto& [id, drag] : drags_)
        dragWork_ += work(drag->force() * dt);
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

void BulletWorld::step(float dt, const std::function<void()>& afterSubstep) {
    LUTKA_ASSERT(dt > 0.0F);
    using Clock = std::chrono::steady_clock;
    const int substeps = substepsPerStep();
    gatherer_.clear();
    parts_.world->clearTimes();
    stepMs_ = 0.0;
    for (int i = 0; i < substeps; ++i) {
        const auto start = Clock::now();
        substep(dt / static_cast<float>(substeps));
        stepMs_ += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        if (afterSubstep) afterSubstep();
    }
    forces_.clear();
}

void BulletWorld::getBodies(int doll, std::span<BodyState> bodies) const {
    LUTKA_ASSERT(static_cast<int>(bodies.size()) == dolls_[doll]->bodyCount());
    for (std::size_t i = 0; i < bodies.size(); ++i)
        bodies[i] = stateOf(dolls_[doll]->body(static_cast<int>(i)));
}

void BulletWorld::applyImpulse(int doll, int body, const vec3& impulse, const vec3& worldPoint) {
    dolls_[doll]->wake();
    btRigidBody& target = dolls_[doll]->body(body);
    target.applyImpulse(toBullet(impulse), toBullet(worldPoint) - target.getWorldTransform().getOrigin());
}

void BulletWorld::applyForce(int doll, int body, const vec3& force, const vec3& worldPoint) {
    dolls_[doll]->wake();
    btRigidBody& target = dolls_[doll]->body(body);
    forces_.push_back({&target, toBullet(force), target.getWorldTransform().invXform(toBullet(worldPoint))});
}

void BulletWorld::setMotor(int doll, int constraint, const std::optional<JointMotor>& motor) {
    dolls_[doll]->wake();
    dolls_[doll]->setMotor(constraint, motor);
    listMotors();
}

void BulletWorld::listMotors() {
    motors_.clear();
    for (const auto& doll : dolls_) {
        for (const auto& motor : doll->motors())
            if (motor != nullptr) motors_.push_back(motor.get());
    }
}

std::vector<std::pair<int, Drag>> BulletWorld::dragsOf(int doll) const {
    std::vector<std::pair<int, Drag>> found;
    for (const auto& [id, drag] : drags_)
        if (drag->drag().doll == doll) found.emplace_back(id, drag->drag());
    return found;
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

std::optional<RayHit> BulletWorld::rayTest(const vec3& from, const vec3& to, std::uint32_t layers) const {
    // The last step's boxes are those of before its motion.
    if (auto* ours = dynamic_cast<DynamicsWorld*>(parts_.world.get()))
        ours->refreshAabbs();
    else
        parts_.world->updateAabbs();
    LayeredRay callback(from, to, layers);
    parts_.world->rayTest(toBullet(from), toBullet(to), callback);
    if (!callback.hasHit()) return std::nullopt;
    RayHit hit;
    hit.doll = std::max(callback.m_collisionObject->getUserIndex(), -1);
    hit.body = hit.doll >= 0 ? callback.m_collisionObject->getUserIndex2() : -1;
    hit.position = fromBullet(callback.m_hitPointWorld);
    hit.normal = glm::normalize(fromBullet(callback.m_hitNormalWorld));
    hit.fraction = callback.m_closestHitFraction;
    return hit;
}

void BulletWorld::setDollFilter(int doll, const CollisionFilter& filter) {
    dolls_[doll]->wake();
    dolls_[doll]->setFilter(filter);
}

void BulletWorld::setPropFilter(int prop, const CollisionFilter& filter) {
    propSettings_[prop].filter = filter;
    setFilter(*parts_.world, *props_[prop].body, filter);
    props_[prop].body->activate(true);
}

void BulletWorld::setDrag(int id, const Drag& drag) {
    LUTKA_ASSERT(drag.doll >= 0 && drag.doll < dollCount());
    dolls_[drag.doll]->wake();
    const auto known = drags_.find(id);
    if (known != drags_.end() && known->second->drag().doll == drag.doll && known->second->drag().body == drag.body) {
        known->second->setTarget(drag);
        return;
    }
    removeDrag(id);
    auto made = std::make_unique<DragConstraint>(dolls_[drag.doll]->body(drag.body), drag);
    parts_.world->addConstraint(made.get());
    drags_.emplace(id, std::move(made));
}

void BulletWorld::removeDrag(int id) {
    const auto known = drags_.find(id);
    if (known == drags_.end()) return;
    dolls_[known->second->drag().doll]->wake();
    parts_.world->removeConstraint(known->second.get());
    drags_.erase(known);
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
