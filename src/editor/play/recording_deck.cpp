#include "editor/play/recording_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lutka::editor {

void RecordingDeck::start(scene::Simulation& simulation) {
    LUTKA_ASSERT(!replaying_);
    recording_ = scene::beginRecording(simulation);
    scene::record(simulation, recording_);
    recordingOn_ = true;
}

// What no longer has the same bodies ends the recording.
void RecordingDeck::keepStep(scene::Simulation& simulation) {
    if (!recordingOn_) return;
    const scene::Recording present = scene::beginRecording(simulation);
    const bool same = present.frameSize() == recording_.frameSize() &&
                      present.bodiesOfDoll == recording_.bodiesOfDoll && present.dt == recording_.dt;
    if (!same || steps() >= kMostSteps) {
        recordingOn_ = false;
        return;
    }
    scene::record(simulation, recording_);
}

double RecordingDeck::seconds() const {
    return std::max(steps() - 1, 0) * static_cast<double>(recording_.dt);
}

Result<void> RecordingDeck::replay(scene::Simulation& simulation) {
    recordingOn_ = false;
    const scene::Recording present = scene::beginRecording(simulation);
    if (steps() == 0) return Error{ErrorCode::usage, "there is no recording to replay", "", "record first"};
    if (present.frameSize() != recording_.frameSize() || present.bodiesOfDoll != recording_.bodiesOfDoll ||
        present.bodiesPerDoll != recording_.bodiesPerDoll) {
        return Error{ErrorCode::usage,
                     fmt::format("the recording has {} moving things, the scene {}", recording_.frameSize(),
                                 present.frameSize()),
                     "", "open the scene and model that it was recorded with"};
    }
    replaying_ = true;
    scrubTo(0.0, simulation);
    return {};
}

void RecordingDeck::scrubTo(double seconds, scene::Simulation& simulation) {
    if (!replaying_) return;
    const auto dt = static_cast<double>(recording_.dt);
    position_ = std::clamp(seconds, 0.0, this->seconds());
    const int last = steps() - 1;
    const int before = std::min(static_cast<int>(std::floor(position_ / dt + 1e-6)), last);
    const int after = std::min(before + 1, last);
    const auto share = static_cast<float>(std::clamp(position_ / dt - before, 0.0, 1.0));
    const auto a = recording_.frame(before);
    const auto b = recording_.frame(after);
    shown_.resize(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        shown_[i] = interpolate(a[i], b[i], share);
    simulation.preview(shown_);
}

Result<void> RecordingDeck::save(const std::filesystem::path& file) const {
    if (steps() == 0) return Error{ErrorCode::usage, "there is no recording to save", "", "record first"};
    return scene::saveRecording(file, recording_);
}

Result<void> RecordingDeck::open(const std::filesystem::path& file, scene::Simulation& simulation) {
    auto opened = scene::loadRecording(file);
    if (!opened) return opened.error();
    std::swap(recording_, opened.value());
    auto shown = replay(simulation);
    if (!shown) std::swap(recording_, opened.value());
    return shown;
}

}  // namespace lutka::editor
