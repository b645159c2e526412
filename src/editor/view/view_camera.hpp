#pragma once

#include "editor/states/workspace.hpp"

namespace lutka::editor {

/// Moves the view by itself: to what is selected, along an axis, with a doll. While it follows one
/// (Workspace::followed), eye and target go along with the hips, so that orbiting and zooming stay the user's.
class ViewCamera {
  public:
    explicit ViewCamera(Workspace& workspace) : workspace_(workspace) {}

    /// The scene's own view, a little farther off: bars lie over the picture's edges.
    void frameScene();
    /// The active item; without one the first doll.
    void focus();
    /// Looks that way at what it looks at; radians.
    void lookAlong(float yaw, float pitch);
    void toggleFollow();
    /// Once a frame.
    void follow();
    /// The view becomes that of a camera; nothing when it is none.
    void lookThrough(scene::EntityId camera);

  private:
    Workspace& workspace_;
    vec3 followedAt_{0, 0, 0};  // where the followed doll's hips were when the camera last moved
};

}  // namespace lutka::editor
