#pragma once

#include <span>
#include <vector>

#include "physics/powered/balance.hpp"
#include "physics/powered/muscles.hpp"
#include "physics/world/world.hpp"

namespace lutka::physics {

/// Drives the joints of a doll towards a pose in motion by motors. What a joint's spring is made for is worked out
/// once, from the bodies on either side of it, so that muscles are set by frequency and damping ratio alone.
class PoseDrive {
  public:
    /// `bodies`: one a body, in any pose in which the constraints hold (the doll's start). The profile must outlive
    /// this.
    PoseDrive(const RagdollProfile& profile, std::span<const BodyState> bodies);

    /// Sets the motors for the coming step of `dt` > 0 s, in which the pose moves from `from` to `to` (world or model
    /// space alike, one a body): the motors have the pose's rates, so that a pose in motion is followed without lag. A
    /// joint without strength is limp. `factors` on the strength of the joint above each body, one a body, or empty: 1.
    /// Joints that `stance` lets carry the doll are as stiff as what they carry asks for: a foot on the ground is not
    /// moved by its ankle, all else is. Allocates nothing once a doll has motors.
    void drive(World& world, DollId doll, const MuscleSettings& muscles, std::span<const RigidTransform> from,
               std::span<const RigidTransform> to, float dt, std::span<const float> factors = {},
               const Stance* stance = nullptr);
    /// From the next drive() on no motor's target is farther than this from where its joint is, radians, > 0; kPi, as
    /// it is at first: never changed. What is held back by force then comes along gently once it is let go.
    void setMostLead(float lead) { mostLead_ = lead; }
    /// Likewise of the speed that a motor drives its joint to while nothing else holds it: the target's rate and the
    /// spring's pull over the damper together, rad/s, > 0; unbounded at first. With either bound joints are damped
    /// more, most of all those above a hand, a foot or a head.
    void setMostSpeed(float speed) { mostSpeed_ = speed; }
    static constexpr float kUnbounded = 1e9F;
    /// Whether a joint with a bound on lead or speed that is very far from its target goes there by the middle of its
    /// range instead of the shortest way; at first none does.
    void setGoesByMiddle(bool goes) { goesByMiddle_ = goes; }
    /// The farthest that a joint was from its target in the last drive() with a bound on lead or speed, radians.
    [[nodiscard]] float farthest() const { return farthest_; }
    /// The farthest that two bodies' centres were apart at first: about the doll's height, metres.
    [[nodiscard]] float height() const { return heightM_; }
    /// Takes all motors away.
    void release(World& world, DollId doll) const;

    /// The moment of inertia that a joint's motor works against, kg m²: that of all bodies below the joint and of all
    /// above it about its anchor, as two bodies that turn each other (1 / (1/a + 1/b)); each the mean of the two larger
    /// moments, which is a limb's about the axes across it.
    [[nodiscard]] float inertiaOf(int constraint) const { return joints_[constraint].inertia; }
    /// N m/rad and N m; `factor` on the strength.
    [[nodiscard]] float stiffnessOf(int constraint, const MuscleSettings& muscles, float factor = 1.0F) const;
    [[nodiscard]] float torqueBoundOf(int constraint, const MuscleSettings& muscles, float factor = 1.0F) const;

  private:
    struct Joint {
        float inertia = 0.0F;
        float above = 0.0F;      // moment of all that is not below
        float leverKgM = 0.0F;   // of all below about the anchor, as if all of it lay the same way
        std::vector<int> below;  // bodies
    };
    // What gravity does about the joint through all that hangs below it, N m, world.
    [[nodiscard]] vec3 gravityTorque(int constraint, const vec3& gravity) const;

    [[nodiscard]] quat parentFrameOf(const ConstraintProfile& constraint) const;
    [[nodiscard]] quat turnNow(const ConstraintProfile& constraint) const;
    void giveTorque(const ConstraintProfile& constraint, const vec3& worldAxis, float torque, JointMotor& motor) const;
    void brake(int constraint, const MuscleSettings& muscles, float ratio, JointMotor& motor) const;
    void leashTo(const ConstraintProfile& constraint, float inertia, JointMotor& motor);

    const RagdollProfile& profile_;
    float mostLead_ = kPi;
    float mostSpeed_ = kUnbounded;
    bool goesByMiddle_ = false;
    float farthest_ = 0.0F;
    std::vector<Joint> joints_;      // one a constraint
    float massKg_ = 0.0F;            // of the doll
    float heightM_ = 0.0F;           // about
    std::vector<BodyState> bodies_;  // where they are, while a step is prepared
};

/// How far each joint is from a pose's, radians, one a constraint: the angle of the rotation between the child's frame
/// in the parent's here and there.
void jointErrors(const RagdollProfile& profile, std::span<const RigidTransform> pose,
                 std::span<const RigidTransform> bodies, std::span<float> radians);

}  // namespace lutka::physics
