#pragma once

namespace lutka::scene {

/// When substeps are spared and when they come back. `load` is FrameLoop::load(): the part of real time that stepping
/// takes.
struct GovernorSettings {
    double late = 0.8;      ///< From this load on substeps are taken away, > 0. More: later.
    double easy = 0.7;      ///< Under it, as the load would be with one substep more, one comes back; below `late`.
                            ///< The nearer to `late`, the sooner it swings back and forth.
    int lateFrames = 6;     ///< For so many frames in a row, > 0: one slow frame changes nothing.
    int easyFrames = 60;    ///< Likewise; longer, so that quality does not flicker.
    int leastSubsteps = 2;  ///< > 0.
};

/// Fewer substeps when the machine is late: softer joints and deeper contacts instead of a slower simulation. Cost
/// grows with the substeps, so that what another number would cost is known before it is tried.
class SubstepGovernor {
  public:
    /// `full`: the solver's own number, >= 1.
    explicit SubstepGovernor(int full, const GovernorSettings& settings = {});

    /// After a frame. Returns how many substeps the next ones are to have.
    int update(double load);
    [[nodiscard]] int substeps() const { return substeps_; }

  private:
    GovernorSettings settings_;
    int full_;
    int substeps_;
    int lateFor_ = 0;
    int easyFor_ = 0;
};

}  // namespace lutka::scene
