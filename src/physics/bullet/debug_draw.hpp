#pragma once

#include <btBulletDynamicsCommon.h>

#include "physics/world/world.hpp"

namespace lutka::physics {

/// Lets Bullet draw its world by btIDebugDraw: shapes' wireframes coloured by activation, constraints and their limits,
/// contact points, bounding boxes. The world's own drawer, if any, stays.
void drawBulletDebug(btDiscreteDynamicsWorld& world, const World::DebugLineSink& line);

}  // namespace lutka::physics
