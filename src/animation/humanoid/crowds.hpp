#pragma once

#include <optional>
#include <vector>

#include "animation/character.hpp"

namespace lutka::animation {

/// A character without the crowds of things beside it, and the joints that its own are of the whole one.
struct WithoutCrowds {
    Character character;        ///< Skeleton and meshes alone: what the mapper reads.
    std::vector<int> original;  ///< Per joint of `character`: its index in the whole skeleton. Ascending.
};

/// Hundreds of small parts side by side, without a skin and without a name of the body, are a room or a machine and no
/// limbs: time would grow with their square. Of thousands side by side no name makes a limb. `kept` names joints that
/// stay, whatever they are. Nothing where there is no such crowd.
[[nodiscard]] std::optional<WithoutCrowds> leaveOutCrowds(const Character& character, const std::vector<int>& kept);

}  // namespace lutka::animation
