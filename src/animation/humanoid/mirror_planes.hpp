#pragma once

#include <vector>

#include "animation/humanoid/rig_features.hpp"

namespace lutka::animation {

/// A plane that may part the figure into left and right halves: dot(p, normal) = offset.
struct MirrorPlane {
    vec3 normal;      ///< Unit length; the sign means nothing yet.
    float offset;     ///< Model units.
    vec3 middle;      ///< A point of it amid the pairs that it was found by.
    float agreement;  ///< [0, 1], how much of the joint tree is its own mirror image.
};

/// The likeliest planes, best first, at most three. They come from pairs of joints that hang alike from a common
/// ancestor or whose names differ only in the side, so that they are found in any orientation; empty without such
/// pairs.
[[nodiscard]] std::vector<MirrorPlane> findMirrorPlanes(const RigFeatures& rig);

}  // namespace lutka::animation
