#pragma once

#include <string>
#include <vector>

#include "animation/character.hpp"
#include "animation/humanoid/map_humanoid.hpp"

namespace lutka::test {

/// A joint of a hand-made rig: its bind position in model space (metres), identity rotation.
struct JointSpec {
    std::string name;
    int parent;
    vec3 position;
};

/// A skeleton whose bind and node poses agree.
[[nodiscard]] animation::Skeleton makeSkeleton(const std::vector<JointSpec>& joints);

/// A standing 1.75 m figure in T-pose facing +Z with the 20 joints of `biped()` and a box-limbed skin: what unit tests
/// use where a real model would hide the answer.
[[nodiscard]] animation::Character makeBiped();

/// The map of makeBiped(), exact.
[[nodiscard]] animation::HumanoidMap mapOfBiped(const animation::Character& biped);

}  // namespace lutka::test
