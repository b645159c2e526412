#pragma once

#include "physics/world/world.hpp"

namespace lutka::scene {

/// What a solver does where physics::WorldSettings leave it the choice: substeps, iterations and damping, all set.
/// `stock` has no such choice and is told as `bullet`.
struct SolverDefaults {
    int substeps = 1;             ///< Of a step.
    int iterations = 1;           ///< Passes a substep at most.
    float linearDamping = 0.0F;   ///< Share of the speed that is lost in a second, [0, 1).
    float angularDamping = 0.0F;  ///< The same for turning.
};
[[nodiscard]] SolverDefaults solverDefaults(physics::SolverKind solver);

}  // namespace lutka::scene
