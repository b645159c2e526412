#pragma once

#include <optional>

#include "animation/humanoid/framed_rig.hpp"

namespace lutka::animation {

/// The stance in which a figure would stand upright by its names alone, in whatever pose it is: up leads from the
/// thighs to the upper arms, and across from the right ones to the left.
///
/// Hips, head (or the end of a neck) and all three joints of each limb must have names that say so; of a limb that ends
/// earlier the joints that it has. Nothing otherwise, and nothing where a joint with skin is named as a tail.
[[nodiscard]] std::optional<Stance> stanceOfNames(const RigFeatures& rig);

}  // namespace lutka::animation
