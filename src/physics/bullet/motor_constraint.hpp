#pragma once

#include <array>

#include "physics/bullet/force_constraint.hpp"
#include "physics/world/world.hpp"

namespace lutka::physics {

/// The spring of a JointMotor as soft rows: with stiffness k, damping d and a substep h, the row
///     J (v - rate) + γ impulse = -k / (d + h k) · error,   γ = 1 / (h (d + h k))
/// is the spring taken at the end of the substep (implicit Euler; Catto, Soft Constraints, GDC 2011). The error is that
/// from where the target is at the substep's start.
class MotorConstraint final : public ForceConstraint {
  public:
    /// `profile` must outlive the constraint.
    MotorConstraint(const ConstraintProfile& profile, btRigidBody& parent, btRigidBody& child);

    void set(const JointMotor& motor) { motor_ = motor; }
    [[nodiscard]] const JointMotor& motor() const { return motor_; }

    /// Seconds from the coming substep's start to the step's end, when the target is where the motor says.
    void setRemaining(float seconds) { remaining_ = seconds; }

    void getInfo1(btConstraintInfo1* info) override;
    void getInfo2(btConstraintInfo2* info) override;

    [[nodiscard]] float softnessOf(int /*row*/) const override { return softness_; }
    void forgetImpulses() { impulses_.fill(0.0F); }

    /// For Bullet's own solver: the same spring as a torque on both bodies for the coming step, taken implicitly as if
    /// nothing else held them.
    void applyAsTorque(float seconds);

    /// Angular velocity of the child relative to the parent, rad/s, world.
    [[nodiscard]] vec3 relativeTurn() const;
    /// The last substep's impulse on the child, N m s, world.
    [[nodiscard]] vec3 impulse() const;

  private:
    void prepare(float seconds);

    const ConstraintProfile& profile_;
    JointMotor motor_;
    int rows_ = 0;
    std::array<vec3, 3> axes_{};  // world
    vec3 wanted_{0, 0, 0};        // rad/s about each axis: the target's rate and what brings the child to it
    float softness_ = 0;
    float remaining_ = 0;
};

}  // namespace lutka::physics
