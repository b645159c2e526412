#pragma once

#include <vector>

#include "animation/character.hpp"

namespace lutka::animation {

/// What hangs on the joints of a character, an entry a joint.
struct CarryingJoints {
    std::vector<bool> skin;   ///< It moves a part of a skin: a vertex has a weight above 0 there.
    std::vector<bool> rigid;  ///< It carries a mesh that has no skin: the node of a part.
};

[[nodiscard]] CarryingJoints carryingJoints(const Character& character);

}  // namespace lutka::animation
