#pragma once

#include "core/rigid_transform.hpp"

namespace lutka::physics {

/// Position, orientation and velocities of one body in the world.
struct BodyState {
    RigidTransform worldFromBody;
    vec3 linearVelocity{0, 0, 0};   ///< m/s, of the centre of mass.
    vec3 angularVelocity{0, 0, 0};  ///< rad/s, world axes.
};

}  // namespace lutka::physics
