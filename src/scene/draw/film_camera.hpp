#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/camera.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::scene {

/// The view of a picture or a film of a simulation:
/// 1. the scene's own camera, where it has one;
/// 2. a view that goes along with the dolls, where the scene's focus follows them;
/// 3. the scene's focus from its side (SceneSimulation::focusYaw).
///
/// A view that goes along shows a standing figure a little less than half as high as the picture. It comes nearer to a
/// single doll that lies, and shows all of several dolls.
class FilmCamera {
  public:
    /// `aspect`: width : height of the picture.
    FilmCamera(const Scenario& scenario, float aspect);

    /// Follows this doll alone, whatever the scene says, and fills the picture with it.
    void followDoll(int doll);
    /// Keeps this distance to what it looks at, metres, > 0.
    void keepDistance(float distance);
    /// Before each picture: `seconds` since the one before, 0 or less for the first, which shows the dolls in its
    /// middle. `alpha` as in Simulation::pose.
    void update(Simulation& simulation, float alpha, float seconds);

    render::Camera camera;

  private:
    void follow(Simulation& simulation, float alpha, float seconds);
    void followAlone(Simulation& simulation, float alpha, float seconds);
    // Goes so much of the way to where all points have room as it needs to show them.
    void keepAllIn(std::span<const vec3> points, const vec3& target, float distance);

    float aspect_;
    bool following_ = false;
    std::optional<int> alone_;  // the doll that is followed and fills the picture
    bool keepsDistance_ = false;
    bool begun_ = false;
    std::vector<vec3> points_;
};

}  // namespace lutka::scene
