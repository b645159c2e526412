#pragma once

#include <span>
#include <vector>

#include "render/frame.hpp"

namespace lutka::editor {

/// Times of the last frames, for the plots. Frames come from the application, the oldest first.
class FrameHistory {
  public:
    static constexpr std::size_t kLength = 180;

    void add(float frameMs) {
        if (frameMs_.size() == kLength) frameMs_.erase(frameMs_.begin());
        frameMs_.push_back(frameMs);
    }
    [[nodiscard]] std::span<const float> frameMs() const { return frameMs_; }
    [[nodiscard]] float fps() const {
        float sum = 0;
        for (const float ms : frameMs_)
            sum += ms;
        return sum > 0 ? 1000.0F * static_cast<float>(frameMs_.size()) / sum : 0.0F;
    }

    render::FrameStats stats;  ///< Of the last picture.

  private:
    std::vector<float> frameMs_;
};

}  // namespace lutka::editor
