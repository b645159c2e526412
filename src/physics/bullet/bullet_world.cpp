#include "physics/bullet/bullet_world.hpp"

#include <glm/geometric.hpp>
#include <map>

#include "core/assert.hpp"
#include "physics/bullet/convert.hpp"
#include "physics/bullet/drag_constraint.hpp"
#include "physics/bullet/dynamics_world.hpp"
#include "physics/bullet/ragdoll.hpp"
#include "physics/shape.hpp"

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

    void addStatic(const StaticShape& shape) override;
    int addProp(const DynamicProp& prop) override;
    int addDoll(const RagdollProfile& profile, std::span<const BodyState> bodies) override;
    void step(float dt, const std::function<void()>& afterSubstep) override;
    [[nodiscard]] int substepsPerStep() const override { return isStock() ? 1 : tuning_.substeps; }

    [[nodiscard]] int dollCount() const override { return static_cast<int>(dolls_.size()); }
    [[nodiscard]] const RagdollProfile& profileOf(int doll) const override { return dolls_[doll]->profile(); }
    [[nodiscard]] vec3 inertiaOf(int doll, int body) const override {
        const RagdollProfile& profile = profileOf(doll);
        return conditionedInertia(profile, profile.bodies[body], isStock() ? 0.0F : tuning_.leastGyration);
    }
    void getBodies(int doll, std::span<BodyState> bodies) const override;
    void setBodies(int doll, std::span<const BodyState> bodies) override { dolls_[doll]->setBodies(bodies); }
    [[nodiscard]] bool isAsleep(int doll) const override { return dolls_[doll]->isAsleep(); }
    [[nodiscard]] int propCount() const override { return static_cast<int>(props_.size()); }
    [[nodiscard]] const DynamicProp& propOf(int prop) const override { return propSettings_[prop]; }
    [[nodiscard]] BodyState propState(int prop) const override { return stateOf(*props_[prop].body); }
    void applyImpulse(int doll, int body, const vec3& impulse, const vec3& worldPoint) override;
    [[nodiscard]] std::optional<RayHit> rayTest(const vec3& from, const vec3& to) const override;
    void setDrag(int id, const Drag& drag) override;
    void removeDrag(int id) override;
    [[nodiscard]] double dragWork() const override { return dragWork_; }
    void getContacts(std::vector<ContactPoint>& contacts) const override;

  private:
    [[nodiscard]] bool isStock() const { return settings_.solver == SolverKind::stock; }
    void substep(float dt);

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

void BulletWorld::addStatic(const StaticShape& shape) {
    BodyInWorld made;
    if (shape.kind == StaticShape::Kind::plane)
        made.shape = std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), 0.0F);
    else
        made.shape = std::make_unique<btBoxShape>(toBullet(shape.halfExtents));
    const btRigidBody::btRigidBodyConstructionInfo info(0.0F, nullptr, made.shape.get());
    made.body = std::make_unique<btRigidBody>(info);
    made.body->setUserIndex(-1);
    made.body->setWorldTransform(toBullet(shape.worldFromShape));
    made.body->setFriction(shape.friction);
    parts_.world->addRigidBody(made.body.get());
    statics_.push_back(std::move(made));
}

int BulletWorld::addProp(const DynamicProp& prop) {
    props_.push_back(makeBody(prop.shape, prop.massKg, shapeInertia(prop.shape, prop.massKg), prop.state));
    propSettings_.push_back(prop);
    btRigidBody& body = *props_.back().body;
    if (!settings_.sleeping) body.setActivationState(DISABLE_DEACTIVATION);
    if (!isStock()) body.setDamping(tuning_.linearDamping, tuning_.angularDamping);
    parts_.world->addRigidBody(&body);
    return propCount() - 1;
}

int BulletWorld::addDoll(const RagdollProfile& profile, std::span<const BodyState> bodies) {
    dolls_.push_back(std::make_unique<Ragdoll>(*parts_.world, dollCount(), profile, bodies, tuning_, jointTuning_,
                                               isStock(), settings_.sleeping));
    return dollCount() - 1;
}

void BulletWorld::substep(float dt) {
    std::vector<vec3> before;
    for (const auto& [id, drag] : drags_)
        before.push_back(drag->pointVelocity());
    if (isStock())
        parts_.world->stepSimulation(dt, 1, dt);
    else
        parts_.world->stepSimulation(dt, 0);
    std::size_t index = 0;
    for (const auto& [id, drag] : drags_) {
        const vec3 mean = 0.5F * (before[index++] + drag->pointVelocity());
        dragWork_ += static_cast<double>(glm::dot(drag->force(), mean)) * static_cast<double>(dt);
    }
}

void BulletWorld::step(float dt, const std::function<void()>& afterSubstep) {
    LUTKA_ASSERT(dt > 0.0F);
    const int substeps = substepsPerStep();
    for (int i = 0; i < substeps; ++i) {
        substep(dt / static_cast<float>(substeps));
        if (afterSubstep) afterSubstep();
    }
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

std::optional<RayHit> BulletWorld::rayTest(const vec3& from, const vec3& to) const {
    btCollisionWorld::ClosestRayResultCallback callback(toBullet(from), toBullet(to));
    parts_.world->rayTest(toBullet(from), toBullet(to), callback);
    if (!callback.hasHit()) return std::nullopt;
    RayHit hit;
    hit.doll = callback.m_collisionObject->getUserIndex();
    hit.body = hit.doll >= 0 ? callback.m_collisionObject->getUserIndex2() : -1;
    hit.position = fromBullet(callback.m_hitPointWorld);
    hit.normal = glm::normalize(fromBullet(callback.m_hitNormalWorld));
    hit.fraction = callback.m_closestHitFraction;
    return hit;
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
    return std::make_unique<BulletWorld>(settings, tuning);
}

}  // namespace lutka::physics
