#pragma once

#include <array>

namespace lutka::physics {

/// What a row is for, which decides its part in the two passes of SubstepSolver.
enum class RowDuty {
    keeps,   ///< Holds in both passes as it is: motors, pulls, bounds on speed.
    mends,   ///< Its speed mends an error of position: asked for only in the mend pass.
    yields,  ///< Friction: rests in the mend pass, so that nothing sticks where it should not be.
};

/// A constraint that remembers its rows' impulses from step to step and says what they are for.
class WarmStarted {
  public:
    virtual ~WarmStarted() = default;

    /// Whether the first three rows close a point and are solved as one block.
    [[nodiscard]] virtual bool startsWithPoint() const = 0;
    [[nodiscard]] virtual RowDuty dutyOf(int row) const = 0;
    /// How much speed the row gives way per impulse, in its units; 0: it is rigid.
    [[nodiscard]] virtual float softnessOf(int /*row*/) const { return 0.0F; }
    /// The impulse of a present row in the step before; 0 for a row that is new.
    [[nodiscard]] virtual float storedImpulse(int row) const = 0;
    virtual void storeImpulse(int row, float impulse) = 0;
    /// Called when all rows of a step are stored: rows that were not active are forgotten.
    virtual void finishStoring() = 0;
};

}  // namespace lutka::physics
