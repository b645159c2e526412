#pragma once

#include <deque>
#include <utility>

namespace lutka::physics {

/// The largest height that a signal keeps for a given time: a sliding minimum over that time, and its maximum. A signal
/// that is at zero costs nothing but a comparison.
class LastingPeak {
  public:
    explicit LastingPeak(double seconds) : window_(seconds) {}

    /// Times must not fall. Returns the least value since `window` seconds ago; 0 until the signal has been above zero
    /// for so long.
    float add(double seconds, float value) {
        if (!(value > 0.0F)) {
            rising_.clear();
            return 0.0F;
        }
        if (rising_.empty()) since_ = seconds;
        while (!rising_.empty() && rising_.back().second >= value)
            rising_.pop_back();
        rising_.emplace_back(seconds, value);
        const double start = seconds - window_;
        if (since_ > start) return 0.0F;
        while (rising_.front().first < start)
            rising_.pop_front();
        return rising_.front().second;
    }

  private:
    double window_;
    double since_ = 0;                             // start of the present stretch above zero
    std::deque<std::pair<double, float>> rising_;  // candidates for the minimum: later ones are higher
};

}  // namespace lutka::physics
