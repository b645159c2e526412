#pragma once

#include <BulletDynamics/ConstraintSolver/btTypedConstraint.h>

#include <array>

#include "physics/bullet/warm_started.hpp"
#include "physics/world.hpp"

namespace lutka::physics {

/// A soft pull of one body's point towards a point of the world, with a bound on the force. The pull is a critically
/// damped approach: the point is asked for the speed that closes the gap in about `kSeconds`.
class DragConstraint final : public btTypedConstraint, public WarmStarted {
  public:
    static constexpr float kSeconds = 0.08F;
    static constexpr float kMaxSpeed = 12.0F;  ///< m/s, whatever the distance.

    DragConstraint(btRigidBody& body, const Drag& drag);

    void setTarget(const Drag& drag) { drag_ = drag; }
    [[nodiscard]] const Drag& drag() const { return drag_; }

    void getInfo1(btConstraintInfo1* info) override;
    void getInfo2(btConstraintInfo2* info) override;
    void setParam(int /*num*/, btScalar /*value*/, int /*axis*/) override {}
    [[nodiscard]] btScalar getParam(int /*num*/, int /*axis*/) const override { return 0.0F; }

    [[nodiscard]] bool startsWithPoint() const override { return false; }
    // The pull is a force, not a repair: its speed is the body's to keep.
    [[nodiscard]] RowDuty dutyOf(int /*row*/) const override { return RowDuty::keeps; }
    [[nodiscard]] float storedImpulse(int row) const override { return impulses_[row]; }
    void storeImpulse(int row, float impulse) override { impulses_[row] = impulse; }
    void finishStoring() override {}

    /// Velocity of the dragged point, m/s.
    [[nodiscard]] vec3 pointVelocity() const;
    /// The force of the last substep on the body, N.
    [[nodiscard]] vec3 force() const;

  private:
    [[nodiscard]] vec3 arm() const;

    Drag drag_;
    btJointFeedback feedback_{};
    std::array<float, 3> impulses_{};
};

}  // namespace lutka::physics
