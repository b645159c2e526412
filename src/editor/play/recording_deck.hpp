#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "scene/run/recording.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::editor {

/// What was recorded from one press of Record to its end.
struct Take {
    /// Who was in it, in the order of its frames: dolls, the scene's props, then balls that were thrown.
    struct Cast {
        std::vector<scene::EntityId> dolls;
        std::vector<scene::EntityId> props;
        std::size_t thrown = 0;
    };

    std::string name;
    scene::Recording recording;
    Cast cast;
    std::vector<int> dollSince;  ///< The step at which each doll came in; empty: all were there from the first.
    std::vector<int> propSince;  ///< Likewise the props and balls.
    bool saved = false;

    /// From the first to the last step that was kept.
    [[nodiscard]] double seconds() const;
};

/// Keeps the bodies of a simulation's steps as takes and shows them again. It either keeps or shows, never both. A take
/// stays until remove(). Every call takes the simulation, which may be another one each time: what comes in while a
/// take is recorded becomes part of it, and what goes away ends it.
class RecordingDeck {
  public:
    static constexpr int kMostSteps = 36000;  ///< Ten minutes; recording ends there.

    /// Begins a take with the present state; a replay must have been ended.
    void start(scene::Simulation& simulation);
    /// After every step of the simulation.
    void keepStep(scene::Simulation& simulation);
    /// Ends the take; `why`, when the user did not ask for it: see takeNews().
    void stop(const std::string& why = "");
    [[nodiscard]] bool recording() const { return recordingOn_; }
    /// A sentence for the user about a take that ended by itself, once; else empty.
    [[nodiscard]] std::string takeNews() { return std::exchange(news_, {}); }

    [[nodiscard]] std::span<const Take> takes() const { return takes_; }
    /// The take that the calls below are about: the last one that was recorded, opened or chosen; -1: none.
    [[nodiscard]] int current() const { return current_; }
    [[nodiscard]] std::string currentName() const { return current_ < 0 ? "" : takes_[current_].name; }
    /// Not while it keeps or shows.
    void choose(int take);
    void rename(int take, std::string name);
    void remove(int take);
    [[nodiscard]] bool anyUnsaved() const;
    [[nodiscard]] int steps() const { return current_ < 0 ? 0 : takes_[current_].recording.steps(); }
    /// 0 without a take.
    [[nodiscard]] double seconds() const { return current_ < 0 ? 0.0 : takes_[current_].seconds(); }

    /// Shows the first step: of the simulation whoever is in the take, and at any moment only those that had come in by
    /// then. Fails with ErrorCode::usage when nothing is kept, or nobody of the take is in the simulation.
    [[nodiscard]] Result<void> replay(scene::Simulation& simulation);
    /// Ends showing; the caller shows the simulation's own state again.
    void endReplay(scene::Simulation& simulation);
    [[nodiscard]] bool replaying() const { return replaying_; }
    /// How many of the take are not in the simulation that it is shown with.
    [[nodiscard]] int missing() const { return missing_; }
    /// Where the replay is, [0, seconds()].
    [[nodiscard]] double position() const { return position_; }
    [[nodiscard]] bool atEnd() const { return position_ >= seconds(); }
    /// Shows the state at that time, between two steps their mean; outside of the recording its nearest end.
    void scrubTo(double seconds, scene::Simulation& simulation);
    void showNextStep(scene::Simulation& simulation);

    /// The current take; who comes in midway waits in the file where it comes in. Fails with ErrorCode::usage when
    /// nothing is kept, and as scene::saveRecording() does.
    [[nodiscard]] Result<void> save(const std::filesystem::path& file) const;
    void markSaved();
    /// Opens it as a take and replays that; fails as loadRecording() and replay() do, with what was kept before.
    [[nodiscard]] Result<void> open(const std::filesystem::path& file, scene::Simulation& simulation);

  private:
    [[nodiscard]] bool fitInto(Take& take, const scene::Simulation& simulation) const;
    void matchParts(const Take& take, const scene::Simulation& simulation);

    std::vector<Take> takes_;
    int current_ = -1;
    int numbered_ = 0;  // takes begun so far
    bool recordingOn_ = false;
    bool replaying_ = false;
    double position_ = 0.0;
    std::string news_;
    // Of the simulation's dolls and props during a replay: which of the take they are; -1: none of it.
    std::vector<int> dollOfTake_;
    std::vector<int> propOfTake_;
    int missing_ = 0;
    std::vector<RigidTransform> shown_;
};

}  // namespace lutka::editor
