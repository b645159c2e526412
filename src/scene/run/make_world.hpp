#pragma once

#include <memory>

#include "physics/world/world.hpp"

namespace lutka::scene {

/// An empty world of the solver that the settings name.
[[nodiscard]] std::unique_ptr<physics::World> makeWorld(const physics::WorldSettings& settings);

}  // namespace lutka::scene
