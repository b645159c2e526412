#pragma once

#include "animation/humanoid/rig_features.hpp"

namespace lutka::animation {

/// Whether the figure has a tail that moves skin: by its name, or a chain without names behind thighs that have some.
[[nodiscard]] bool hasTail(const RigFeatures& rig);

}  // namespace lutka::animation
