#pragma once

#include <vector>

#include "animation/humanoid/completed_rig.hpp"

namespace lutka::animation {

/// The rig with both arms or both legs added in a human's proportions, where it has none at all and its names tell the
/// rest of a figure: hips, head or spine, and the other limbs. A bust, a ghost or a golem without legs, a walking post
/// box without arms. Empty where nothing is missing, names tell too little, or name an animal.
[[nodiscard]] std::vector<CompletedRig> imagineLimbs(const RigFeatures& rig);

}  // namespace lutka::animation
