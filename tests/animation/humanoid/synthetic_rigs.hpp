#pragma once

#include <string>
#include <vector>

#include "animation/character.hpp"
#include "zoo_scoring.hpp"

namespace lutka::test {

/// A rig made by hand after a naming convention, with what is right for each of its roles.
struct SyntheticRig {
    animation::Character character;
    Truth truth;
};

/// Lengths of a figure, as factors of a generic man's.
struct Build {
    float arms = 1.0F;
    float legs = 1.0F;
    float trunk = 1.0F;
    float head = 1.0F;
    float shoulders = 1.0F;  ///< Half width from the middle to the upper arms.
    float armsDown = 0.0F;   ///< Radians that the arms are lowered from the T-pose.
    float elbows = 0.1F;     ///< Radians that the elbows are bent forwards.
};

/// Names of all conventions that there are.
[[nodiscard]] std::vector<std::string> syntheticConventions();

[[nodiscard]] SyntheticRig makeSyntheticRig(const std::string& convention, const Build& build = {});

/// Adds chains that no role belongs to: hair, skirt, tail, wings. All carry some skin.
void addAccessories(SyntheticRig& rig, std::uint64_t seed);

}  // namespace lutka::test
