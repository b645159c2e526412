#pragma once

#include <vector>

#include "animation/humanoid/framed_rig.hpp"

namespace lutka::animation {

/// Flattened rigs hang the joints of the face on the root: they belong to what is nearest to them. Per joint how many
/// do, of faces at least as high as `lowest` (y of the stance) that hang on what carries `armRoot`, or on nothing;
/// `central` are the joints of the figure's middle.
[[nodiscard]] std::vector<int> countStrayFaces(const FramedRig& framed, const std::vector<int>& central, int armRoot,
                                               float lowest);

}  // namespace lutka::animation
