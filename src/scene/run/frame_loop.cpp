#include "scene/run/frame_loop.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/assert.hpp"

namespace lutka::scene {
namespace {

constexpr double kMemorySeconds = 0.5;  // after which a frame counts for 1/e in share()
constexpr double kCostMemory = 0.1;     // part that the newest step has in stepCost()
// A frame of 1/60 s is a step of 1/60 s, whatever the rounding of its length.
constexpr double kRounding = 1e-9;

}  // namespace

FrameLoop::FrameLoop(const FrameLoopSettings& settings, Clock clock) : settings_(settings), clock_(std::move(clock)) {
    LUTKA_ASSERT(settings.stepSeconds > 0.0 && settings.longestFrameSeconds > 0.0);
    LUTKA_ASSERT(settings.stepBudgetSeconds > 0.0 && settings.speed > 0.0);
}

void FrameLoop::setSpeed(double speed) {
    LUTKA_ASSERT(speed > 0.0);
    settings_.speed = speed;
}

void FrameLoop::setStepSeconds(float seconds) {
    LUTKA_ASSERT(seconds > 0.0F);
    const double rate = 1.0 / static_cast<double>(seconds);
    constexpr double rounding = 1e-3;
    const bool whole = std::abs(rate - std::round(rate)) < rounding;
    settings_.stepSeconds = whole ? 1.0 / std::round(rate) : static_cast<double>(seconds);
}

void FrameLoop::restart() {
    owed_ = 0.0;
    alpha_ = 1.0F;
}

int FrameLoop::affordableSteps() const {
    if (stepCost_ <= 0.0) return std::numeric_limits<int>::max();
    const double steps = settings_.stepBudgetSeconds / stepCost_;
    return steps < 1e6 ? std::max(1, static_cast<int>(steps)) : std::numeric_limits<int>::max();
}

void FrameLoop::timeStep(const std::function<void()>& step) {
    if (!clock_) return step();
    const double before = clock_();
    step();
    const double cost = std::max(clock_() - before, 0.0);
    stepCost_ = stepCost_ > 0.0 ? stepCost_ + (cost - stepCost_) * kCostMemory : cost;
}

int FrameLoop::advance(double frameSeconds, const std::function<void()>& step) {
    const double frame = std::isfinite(frameSeconds) ? std::max(frameSeconds, 0.0) : 0.0;
    const double wanted = frame * settings_.speed;
    const double dt = settings_.stepSeconds;
    owed_ += std::min(frame, settings_.longestFrameSeconds) * settings_.speed;
    double lost = wanted - std::min(frame, settings_.longestFrameSeconds) * settings_.speed;
    const int affordable = affordableSteps();
    int steps = 0;
    while (owed_ >= dt - kRounding && steps < affordable) {
        timeStep(step);
        owed_ = std::max(owed_ - dt, 0.0);
        ++steps;
    }
    if (owed_ > dt) {
        // One step's time stays owed, so that each late frame shows the newest state after the same number of steps:
        // keeping the odd part instead would move the picture by fits and starts.
        lost += owed_ - dt;
        owed_ = dt;
    }
    alpha_ = static_cast<float>(std::clamp(owed_ / dt, 0.0, 1.0));
    const double kept = std::exp(-frame / kMemorySeconds);
    wanted_ = wanted_ * kept + wanted;
    taken_ = taken_ * kept + std::max(wanted - lost, 0.0);
    return steps;
}

FrameLoop::Clock steadyClock() {
    return [] { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); };
}

}  // namespace lutka::scene
