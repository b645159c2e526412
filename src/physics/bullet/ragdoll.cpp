#include "physics/bullet/ragdoll.hpp"

#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <glm/common.hpp>
#include <limits>

#include "core/assert.hpp"
#include "physics/bullet/contact_gatherer.hpp"
#include "physics/bullet/convert.hpp"
#include "physics/collision/friction.hpp"

namespace lutka::physics {

namespace {

// Bullet rounds a hull by its margin, out of the points that it is given: so it gets a smaller hull. Its user pointer
// is to the whole one.
class HullShape final : public btConvexHullShape {
  public:
    explicit HullShape(ConvexHullPtr hull) : hull_(std::move(hull)) {
        constexpr float kMargin = 0.004F;  // metres
        constexpr float kMostOfInside = 0.25F;
        const std::span<const vec3> points = hull_->points();
        btConvexHullComputer shrunk;
        const float margin =
            shrunk.compute(&points[0].x, sizeof(vec3), static_cast<int>(points.size()), kMargin, kMostOfInside);
        for (int i = 0; i < shrunk.vertices.size(); ++i)
            addPoint(shrunk.vertices[i], false);
        setMargin(std::max(margin, 0.0F));
        recalcLocalAabb();
        setUserPointer(const_cast<ConvexHull*>(hull_.get()));  // Bullet knows no pointer to what is constant
    }

  private:
    ConvexHullPtr hull_;
};

std::unique_ptr<btCollisionShape> makePrimitive(const PrimitiveShape& shape) {
    switch (shape.kind) {
        case PrimitiveShape::Kind::capsule:
            return std::make_unique<btCapsuleShape>(shape.radius, 2.0F * shape.halfLength);
        case PrimitiveShape::Kind::box:
            return std::make_unique<btBoxShape>(toBullet(shape.halfExtents));
        case PrimitiveShape::Kind::hull:
            return std::make_unique<HullShape>(shape.hull);
        case PrimitiveShape::Kind::sphere:
            break;
    }
    return std::make_unique<btSphereShape>(shape.radius);
}

// The union of a body's shapes.
class UnionShape final : private std::vector<std::unique_ptr<btCollisionShape>>, public btCompoundShape {
  public:
    explicit UnionShape(const BodyShape& shape) : btCompoundShape(true, 1 + static_cast<int>(shape.more.size())) {
        visitShapes(shape, [&](const PrimitiveShape& part, const RigidTransform& bodyFromShape) {
            push_back(makePrimitive(part));
            addChildShape(toBullet(bodyFromShape), back().get());
        });
    }
};

}  // namespace

std::unique_ptr<btCollisionShape> makeShape(const BodyShape& shape) {
    if (shape.more.empty()) return makePrimitive(shape);
    return std::make_unique<UnionShape>(shape);
}

BodyInWorld makeBody(const BodyShape& shape, float massKg, const vec3& inertia, const BodyState& state) {
    BodyInWorld made{makeShape(shape), nullptr};
    const btRigidBody::btRigidBodyConstructionInfo info(massKg, nullptr, made.shape.get(), toBullet(inertia));
    made.body = std::make_unique<btRigidBody>(info);
    setState(*made.body, state);
    return made;
}

BodyState stateOf(const btRigidBody& body) {
    return {fromBullet(body.getWorldTransform()), fromBullet(body.getLinearVelocity()),
            fromBullet(body.getAngularVelocity())};
}

void setState(btRigidBody& body, const BodyState& state) {
    const btTransform worldFromBody = toBullet(state.worldFromBody);
    body.setWorldTransform(worldFromBody);
    body.setInterpolationWorldTransform(worldFromBody);
    body.setLinearVelocity(toBullet(state.linearVelocity));
    body.setAngularVelocity(toBullet(state.angularVelocity));
    body.setInterpolationLinearVelocity(body.getLinearVelocity());
    body.setInterpolationAngularVelocity(body.getAngularVelocity());
    body.updateInertiaTensor();
    body.clearForces();
    // Bullet gives up a body whose bounds were not finite.
    if (body.getActivationState() == DISABLE_SIMULATION) body.forceActivationState(ACTIVE_TAG);
    body.activate(true);
}

void setFilter(btDiscreteDynamicsWorld& world, btRigidBody& body, const CollisionFilter& filter) {
    btBroadphaseProxy& proxy = *body.getBroadphaseHandle();
    proxy.m_collisionFilterGroup = static_cast<int>(filter.layers);
    proxy.m_collisionFilterMask = static_cast<int>(filter.mask);
    world.refreshBroadphaseProxy(&body);  // pairs are made anew under the new filter
}

Ragdoll::Ragdoll(btDiscreteDynamicsWorld& world, DollId id, const RagdollProfile& profile,
                 std::span<const BodyState> bodies, const BulletTuning& tuning, const JointTuning& jointTuning,
                 bool stockJoints, bool sleeping)
    : world_(world), profile_(profile), motors_(profile.constraints.size()), stock_(stockJoints) {
    LUTKA_ASSERT(bodies.size() == profile.bodies.size());
    const std::size_t count = profile.bodies.size();
    collides_.assign(count * count, 1);
    const auto never = [&](std::size_t a, std::size_t b) { collides_[a * count + b] = collides_[b * count + a] = 0; };
    for (const ConstraintProfile& constraint : profile.constraints)
        never(constraint.parent, constraint.child);
    for (const auto& [a, b] : profile.filteredPairs)
        never(a, b);
    addBodies(id, bodies, tuning, stockJoints, sleeping);
    if (stockJoints)
        addStockConstraints();
    else
        addJoints(jointTuning);
}

Ragdoll::~Ragdoll() {
    for (const auto& motor : motors_)
        if (motor != nullptr && !stock_) world_.removeConstraint(motor.get());
    for (const auto& constraint : constraints_)
        world_.removeConstraint(constraint.get());
    for (const BodyInWorld& made : bodies_)
        world_.removeRigidBody(made.body.get());
}

void Ragdoll::addBodies(DollId id, std::span<const BodyState> states, const BulletTuning& tuning, bool stock,
                        bool sleeping) {
    std::vector<btRigidBody*> all;
    std::vector<vec3> inertias;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const BodyProfile& body = profile_.bodies[i];
        const vec3 inertia = conditionedInertia(profile_, body, stock ? 0.0F : tuning.leastGyration);
        inertias.push_back(inertia);
        bodies_.push_back(makeBody(body.shape, body.massKg, inertia, states[i]));
        btRigidBody& made = *bodies_.back().body;
        name(made, id, static_cast<int>(i));
        made.setUserPointer(this);
        made.setFriction(kBodyFriction);
        if (!stock) made.setDamping(tuning.linearDamping, tuning.angularDamping);
        if (!sleeping) made.setActivationState(DISABLE_DEACTIVATION);
        all.push_back(&made);
    }
    led_ = std::make_unique<LedBodies>(std::move(all), profile_, std::move(inertias), fromBullet(world_.getGravity()));
    // Only now, for the pair filter asks for all of them.
    for (const BodyInWorld& made : bodies_)
        world_.addRigidBody(made.body.get(), static_cast<int>(filter_.layers), static_cast<int>(filter_.mask));
}

void Ragdoll::addStockConstraints() {
    for (const ConstraintProfile& c : profile_.constraints) {
        btRigidBody& parent = body(c.parent);
        btRigidBody& child = body(c.child);
        const btTransform parentFrame = toBullet(c.parentFromFrame);
        const btTransform childFrame = toBullet(c.childFromFrame);
        if (c.kind == ConstraintProfile::Kind::hinge) {
            // With the child's angle read in the parent's frame it has the sign of a rotation about frame z.
            auto hinge = std::make_unique<btHingeConstraint>(parent, child, parentFrame, childFrame, true);
            hinge->setLimit(c.hinge.lower, c.hinge.upper);
            constraints_.push_back(std::move(hinge));
        } else {
            auto cone = std::make_unique<btConeTwistConstraint>(parent, child, parentFrame, childFrame);
            cone->setLimit(c.cone.swingZ, c.cone.swingY, c.cone.twist);  // span 1 is the one about z
            constraints_.push_back(std::move(cone));
        }
        world_.addConstraint(constraints_.back().get(), true);
    }
    for (const auto& [a, b] : profile_.filteredPairs)
        body(a).setIgnoreCollisionCheck(&body(b), true);
}

void Ragdoll::addJoints(const JointTuning& tuning) {
    for (const ConstraintProfile& c : profile_.constraints) {
        auto joint = std::make_unique<RagdollJoint>(c, body(c.parent), body(c.child), tuning);
        joints_.push_back(joint.get());
        constraints_.push_back(std::move(joint));
        world_.addConstraint(constraints_.back().get(), true);
    }
}

bool Ragdoll::isAsleep() const {
    return std::all_of(bodies_.begin(), bodies_.end(),
                       [](const BodyInWorld& made) { return made.body->getActivationState() == ISLAND_SLEEPING; });
}

void Ragdoll::setBodies(std::span<const BodyState> bodies) {
    LUTKA_ASSERT(bodies.size() == bodies_.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        physics::setState(*bodies_[i].body, bodies[i]);
        world_.updateSingleAabb(bodies_[i].body.get());
        // Contacts of the old place would push in the new one.
        world_.getBroadphase()->getOverlappingPairCache()->cleanProxyFromPairs(bodies_[i].body->getBroadphaseHandle(),
                                                                               world_.getDispatcher());
    }
    for (RagdollJoint* joint : joints_)
        joint->forgetImpulses();
    for (const auto& motor : motors_)
        if (motor != nullptr) motor->forgetImpulses();
}

DollState Ragdoll::state() const {
    DollState state;
    state.filter = filter_;
    state.asleep = isAsleep();
    state.restSeconds = std::numeric_limits<float>::max();
    for (const BodyInWorld& made : bodies_) {
        state.bodies.push_back(stateOf(*made.body));
        state.restSeconds = std::min(state.restSeconds, made.body->getDeactivationTime());
    }
    for (const auto& motor : motors_)
        state.motors.push_back(motor != nullptr ? std::optional(motor->motor()) : std::nullopt);
    return state;
}

void Ragdoll::setState(const DollState& state, bool maySleep) {
    LUTKA_ASSERT(state.motors.size() == motors_.size());
    setBodies(state.bodies);
    if (!(state.filter == filter_)) setFilter(state.filter);
    for (std::size_t i = 0; i < motors_.size(); ++i)
        setMotor(static_cast<int>(i), state.motors[i]);
    if (!maySleep) return;
    for (const BodyInWorld& made : bodies_) {
        made.body->setDeactivationTime(state.restSeconds);
        if (state.asleep) made.body->forceActivationState(ISLAND_SLEEPING);
    }
}

void Ragdoll::setMotor(int constraint, const std::optional<JointMotor>& motor) {
    std::unique_ptr<MotorConstraint>& slot = motors_[constraint];
    if (!motor) {
        if (slot != nullptr && !stock_) world_.removeConstraint(slot.get());
        slot.reset();
        return;
    }
    if (slot == nullptr) {
        const ConstraintProfile& c = profile_.constraints[constraint];
        slot = std::make_unique<MotorConstraint>(c, body(c.parent), body(c.child));
        if (!stock_) world_.addConstraint(slot.get(), true);
    }
    slot->set(*motor);
}

void Ragdoll::setTarget(int body, const std::optional<BodyTarget>& target) {
    if (!led_->set(body, target)) return;
    world_.refreshBroadphaseProxy(bodies_[body].body.get());  // what it collides with has changed
    for (std::size_t i = 0; i < constraints_.size(); ++i) {
        const ConstraintProfile& joint = profile_.constraints[i];
        const bool held = led_->isKinematic(joint.parent) && led_->isKinematic(joint.child);
        if (constraints_[i]->isEnabled() == held && i < joints_.size()) joints_[i]->forgetImpulses();
        constraints_[i]->setEnabled(!held);
    }
}

void Ragdoll::setFilter(const CollisionFilter& filter) {
    filter_ = filter;
    for (const BodyInWorld& made : bodies_)
        physics::setFilter(world_, *made.body, filter);
}

void Ragdoll::wake() {
    for (const BodyInWorld& made : bodies_)
        made.body->activate(true);
}

}  // namespace lutka::physics
