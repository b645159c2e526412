#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "physics/bullet/solver_rows.hpp"

namespace lutka::physics {

/// Angular momentum about their centre of mass, kg m²/s, that bodies have as a substep begins: what is written in them,
/// and what forces on them give in `seconds`.
[[nodiscard]] glm::dvec3 momentumBefore(std::span<const SolverBody> bodies, float seconds);

/// Turns all of the bodies together so that they have this angular momentum once they were moved. To be asked of bodies
/// that nothing else held in the substep. The sweeps push joints at arms of the substep's start while anchors turn on,
/// and mending pulls them together again: without this a doll that tumbles at 7 rad/s loses 7 % in two seconds.
void restoreMomentum(std::span<const SolverBody> bodies, const glm::dvec3& momentum);

}  // namespace lutka::physics
