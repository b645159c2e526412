#pragma once

namespace lutka {

/// The kinds of simple shapes that bodies, static geometry and drawn props are. A capsule lies along its own y, a plane
/// is its own y = 0 with the solid below, all but meshes are centred.
enum class ShapeKind { capsule, box, sphere, plane, mesh };

}  // namespace lutka
