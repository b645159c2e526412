#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "render/frame.hpp"

namespace lutka::editor {

/// The value that half, 95 % and 99 % of the samples do not exceed.
struct Percentiles {
    float p50 = 0, p95 = 0, p99 = 0;
};
/// Zeros for no samples. `fromAbove`: the value that the share does not fall below instead.
[[nodiscard]] inline Percentiles percentilesOf(std::span<const float> values, bool fromAbove = false) {
    std::vector<float> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    if (fromAbove) std::reverse(sorted.begin(), sorted.end());
    const auto at = [&](float share) {
        return sorted.empty() ? 0.0F : sorted[static_cast<std::size_t>(share * static_cast<float>(sorted.size() - 1))];
    };
    return {at(0.5F), at(0.95F), at(0.99F)};
}

/// Times of the last frames, for the plots. Frames come from the application, the oldest first.
class FrameHistory {
  public:
    static constexpr std::size_t kLength = 180;

    void add(float frameMs) {
        if (frameMs_.size() == kLength) frameMs_.erase(frameMs_.begin());
        frameMs_.push_back(frameMs);
    }
    [[nodiscard]] std::span<const float> frameMs() const { return frameMs_; }
    /// What each frame alone would make: 1000 / its milliseconds.
    [[nodiscard]] std::vector<float> framesPerSecond() const {
        std::vector<float> rates;
        rates.reserve(frameMs_.size());
        for (const float ms : frameMs_)
            rates.push_back(ms > 0.0F ? 1000.0F / ms : 0.0F);
        return rates;
    }
    [[nodiscard]] float fps() const {
        float sum = 0;
        for (const float ms : frameMs_)
            sum += ms;
        return sum > 0 ? 1000.0F * static_cast<float>(frameMs_.size()) / sum : 0.0F;
    }

    render::FrameStats stats;   ///< Of the last picture.
    float pictureShare = 1.0F;  ///< Of the window's width and height that the last picture was drawn with.

  private:
    std::vector<float> frameMs_;
};

}  // namespace lutka::editor
