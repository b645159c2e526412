#pragma once

#include "animation/humanoid/figure.hpp"
#include "animation/humanoid/map_humanoid.hpp"

namespace lutka::animation {

/// The map that a figure makes: left and right by its facing, the trunk's roles by its length, a confidence from each
/// place's margin over the next best reading and a reason in words. `rig` is what the figure was read of, without
/// images (CompletedRig): those get no role.
[[nodiscard]] HumanoidMap assembleRoles(const Figure& figure, const RigFeatures& rig);

}  // namespace lutka::animation
