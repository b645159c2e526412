#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "editor/document/editor_document.hpp"
#include "editor/play/clip_stage.hpp"
#include "editor/play/held_bodies.hpp"
#include "editor/play/motion.hpp"
#include "editor/play/recording_deck.hpp"
#include "editor/view/picking.hpp"
#include "scene/run/frame_loop.hpp"
#include "scene/run/simulation.hpp"
#include "scene/run/substep_governor.hpp"

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
    explicit Player(EditorDocument& document, scene::FrameLoop::Clock clock = {});
    Player(const Player&) = delete;
    Player& operator=(const Player&) = delete;

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
    /// Grows whenever something moved by itself or was put elsewhere: the same number is the same motion.
    [[nodiscard]] std::uint64_t moment() const { return moment_; }
    /// What runs now, without the pins, which are not the player's. For undo; see restore().
    [[nodiscard]] PlayState state() const;
    /// Goes back to a state; the document should be as it was then, and who has gone since is left out. Fails as
    /// rebuild() does.
    [[nodiscard]] Result<void> restore(const PlayState& state);

    /// From pause to play: the present state is what returnToPlay() goes back to.
    void setPlaying(bool playing);
    [[nodiscard]] bool canReturnToPlay() const { return atPlay_.has_value(); }
    /// Every doll and prop where it was when Play was pressed last, and pauses.
    void returnToPlay();
    /// Simulated time since the scene's start, edits in between included.
    [[nodiscard]] double seconds() const { return posing_ ? secondsBefore_ : secondsBefore_ + simulation_->seconds(); }
    /// Posing: the dolls move without gravity and heavily damped, so that pulls pose them through their constraints
    /// while the scene's time stands still. They rest where they are when it ends.
    [[nodiscard]] Result<void> setPosing(bool posing);
    /// Only these bodies move; all others of the dolls that the panels edit are held where they are, through edits and
    /// a reset as well. Who comes in later moves.
    void simulateOnly(std::span<const Item> bodies);
    void simulateAll() { held_.letGo(); }
    [[nodiscard]] const HeldBodies& held() const { return held_; }
    /// Shows a clip on a doll in place of the simulation; playing plays it, and a step is one of its own. Fails as
    /// ClipStage does.
    [[nodiscard]] Result<void> showClip(const std::string& clip, int doll);
    [[nodiscard]] const ClipStage* clip() const { return stage_ ? &*stage_ : nullptr; }
    void seekClip(float seconds);
    void setClipLoop(bool loop) { stage_->loop = loop; }  ///< While a clip is shown.
    /// Physics goes on from the clip's pose and velocities, or, with `back`, from where the doll was before.
    void endClip(bool back);
    /// An impulse, N s, at a world point of a body that there is; a puppet reacts to it. Not during a replay.
    void hit(const Item& body, const vec3& point, const vec3& impulse);
    /// Simulated seconds a second, (0, 1].
    [[nodiscard]] double speed() const { return speed_; }
    void setSpeed(double speed) { speed_ = speed; }

    /// Valid after the first rebuild() that succeeded.
    [[nodiscard]] scene::Simulation& simulation() { return *simulation_; }
    [[nodiscard]] const scene::Simulation& simulation() const { return *simulation_; }
    /// Whether substeps are spared while the machine is late (scene::SubstepGovernor); needs the constructor's clock.
    void setSparing(bool sparing) { sparing_ = sparing; }
    [[nodiscard]] bool sparing() const { return sparing_; }
    /// Where between the last two states the picture is, [0, 1].
    [[nodiscard]] float alpha() const { return loop_.alpha(); }
    /// How well the steps keep up with the clock.
    [[nodiscard]] const scene::FrameLoop& loop() const { return loop_; }

    /// Where an entity is now: what rolls or falls is where the simulation has it (a character: its first body's middle
    /// with the start's rotation), everything else stands where the document has it.
    [[nodiscard]] RigidTransform worldFromEntity(scene::EntityId id) const;
    /// The doll of a character; -1: none.
    [[nodiscard]] int dollOf(scene::EntityId id) const;
    /// The entity that a doll is.
    [[nodiscard]] scene::EntityId entityOfDoll(int doll) const { return simulation_->scenario().dollEntities[doll]; }
    /// Whether the document's own character, whose bodies the panels edit, is this doll's.
    [[nodiscard]] bool isEditedDoll(int doll) const { return simulation_->scenario().dolls[doll].asset == 0; }

    /// The bodies of a doll, and back: they stay where they are put until the next step.
    [[nodiscard]] std::vector<physics::BodyState> bodiesOf(int doll) const;
    void placeBodies(int doll, std::span<const physics::BodyState> bodies);
    /// Shows a doll's bodies elsewhere than they are, until endPreview(); the world does not know.
    void preview(int doll, std::span<const RigidTransform> worldFromBody);
    void endPreview() { simulation_->refresh(); }
    /// Throws a ball into the running scene; it is not part of the document.
    [[nodiscard]] Result<void> throwBall(const vec3& from, const vec3& velocity);

    /// What is recorded and replayed; during a replay the physics stands still. A change of the scene ends both.
    [[nodiscard]] const RecordingDeck& deck() const { return deck_; }
    /// What the user has to be told since the last call; empty: nothing.
    [[nodiscard]] std::string takeNews() {
        return refusal_.empty() ? deck_.takeNews() : std::exchange(refusal_, std::string());
    }
    void startRecording();
    void stopRecording() { deck_.stop(); }
    /// The takes themselves: their names, which of them is meant, what is removed.
    [[nodiscard]] RecordingDeck& deck() { return deck_; }
    /// Takes of a player that gives way to this one.
    void takeOver(RecordingDeck&& deck) {
        deck.stop("another character was opened");
        deck_ = std::move(deck);
    }
    /// Shows the current take with the balls that were thrown in it. Fails as RecordingDeck::replay() does.
    [[nodiscard]] Result<void> replay();
    void endReplay();
    void scrubTo(double seconds) { deck_.scrubTo(seconds, *simulation_); }
    /// Opens and replays it; fails as RecordingDeck::open() does.
    [[nodiscard]] Result<void> openRecording(const std::filesystem::path& file);

  private:
    /// A motion that the ragdoll's present bodies could not take over as it was, for when they can again.
    struct Memory {
        std::uint64_t moment = 0;
        Motion motion;
    };
    /// Where held bodies are held in a simulation that is made anew.
    enum class Hold {
        whereHeld,  ///< Where they were held before; those of a doll that is placed anew, where they are.
        here,       ///< All where they are.
    };
    void advanceReplay(double seconds);
    [[nodiscard]] Motion capture() const;
    void dampDolls(float share);
    /// The simulation anew from the document, its dolls and props where `motion` has them, if any: those that start as
    /// before, or, with `all`, every one.
    [[nodiscard]] Result<void> build(const Motion* motion, bool all, Hold hold = Hold::whereHeld);
    void restore(const Motion& motion, bool all);
    void keepProps(const Motion& motion, bool all, scene::Scenario& scenario) const;
    [[nodiscard]] bool startsAsBefore(scene::EntityId id) const;
    void placeByJoints(int doll, std::span<const physics::BodyProfile> oldBodies,
                       std::span<const physics::BodyState> oldStates, std::span<const RigidTransform> modelFromJoint,
                       const RigidTransform& worldFromModel, std::span<physics::BodyState> bodies) const;
    [[nodiscard]] bool suits(const Motion& motion) const;
    void remember(const Motion& motion);
    void takeReplayBallsAway();
    void step();
    void holdHere();
    void moveClip(float seconds);
    [[nodiscard]] const Motion* remembered() const;
    [[nodiscard]] Result<scene::Scenario> makeScenario();
    void somethingMoved() { moment_ = ++lastMoment_; }

    EditorDocument& document_;
    std::unique_ptr<scene::Simulation> simulation_;
    HeldBodies held_;  ///< After the simulation that it pulls in.
    std::optional<ClipStage> stage_;
    scene::EntityScene built_;                  ///< The document's scene as of the last rebuild.
    std::vector<physics::DynamicProp> thrown_;  ///< After the scene's own props.
    std::size_t thrownForReplay_ = 0;           ///< The last of these, which are in play during a replay only.
    std::optional<Motion> atPlay_;
    std::vector<Memory> memories_;
    std::uint64_t moment_ = 0;
    std::uint64_t lastMoment_ = 0;
    RecordingDeck deck_;
    std::string refusal_;  ///< Why the characters don't follow their clip.
    std::uint64_t revision_ = 0;
    bool playing_ = true;
    double speed_ = 1.0;
    bool posing_ = false;
    double secondsBefore_ = 0.0;  ///< Of the simulations before the present one.
    scene::FrameLoop loop_;
    bool sparing_ = false;
    std::optional<scene::SubstepGovernor> governor_;  ///< Of the present simulation.
};

}  // namespace lutka::editor
