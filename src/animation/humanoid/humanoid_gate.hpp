#pragma once

#include <string>

#include "animation/humanoid/figure.hpp"

namespace lutka::animation {

/// Mean of the angles from straight up of the way from the hips to the arms' roots and of that to the head, radians.
[[nodiscard]] float trunkTilt(const Figure& figure, const FramedRig& framed);

/// Why this reading is no human figure, whatever its names say: the trunk lies, the hands stand on the ground, the arms
/// hang below the legs, the limbs are wings … Empty when nothing speaks against it.
[[nodiscard]] std::string refusalOf(const Figure& figure, const FramedRig& framed);

}  // namespace lutka::animation
