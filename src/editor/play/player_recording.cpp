/// Player's recordings: keeping the bodies of every step, and showing them again without physics.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "editor/play/player.hpp"

namespace lutka::editor {

void Player::startRecording() {
    endReplay();
    recording_ = scene::beginRecording(*simulation_);
    scene::record(*simulation_, recording_);
    recordingOn_ = true;
}

// After every step; what no longer has the same bodies ends the recording.
void Player::keepStep() {
    if (!recordingOn_) return;
    const scene::Recording present = scene::beginRecording(*simulation_);
    const bool same = present.frameSize() == recording_.frameSize() &&
                      present.bodiesOfDoll == recording_.bodiesOfDoll && present.dt == recording_.dt;
    if (!same || recordedSteps() >= kMostRecordedSteps) {
        recordingOn_ = false;
        return;
    }
    scene::record(*simulation_, recording_);
}

int Player::recordedSteps() const {
    return recording_.steps();
}

double Player::recordedSeconds() const {
    return std::max(recordedSteps() - 1, 0) * static_cast<double>(recording_.dt);
}

Result<void> Player::replay() {
    recordingOn_ = false;
    const scene::Recording present = scene::beginRecording(*simulation_);
    if (recordedSteps() == 0) return Error{ErrorCode::usage, "there is no recording to replay", "", "record first"};
    if (present.frameSize() != recording_.frameSize() || present.bodiesOfDoll != recording_.bodiesOfDoll ||
        present.bodiesPerDoll != recording_.bodiesPerDoll) {
        return Error{ErrorCode::usage,
                     fmt::format("the recording has {} moving things, the scene {}", recording_.frameSize(),
                                 present.frameSize()),
                     "", "open the scene and model that it was recorded with"};
    }
    replaying_ = true;
    playing_ = true;
    scrubTo(0.0);
    return {};
}

void Player::endReplay() {
    if (!replaying_) return;
    replaying_ = false;
    playing_ = false;
    loop_.restart();
    simulation_->refresh();
}

void Player::scrubTo(double seconds) {
    if (!replaying_) return;
    const auto dt = static_cast<double>(recording_.dt);
    replaySeconds_ = std::clamp(seconds, 0.0, recordedSeconds());
    const int last = recordedSteps() - 1;
    const int before = std::min(static_cast<int>(std::floor(replaySeconds_ / dt + 1e-6)), last);
    const int after = std::min(before + 1, last);
    const auto share = static_cast<float>(std::clamp(replaySeconds_ / dt - before, 0.0, 1.0));
    const auto a = recording_.frame(before);
    const auto b = recording_.frame(after);
    shown_.resize(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        shown_[i] = interpolate(a[i], b[i], share);
    simulation_->preview(shown_);
}

void Player::advanceReplay(double seconds) {
    if (!playing_) return;
    if (replaySeconds_ >= recordedSeconds()) {
        playing_ = false;
        return;
    }
    scrubTo(replaySeconds_ + std::min(seconds, 0.1) * speed_);
}

Result<void> Player::saveRecording(const std::filesystem::path& file) const {
    if (recordedSteps() == 0) return Error{ErrorCode::usage, "there is no recording to save", "", "record first"};
    return scene::saveRecording(file, recording_);
}

Result<void> Player::openRecording(const std::filesystem::path& file) {
    auto opened = scene::loadRecording(file);
    if (!opened) return opened.error();
    std::swap(recording_, opened.value());
    auto shown = replay();
    if (!shown) std::swap(recording_, opened.value());
    return shown;
}

}  // namespace lutka::editor
