#pragma once

#include "physics/profile/convex_hull.hpp"
#include "render/line_batch.hpp"
#include "render/solid_batch.hpp"

namespace lutka::scene {

/// The edges of a hull but for those between sides that are nearly one.
void addHull(render::LineBatch& lines, const RigidTransform& worldFromHull, const physics::ConvexHull& hull,
             render::Color color);
/// Its sides.
void addHull(render::SolidBatch& solids, const RigidTransform& worldFromHull, const physics::ConvexHull& hull,
             render::Color color);

}  // namespace lutka::scene
