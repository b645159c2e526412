#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "physics/world/world.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::editor {

/// A point of a body that is drawn towards a point of the world.
struct Pull {
    int doll = 0;
    std::string body;         ///< Its name: it outlives a new fit.
    vec3 bodyPoint{0, 0, 0};  ///< In body space.
    vec3 target{0, 0, 0};     ///< World.
};

/// The pull of the mouse and the points that the user pinned. Kept apart from the world, so that both survive when the
/// simulation is made anew.
class Pulls {
  public:
    std::optional<Pull> mouse;
    std::vector<Pull> pins;

    /// Makes the world's drags these, beside the scene's own. Call before every step and when one has gone.
    void applyTo(scene::Simulation& simulation);
    /// The pin on that part of a doll; pins.end() when there is none.
    [[nodiscard]] std::vector<Pull>::iterator findPin(int doll, std::string_view body);

  private:
    // A drag of the world as it was asked for last.
    struct Applied {
        physics::DragId id;
        physics::Drag drag;
    };
    static void set(physics::World& world, Applied& pull, const std::optional<physics::Drag>& wanted);

    Applied appliedMouse_;
    std::vector<Applied> appliedPins_;  // in the order of `pins`
};

}  // namespace lutka::editor
