#pragma once

#include <memory>

#include "physics/world/world.hpp"

namespace lutka::scene {

/// An empty world of the solver that the settings name. `stepsInOne`: each of its steps is to stand for so many and to
/// cost no more than one of them, with the crowd's substeps as much longer.
[[nodiscard]] std::unique_ptr<physics::World> makeWorld(const physics::WorldSettings& settings, int stepsInOne = 1);

}  // namespace lutka::scene
