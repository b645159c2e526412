#pragma once

#include <glm/geometric.hpp>

#include "physics/profile/body_state.hpp"

namespace lutka::physics {

/// Half m v² plus half w·I·w, joules; `inertia` holds the principal moments about the body's axes, kg m².
[[nodiscard]] inline double kineticEnergy(const BodyState& state, float massKg, const vec3& inertia) {
    const vec3 turn = glm::conjugate(state.worldFromBody.rotation) * state.angularVelocity;
    return 0.5 * static_cast<double>(massKg * glm::dot(state.linearVelocity, state.linearVelocity) +
                                     glm::dot(inertia, turn * turn));
}

}  // namespace lutka::physics
