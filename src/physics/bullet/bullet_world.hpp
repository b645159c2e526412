#pragma once

#include <memory>

#include "physics/world.hpp"

namespace lutka::physics {

/// A Bullet world behind the World interface. SolverKind::stock is a plain btDiscreteDynamicsWorld with Bullet's own
/// defaults, the baseline of every ratio; SolverKind::bullet has our settings (docs/physics.md).
[[nodiscard]] std::unique_ptr<World> createBulletWorld(const WorldSettings& settings);

}  // namespace lutka::physics
