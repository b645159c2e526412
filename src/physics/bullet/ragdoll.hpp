#pragma once

#include <btBulletDynamicsCommon.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "physics/bullet/bullet_world.hpp"
#include "physics/bullet/led_bodies.hpp"
#include "physics/bullet/motor_constraint.hpp"
#include "physics/bullet/ragdoll_joint.hpp"
#include "physics/world/world.hpp"

namespace lutka::physics {

/// Bullet's shape for a profile's: a compound, which owns its children, where there are several.
[[nodiscard]] std::unique_ptr<btCollisionShape> makeShape(const BodyShape& shape);

/// A rigid body with the shape that it uses.
struct BodyInWorld {
    std::unique_ptr<btCollisionShape> shape;
    std::unique_ptr<btRigidBody> body;
};
/// A body in `state` that collides as `shape`; not yet in a world.
[[nodiscard]] BodyInWorld makeBody(const BodyShape& shape, float massKg, const vec3& inertia, const BodyState& state);

[[nodiscard]] BodyState stateOf(const btRigidBody& body);
/// Places a body, without a trace of where it was before.
void setState(btRigidBody& body, const BodyState& state);

/// Changes what a body in the world collides with, from the next step on.
void setFilter(btDiscreteDynamicsWorld& world, btRigidBody& body, const CollisionFilter& filter);

/// One doll's bodies and constraints in a Bullet world, which must outlive it.
class Ragdoll {
  public:
    /// Adds the doll to `world`. `stockJoints`: Bullet's own hinge and cone-twist instead of RagdollJoint. `tuning`
    /// must outlive the doll.
    Ragdoll(btDiscreteDynamicsWorld& world, DollId id, const RagdollProfile& profile, std::span<const BodyState> bodies,
            const BulletTuning& tuning, const JointTuning& jointTuning, bool stockJoints, bool sleeping);
    ~Ragdoll();
    Ragdoll(const Ragdoll&) = delete;
    Ragdoll& operator=(const Ragdoll&) = delete;

    [[nodiscard]] const RagdollProfile& profile() const { return profile_; }
    [[nodiscard]] btRigidBody& body(int index) const { return *bodies_[index].body; }
    [[nodiscard]] int bodyCount() const { return static_cast<int>(bodies_.size()); }
    /// Whether two of its bodies may touch: neither linked nor filtered.
    [[nodiscard]] bool mayCollide(int a, int b) const { return collides_[a * bodies_.size() + b] != 0; }
    [[nodiscard]] bool isAsleep() const;

    void setBodies(std::span<const BodyState> bodies);
    void wake();
    void setFilter(const CollisionFilter& filter);
    [[nodiscard]] const CollisionFilter& filter() const { return filter_; }

    [[nodiscard]] DollState state() const;
    /// `maySleep`: whether a sleeping state is taken over as such.
    void setState(const DollState& state, bool maySleep);

    void setMotor(int constraint, const std::optional<JointMotor>& motor);
    void setTarget(int body, const std::optional<BodyTarget>& target);
    [[nodiscard]] LedBodies& led() { return *led_; }
    [[nodiscard]] const LedBodies& led() const { return *led_; }
    /// One a constraint, null where there is none.
    [[nodiscard]] std::span<const std::unique_ptr<MotorConstraint>> motors() const { return motors_; }

  private:
    void addBodies(DollId id, std::span<const BodyState> states, const BulletTuning& tuning, bool stock, bool sleeping);
    void addStockConstraints();
    void addJoints(const JointTuning& tuning);

    btDiscreteDynamicsWorld& world_;
    const RagdollProfile& profile_;
    std::vector<BodyInWorld> bodies_;
    std::unique_ptr<LedBodies> led_;
    std::vector<std::unique_ptr<btTypedConstraint>> constraints_;
    std::vector<RagdollJoint*> joints_;  // the constraints that are ours
    std::vector<std::unique_ptr<MotorConstraint>> motors_;
    bool stock_;  // motors act as torques and are not in the world
    std::vector<std::uint8_t> collides_;
    CollisionFilter filter_;
};

}  // namespace lutka::physics
