#pragma once

#include <BulletDynamics/ConstraintSolver/btTypedConstraint.h>

#include <array>

#include "physics/bullet/warm_started.hpp"

namespace lutka::physics {

/// What acts on bodies by up to three rows as a force does: nothing of it repairs a position, so all its speed is the
/// bodies' to keep.
class ForceConstraint : public btTypedConstraint, public WarmStarted {
  public:
    using btTypedConstraint::btTypedConstraint;

    void setParam(int /*num*/, btScalar /*value*/, int /*axis*/) final {}
    [[nodiscard]] btScalar getParam(int /*num*/, int /*axis*/) const final { return 0.0F; }

    [[nodiscard]] bool startsWithPoint() const final { return false; }
    [[nodiscard]] RowDuty dutyOf(int /*row*/) const final { return RowDuty::keeps; }
    [[nodiscard]] float storedImpulse(int row) const final { return impulses_[row]; }
    void storeImpulse(int row, float impulse) final { impulses_[row] = impulse; }
    void finishStoring() final {}

  protected:
    std::array<float, 3> impulses_{};
};

}  // namespace lutka::physics
