#pragma once

#include "editor/states/workspace.hpp"

namespace lutka::editor {

/// Moves the view by itself: to what is selected, along an axis, with a doll. While it follows one
/// (Workspace::followed), eye and target go along with the hips, so that orbiting and zooming stay the user's.
class ViewCamera {
  public:
    explicit ViewCamera(Workspace& workspace) : workspace_(workspace) {}

    /// The scene's own camera; without one all of the scene from its side. Framed like that the view goes along with
    /// the size of the window and what covers it, until the user moves it.
    void frameScene();
    /// The active item; without one all of the scene.
    void focus();
    /// Looks that way at what it looks at; radians.
    void lookAlong(float yaw, float pitch);
    /// Of the selected doll, or the first: keeps it where it is seen, or takes it into the middle when it is not.
    void toggleFollow();
    /// Once a frame.
    void follow();
    /// The view becomes that of a camera; nothing when it is none.
    void lookThrough(scene::EntityId camera);

  private:
    /// What a view was made to show.
    struct Framed {
        std::vector<vec3> points;
        render::Camera camera;
        render::Extent window;
        render::PictureInsets covered;
    };
    void frame(std::vector<vec3> points);
    void frameAgain();
    [[nodiscard]] std::vector<vec3> pointsOfAll() const;
    // Not behind panels, bars or the eye.
    [[nodiscard]] bool seesFreely(const vec3& point) const;

    Workspace& workspace_;
    std::optional<Framed> framed_;
    vec3 followedAt_{0, 0, 0};  // where the followed doll's hips were when the camera last moved
};

}  // namespace lutka::editor
