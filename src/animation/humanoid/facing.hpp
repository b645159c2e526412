#pragma once

#include <string>

#include "animation/humanoid/limb_candidates.hpp"
#include "animation/humanoid/trunk_candidates.hpp"

namespace lutka::animation {

/// Which way a figure faces, as log-odds of +z of its stance against -z.
struct Facing {
    float shape = 0.0F;       ///< From feet, knees, elbows, head and thumbs.
    float names = 0.0F;       ///< From left and right in the names, were they right.
    bool namesSplit = false;  ///< Names of the one pair of limbs call the other half left than those of the other pair.
    float prior = 0.0F;       ///< Most files face +Z.
    std::string reason;       ///< What spoke loudest.
    std::string shapeReason;  ///< What spoke loudest of the shape.

    [[nodiscard]] float total() const { return shape + names + prior; }
    /// Whether the names call the left half right.
    [[nodiscard]] bool namesDisagree() const { return names * total() < 0.0F; }
};

[[nodiscard]] Facing findFacing(const FramedRig& framed, const LimbCandidate& legs, const LimbCandidate& arms,
                                const TrunkCandidate& trunk);

}  // namespace lutka::animation
