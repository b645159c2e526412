#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "animation/character.hpp"

namespace lutka::animation {

/// A character without the crowds of things beside it, and the joints that its own are of the whole one.
struct WithoutCrowds {
    Character character;        ///< Skeleton and meshes alone: what the mapper reads.
    std::vector<int> original;  ///< Per joint of `character`: its index in the whole skeleton. Ascending.

    /// Of a joint of the whole skeleton: its index in `character`, kNoJoint where it was left out.
    [[nodiscard]] int placeOf(int joint) const;
    /// Of a joint of `character`: its index in the whole skeleton; kNoJoint of kNoJoint.
    [[nodiscard]] int originalOf(int joint) const {
        return joint == kNoJoint ? kNoJoint : original[static_cast<std::size_t>(joint)];
    }
};

/// Hundreds of small parts side by side, without a skin and without a name of the body, are a room or a machine and no
/// limbs: time would grow with their square. Among thousands side by side only the names of limbs, head and hips count.
/// Those, and chains of three nodes, stay where no more than 256 of the crowd are such. `kept` names joints that stay,
/// whatever they are. Names count for nothing without `useNames`. Crowds that hang on crowds go as well, so that
/// nothing is left of them to ask for once more. Nothing where there is no such crowd.
[[nodiscard]] std::optional<WithoutCrowds> leaveOutCrowds(const Character& character, const std::vector<int>& kept,
                                                          bool useNames = true);

}  // namespace lutka::animation
