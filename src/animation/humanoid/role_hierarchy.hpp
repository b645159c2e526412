#pragma once

#include <span>

#include "animation/humanoid/map_humanoid.hpp"

namespace lutka::animation {

/// Where a role's joint hangs in the file, against the joint of a role above it.
enum class Hanging {
    below,    ///< Below it, as it should.
    beside,   ///< Elsewhere, but on no other limb: feet under a control root, flat trees.
    astray,   ///< Below a joint that plays a part of another limb: a hand on the other arm, a head on a hand.
    reversed  ///< Above it.
};

/// Both roles have a joint in the map, and not the same one. `parents` are the skeleton's, parents before children.
/// Arms that hang on the neck are below the chest (so 3ds Max's Biped has it).
[[nodiscard]] Hanging hangingOf(const HumanoidMap& map, std::span<const int> parents, Role role, Role above);

/// Whether most roles' joints hang beside those of the roles above them: a flat hierarchy, which says nothing about
/// single joints.
[[nodiscard]] bool hangsFlat(const HumanoidMap& map, std::span<const int> parents);

}  // namespace lutka::animation
