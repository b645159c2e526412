#pragma once

#include "physics/bullet/force_constraint.hpp"
#include "physics/world/world.hpp"

namespace lutka::physics {

/// A soft pull of one body's point towards a point of the world, with a bound on the force. The pull is a critically
/// damped approach: the point is asked for the speed that closes the gap in about `kSeconds`.
class DragConstraint final : public ForceConstraint {
  public:
    static constexpr float kSeconds = 0.08F;
    static constexpr float kMaxSpeed = 12.0F;  ///< m/s, whatever the distance.

    DragConstraint(btRigidBody& body, const Drag& drag);

    void setTarget(const Drag& drag) { drag_ = drag; }
    /// Seconds from the coming substep's start to the step's end, when the target is where the drag says.
    void setRemaining(float seconds) { remaining_ = seconds; }
    [[nodiscard]] const Drag& drag() const { return drag_; }

    void getInfo1(btConstraintInfo1* info) override;
    void getInfo2(btConstraintInfo2* info) override;

    /// Velocity of the dragged point, m/s.
    [[nodiscard]] vec3 pointVelocity() const;
    /// The force of the last substep on the body, N.
    [[nodiscard]] vec3 force() const;

  private:
    [[nodiscard]] vec3 arm() const;

    Drag drag_;
    float remaining_ = 0;
    btJointFeedback feedback_{};
};

}  // namespace lutka::physics
