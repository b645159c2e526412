#pragma once

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
    /// Undoes (below 0) or redoes so many changes at once, what moved in the scene included.
    void travel(int changes);

  private:
    Workspace& workspace_;
};

}  // namespace lutka::editor
