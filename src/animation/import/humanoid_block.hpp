#pragma once

#include <map>
#include <optional>
#include <string>

#include "animation/skeleton.hpp"

namespace lutka::animation::rig_import {

/// What of a file's own humanoid map (Character::vrmHumanoid) the skeleton's bind pose speaks against, for people:
/// limbs whose joints do not hang on each other, legs above the arms, or left and right against where the toes point.
/// Nothing where the map may be right.
[[nodiscard]] std::optional<std::string> contradictionIn(const std::map<std::string, int>& roles,
                                                         const Skeleton& skeleton);

}  // namespace lutka::animation::rig_import
