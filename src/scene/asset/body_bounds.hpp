#pragma once

#include "physics/profile/profile.hpp"

namespace lutka::scene {

/// Half the size of the axis-aligned box about a body's origin that holds its shape, in the frame that `rotation` turns
/// into.
[[nodiscard]] vec3 halfAabbOf(const physics::BodyShape& shape, const quat& rotation);

}  // namespace lutka::scene
