#pragma once

namespace lutka {

/// The kinds of simple shapes that bodies, static geometry and drawn props are. A capsule lies along its own y, a plane
/// is its own y = 0 with the solid below, all but meshes are centred: a convex hull on the middle of its volume.
enum class ShapeKind { capsule, box, sphere, hull, plane, mesh };

}  // namespace lutka
