#pragma once

#include "physics/bullet/ragdoll.hpp"
#include "physics/world/world.hpp"

namespace lutka::physics {

/// Bullet's shape for static geometry, the body not yet made. A mesh stays the owner of its triangles and must outlive
/// it.
[[nodiscard]] BodyInWorld makeStaticShape(const StaticShape& shape);

}  // namespace lutka::physics
