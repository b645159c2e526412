#pragma once

#include <string>

#include "animation/humanoid/figure.hpp"

namespace lutka::animation {

/// Why this reading is no human figure, whatever its names say: the trunk lies, the hands stand on the ground, the arms
/// hang below the legs, the limbs are wings … Empty when nothing speaks against it.
[[nodiscard]] std::string refusalOf(const Figure& figure, const FramedRig& framed);

}  // namespace lutka::animation
