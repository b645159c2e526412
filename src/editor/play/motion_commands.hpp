#pragma once

#include "editor/play/limit_swing.hpp"
#include "editor/states/workspace.hpp"

namespace lutka::editor {

/// What the user does to what runs, each as an entry of undo, and the way along these entries. What is under way in the
/// view must have ended.
class MotionCommands {
  public:
    explicit MotionCommands(Workspace& workspace) : workspace_(workspace) {}

    /// The document asks for what runs before it changes; once for each document.
    void listen();
    /// The scene from its start.
    void reset();
    /// The same as part of a change that undo knows already.
    void restart();
    void returnToPlay();
    /// Towards what the mouse points at.
    void throwBall();
    void stepOnce();
    /// Swings the joint of the active body through its limits, for the eye only.
    void swingLimits();
    void endSwing();
    [[nodiscard]] const LimitSwing* swing() const { return swing_ ? &*swing_ : nullptr; }
    /// Goes on with the swing; false: none is under way.
    bool advanceSwing(double seconds);
    /// Shows the clips of the active doll's file, or no longer: then the doll is where it was before.
    void toggleClips(bool& shown);
    /// Another clip, from its start, on the active doll or the one that shows a clip already.
    void showClip(const std::string& clip);
    /// Physics goes on from the clip that is shown, as an entry of undo; nothing without one.
    void fallFromClip();
    /// Muscles for who lies to get up, and then to follow the clip that is shown.
    [[nodiscard]] scene::ScenePuppets gettingUp() const;
    /// Muscles for characters that had none. Once time has passed they get up: the player lets who had none go on limp,
    /// for that once, while the scene's runs begin on their feet.
    [[nodiscard]] scene::ScenePuppets firstMuscles() const;
    /// What the hit tool does at the body under the mouse.
    void hit(const Pick& pick);
    /// The bodies that are not selected are held where they are, or, when some are held, let go.
    void toggleSelectedOnly();
    /// Undoes (below 0) or redoes so many changes at once, what moved in the scene included.
    void travel(int changes);

  private:
    [[nodiscard]] int activeDoll() const;

    Workspace& workspace_;
    std::optional<LimitSwing> swing_;
    int swingDoll_ = 0;
    std::shared_ptr<const PlayState> beforeClip_;
};

}  // namespace lutka::editor
