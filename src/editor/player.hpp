#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "editor/editor_document.hpp"
#include "scene/frame_loop.hpp"
#include "scene/simulation.hpp"

namespace lutka::editor {

/// Runs the document's scene in fixed steps, whatever the length of a frame, and follows the document's changes.
class Player {
  public:
    /// What becomes of the motion when the simulation is made anew.
    enum class Keep {
        nothing,  ///< From the scene's start.
        motion,   ///< Every doll goes on at its present pose, without a jump.
    };

    /// The document must outlive the player. `clock` as in scene::FrameLoop.
    explicit Player(EditorDocument& document, scene::FrameLoop::Clock clock = {})
        : document_(document), loop_({}, std::move(clock)) {}

    /// Makes the simulation anew from the document's state. When that fails the old one is gone: the document refuses
    /// what cannot be simulated, so this is ErrorCode::internal.
    [[nodiscard]] Result<void> rebuild(Keep keep);
    /// Whether the document has changed since the last rebuild().
    [[nodiscard]] bool stale() const { return simulation_ == nullptr || revision_ != document_.revision(); }

    /// Steps as often as `seconds` of wall time ask for, when playing.
    void advance(double seconds);
    /// One step, and pauses.
    void stepOnce();
    /// Back to the scene's start: the same bits as the first time.
    [[nodiscard]] Result<void> reset();

    [[nodiscard]] bool playing() const { return playing_; }
    void setPlaying(bool playing) { playing_ = playing; }
    /// Simulated time since the scene's start, edits in between included.
    [[nodiscard]] double seconds() const { return posing_ ? secondsBefore_ : secondsBefore_ + simulation_->seconds(); }
    /// Posing: the dolls move without gravity and heavily damped, so that pulls pose them through their constraints
    /// while the scene's time stands still. They rest where they are when it ends.
    [[nodiscard]] Result<void> setPosing(bool posing);
    /// Simulated seconds a second, (0, 1].
    [[nodiscard]] double speed() const { return speed_; }
    void setSpeed(double speed) { speed_ = speed; }

    /// Valid after the first rebuild() that succeeded.
    [[nodiscard]] scene::Simulation& simulation() { return *simulation_; }
    [[nodiscard]] const scene::Simulation& simulation() const { return *simulation_; }
    /// Where between the last two states the picture is, [0, 1].
    [[nodiscard]] float alpha() const { return loop_.alpha(); }
    /// How well the steps keep up with the clock.
    [[nodiscard]] const scene::FrameLoop& loop() const { return loop_; }

    /// Where an object of the document is now: balls roll, everything else stands where the document has it.
    [[nodiscard]] RigidTransform worldFromObject(int object) const;
    /// The document's objects, each where it is now.
    [[nodiscard]] std::vector<SceneObject> presentObjects() const;

    /// The bodies of a doll, and back: they stay where they are put until the next step.
    [[nodiscard]] std::vector<physics::BodyState> bodiesOf(int doll) const;
    void placeBodies(int doll, std::span<const physics::BodyState> bodies);
    /// Shows a doll's bodies elsewhere than they are, until endPreview(); the world does not know.
    void preview(int doll, std::span<const RigidTransform> worldFromBody);
    void endPreview() { simulation_->refresh(); }
    /// Throws a ball into the running scene; it is not part of the document.
    [[nodiscard]] Result<void> throwBall(const vec3& from, const vec3& velocity);

  private:
    struct Motion;
    [[nodiscard]] Motion capture() const;
    void dampDolls(float share);
    void restore(const Motion& motion);
    void keepProps(const Motion& motion, scene::Scenario& scenario) const;
    void placeByJoints(std::span<const physics::BodyProfile> oldBodies, std::span<const physics::BodyState> oldStates,
                       std::span<const RigidTransform> modelFromJoint, const RigidTransform& worldFromModel,
                       std::span<physics::BodyState> bodies) const;
    [[nodiscard]] Result<scene::Scenario> makeScenario();

    EditorDocument& document_;
    std::unique_ptr<scene::Simulation> simulation_;
    std::vector<SceneObject> built_;            ///< The document's objects as of the last rebuild.
    int firstBall_ = 0;                         ///< The scenario's own props come before the document's balls …
    std::vector<physics::DynamicProp> thrown_;  ///< … and what was thrown after them.
    std::uint64_t revision_ = 0;
    bool playing_ = true;
    double speed_ = 1.0;
    bool posing_ = false;
    double secondsBefore_ = 0.0;  ///< Of the simulations before the present one.
    scene::FrameLoop loop_;
};

}  // namespace lutka::editor
