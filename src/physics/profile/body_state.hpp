#pragma once

#include "core/rigid_transform.hpp"

namespace lutka::physics {

/// Position, orientation and velocities of one body in the world.
struct BodyState {
    RigidTransform worldFromBody;
    vec3 linearVelocity{0, 0, 0};   ///< m/s, of the centre of mass.
    vec3 angularVelocity{0, 0, 0};  ///< rad/s, world axes.
};

using lutka::isFinite;  // of vectors and rotations, beside that of a body

/// No number of it is infinite or not a number.
[[nodiscard]] inline bool isFinite(const BodyState& state) {
    return isFinite(state.worldFromBody) && isFinite(state.linearVelocity) && isFinite(state.angularVelocity);
}

}  // namespace lutka::physics
