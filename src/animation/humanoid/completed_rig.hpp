#pragma once

#include <vector>

#include "animation/humanoid/rig_features.hpp"

namespace lutka::animation {

/// A rig with mirror images of the limbs that only one of its sides has: where an arm or a leg is missing whole,
/// nothing pairs with the one that is there, and a figure cannot be read.
struct CompletedRig {
    RigFeatures rig;              ///< The joints of the rig, then the images.
    std::vector<int> originalOf;  ///< Per joint: what it is the image of; kNoJoint for joints of the rig.
    bool imagined = false;        ///< Made by imagineLimbs(): then an image's original is its image on the other side.

    [[nodiscard]] bool isImage(int joint) const { return originalOf[joint] != kNoJoint; }
    /// Whether these two are an image and its original, or no image at all.
    [[nodiscard]] bool isHonestPair(int a, int b) const {
        return (!isImage(a) && !isImage(b)) || originalOf[a] == b || originalOf[b] == a;
    }
};

/// The rig completed about each plane that may be its mirror plane, likeliest first; only where something was
/// completed. Where an arm and a leg of opposite sides are missing nothing tells the plane: those upright through the
/// trunk are tried.
[[nodiscard]] std::vector<CompletedRig> completeRig(const RigFeatures& rig);

}  // namespace lutka::animation
