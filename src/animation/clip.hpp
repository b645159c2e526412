#pragma once

#include <span>
#include <string>
#include <vector>

#include "animation/skeleton.hpp"

namespace lutka::animation {

/// An animation as poses at a fixed rate: `frameCount` poses of jointCount() parent-relative frames each.
///
/// Import resamples every channel to one rate, so that sampling is two reads and a blend; scale channels are baked
/// where they are constant and dropped, with a warning, where they are not.
struct Clip {
    std::string name;
    float framesPerSecond = 30.0F;                ///< > 0.
    int frameCount = 0;                           ///< >= 1. The clip lasts (frameCount - 1) / framesPerSecond seconds.
    std::vector<RigidTransform> parentFromJoint;  ///< frameCount × jointCount, frame after frame.

    [[nodiscard]] float seconds() const {
        return frameCount > 1 ? static_cast<float>(frameCount - 1) / framesPerSecond : 0.0F;
    }
};

/// The clip's pose at `seconds` (clamped to its length), parent-relative, into `parentFromJoint` (jointCount() long).
void sampleClip(const Clip& clip, float seconds, std::span<RigidTransform> parentFromJoint);

}  // namespace lutka::animation
