#pragma once

#include <filesystem>
#include <vector>

#include "core/result.hpp"
#include "scene/recording.hpp"
#include "scene/simulation.hpp"

namespace lutka::editor {

/// Keeps the bodies of a simulation's steps and shows them again. It either keeps or shows, never both; what was kept
/// stays until the next start(). Every call takes the simulation, which may be another one each time: one with other
/// bodies ends keeping, and is refused for showing.
class RecordingDeck {
  public:
    static constexpr int kMostSteps = 36000;  ///< Ten minutes; recording ends there.

    /// Begins anew with the present state; a replay must have been ended.
    void start(scene::Simulation& simulation);
    /// After every step of the simulation.
    void keepStep(scene::Simulation& simulation);
    void stop() { recordingOn_ = false; }
    [[nodiscard]] bool recording() const { return recordingOn_; }
    [[nodiscard]] int steps() const { return recording_.steps(); }
    /// From the first to the last step that was kept; 0 without any.
    [[nodiscard]] double seconds() const;

    /// Shows the first step. Fails with ErrorCode::usage when nothing is kept, or the simulation has other bodies.
    [[nodiscard]] Result<void> replay(scene::Simulation& simulation);
    /// Ends showing; the caller shows the simulation's own state again.
    void endReplay() { replaying_ = false; }
    [[nodiscard]] bool replaying() const { return replaying_; }
    /// Where the replay is, [0, seconds()].
    [[nodiscard]] double position() const { return position_; }
    [[nodiscard]] bool atEnd() const { return position_ >= seconds(); }
    /// Shows the state at that time, between two steps their mean; outside of the recording its nearest end.
    void scrubTo(double seconds, scene::Simulation& simulation);
    void showNextStep(scene::Simulation& simulation) {
        scrubTo(position_ + static_cast<double>(recording_.dt), simulation);
    }

    /// Fails with ErrorCode::usage when nothing is kept, and as scene::saveRecording() does.
    [[nodiscard]] Result<void> save(const std::filesystem::path& file) const;
    /// Opens and replays it; fails as loadRecording() and replay() do, with what was kept before.
    [[nodiscard]] Result<void> open(const std::filesystem::path& file, scene::Simulation& simulation);

  private:
    scene::Recording recording_;
    bool recordingOn_ = false;
    bool replaying_ = false;
    double position_ = 0.0;
    std::vector<RigidTransform> shown_;
};

}  // namespace lutka::editor
