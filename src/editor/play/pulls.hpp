#pragma once

#include <optional>
#include <vector>

#include "physics/world/world.hpp"

namespace lutka::editor {

/// A point of a body that is drawn towards a point of the world.
struct Pull {
    int doll = 0;
    animation::Role role = animation::Role::hips;  ///< Of the body: it outlives a new fit.
    vec3 bodyPoint{0, 0, 0};                       ///< In body space.
    vec3 target{0, 0, 0};                          ///< World.
};

/// The pull of the mouse and the points that the user pinned. Kept apart from the world, so that both survive when the
/// simulation is made anew.
class Pulls {
  public:
    std::optional<Pull> mouse;
    std::vector<Pull> pins;

    /// Makes the world's drags these, exactly. Call before every step and when one has gone.
    void applyTo(physics::World& world);
    /// The pin on that part of a doll; pins.end() when there is none.
    [[nodiscard]] std::vector<Pull>::iterator findPin(int doll, animation::Role role);

  private:
    static constexpr int kMouseId = 1;
    static constexpr int kFirstPinId = 2;
    static constexpr int kMaxPins = 900;  // the scenes' own pins have ids from 1000

    int applied_ = 0;  // pins that the world had last
};

}  // namespace lutka::editor
