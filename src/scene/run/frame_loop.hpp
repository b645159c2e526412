#pragma once

#include <functional>

namespace lutka::scene {

struct FrameLoopSettings {
    double stepSeconds = 1.0 / 60.0;    ///< Simulated seconds a step, > 0.
    double speed = 1.0;                 ///< Wanted simulated seconds a second, > 0. Below 1: slow motion.
    double longestFrameSeconds = 0.1;   ///< Of a longer frame the rest is lost, > 0: a halt is not caught up with.
    double stepBudgetSeconds = 0.0225;  ///< Of the clock's time that the steps of one frame may take, > 0. More: fewer
                                        ///< pictures a second before the simulation slows down.
};

/// Fixed steps under pictures of any length: the simulation's clock beside the drawing's.
///
///     frame     |----------|------|-----------------|---   as long as the machine needs
///     step        |----|----|----|----|----|----|----|     always stepSeconds; only the number in a frame varies
///     drawn     between the last two steps, at alpha()
///
/// When the steps cannot be had in time, a loop that tries to catch up makes each frame longer than the one before
/// until it stands. Here a frame takes as many steps as its budget holds (one at least) and the rest of its time is
/// lost: the simulation runs slower, evenly, and share() says by how much.
class FrameLoop {
  public:
    using Clock = std::function<double()>;  ///< Seconds from any start, never going back.

    /// `clock` times the steps; without one they count as free, which makes the same frames give the same steps.
    explicit FrameLoop(const FrameLoopSettings& settings = {}, Clock clock = {});

    /// A picture's time has passed: calls `step` as often as it asks for and the budget allows. Returns how often.
    /// A frame time that is negative or no number counts as 0.
    int advance(double frameSeconds, const std::function<void()>& step);

    /// Where between the last two states the picture is, [0, 1].
    [[nodiscard]] float alpha() const { return alpha_; }
    /// Of the wanted speed, the share that the last second had, [0, 1]; a mean that forgets older frames.
    [[nodiscard]] double share() const { return wanted_ > 0.0 ? taken_ / wanted_ : 1.0; }
    /// Simulated seconds a second, likewise: speed() where the machine keeps up.
    [[nodiscard]] double achievedSpeed() const { return settings_.speed * share(); }
    /// Whether nothing to speak of was lost in the last second.
    [[nodiscard]] bool keepsUp() const { return share() > 0.98; }
    /// Seconds of the clock that a step takes, a mean of the last ones; 0 without a clock.
    [[nodiscard]] double stepCost() const { return stepCost_; }
    /// The part of real time that stepping takes at the wanted speed; from 1 on there is none left for a picture.
    [[nodiscard]] double load() const { return stepCost_ * settings_.speed / settings_.stepSeconds; }

    [[nodiscard]] const FrameLoopSettings& settings() const { return settings_; }
    [[nodiscard]] double speed() const { return settings_.speed; }
    void setSpeed(double speed);
    /// Of the simulation's steps from now on. A float's 1/60 counts as 1/60.
    void setStepSeconds(float seconds);
    /// The simulation was set back or stepped by hand: its present state is shown and no time is owed.
    void restart();

  private:
    [[nodiscard]] int affordableSteps() const;
    void timeStep(const std::function<void()>& step);

    FrameLoopSettings settings_;
    Clock clock_;
    double owed_ = 0.0;  // simulated seconds that frames have asked for and no step has covered yet
    float alpha_ = 1.0F;
    double stepCost_ = 0.0;
    double wanted_ = 0.0;  // simulated seconds asked for, older ones weigh less
    double taken_ = 0.0;   // and granted
};

/// std::chrono's steady clock for FrameLoop.
[[nodiscard]] FrameLoop::Clock steadyClock();

}  // namespace lutka::scene
