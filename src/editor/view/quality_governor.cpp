#include "editor/view/quality_governor.hpp"

#include <array>
#include <cstddef>

namespace lutka::editor {
namespace {

constexpr std::array<PictureQuality, 4> kLevels = {
    PictureQuality{1.0F, true}, {0.7F, false}, {0.5F, false}, {0.35F, false}};

// What the better picture costs, as a multiple of the one that is drawn.
double costOfBetter(int level) {
    constexpr double occlusion = 1.5;
    const PictureQuality& now = kLevels[static_cast<std::size_t>(level)];
    const PictureQuality& better = kLevels[static_cast<std::size_t>(level) - 1];
    const double pixels = static_cast<double>(better.share * better.share) / (now.share * now.share);
    return pixels * (better.ambientOcclusion == now.ambientOcclusion ? 1.0 : occlusion);
}

}  // namespace

const PictureQuality& QualityGovernor::quality() const {
    return kLevels[static_cast<std::size_t>(level_)];
}

void QualityGovernor::takeBack() {
    lowest_ = --level_;
    sinceLimit_ = 0;
    costBefore_ = 0.0;
}

const PictureQuality& QualityGovernor::update(double drawSeconds) {
    if (++sinceLimit_ > kForgetFrames) lowest_ = kNoLimit;
    const bool late = drawSeconds > kLateSeconds;
    lateFor_ = late ? lateFor_ + 1 : 0;
    if (lateFor_ >= kLateFrames || drawSeconds > kHaltSeconds) {
        const bool inVain = level_ > 0 && costBefore_ > 0.0 && drawSeconds > kHelps * costBefore_;
        if (inVain) {
            takeBack();
        } else if (level_ + 1 < static_cast<int>(kLevels.size()) && level_ < lowest_) {
            ++level_;
            costBefore_ = drawSeconds;
        } else {
            return quality();
        }
        lateFor_ = easyFor_ = 0;
        return quality();
    }
    const bool easy = level_ > 0 && drawSeconds * costOfBetter(level_) < kEasySeconds;
    easyFor_ = easy ? easyFor_ + 1 : 0;
    if (easyFor_ < kEasyFrames) return quality();
    --level_;
    easyFor_ = 0;
    costBefore_ = 0.0;
    return quality();
}

}  // namespace lutka::editor
