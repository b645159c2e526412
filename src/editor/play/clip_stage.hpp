#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::editor {

/// A clip of the file on one doll, which is put where the clip has it while physics stands still.
class ClipStage {
  public:
    /// Fails with ErrorCode::usage when the doll's character has no such clip.
    [[nodiscard]] static Result<ClipStage> create(const scene::Simulation& simulation, int doll,
                                                  const std::string& clip);

    [[nodiscard]] const std::string& clip() const { return start_.clip; }
    [[nodiscard]] int doll() const { return doll_; }
    [[nodiscard]] float seconds() const { return start_.seconds; }
    [[nodiscard]] float length() const { return length_; }
    /// Clamped to the clip.
    void seek(float seconds);
    /// Goes on; past the end it begins anew, or, without `loop`, stays there.
    void advance(float seconds);
    [[nodiscard]] bool atEnd() const { return !loop && start_.seconds >= length_; }
    /// Finds its doll in another simulation; whether there is one. Call it before anything else there.
    [[nodiscard]] bool follow(const scene::Simulation& simulation);
    /// Puts the doll into the clip's pose, with the velocities that the clip has there.
    void place(scene::Simulation& simulation) const;
    /// Where it was before the clip was shown.
    void placeBack(scene::Simulation& simulation) const;
    /// The same as states of its present bodies; nothing where one of them was not there then.
    [[nodiscard]] std::optional<std::vector<physics::BodyState>> before(const scene::Simulation& simulation) const;
    /// The other clip in place of this one, from its start; the doll still goes back to where it was at first.
    void takeOver(const ClipStage& before) {
        before_ = before.before_;
        bodies_ = before.bodies_;
        loop = before.loop;
    }

    bool loop = true;

  private:
    ClipStage() = default;
    void findPlace(const scene::Simulation& simulation);

    scene::ClipStart start_;
    int doll_ = 0;
    scene::EntityId entity_ = 0;     // the doll's: its number changes with the scene
    RigidTransform worldFromModel_;  // where it stands in the present simulation
    float length_ = 0.0F;
    std::vector<physics::BodyState> before_;
    std::vector<physics::BodyProfile> bodies_;  // whose states these are
};

}  // namespace lutka::editor
