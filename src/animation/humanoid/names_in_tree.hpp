#pragma once

#include "animation/humanoid/rig_features.hpp"

namespace lutka::animation {

/// Settles what names mean by those of their neighbours in the tree: a shoulder above an arm is the clavicle, "wrist"
/// at the elbow the forearm, the third "foot" in a chain the foot. Needs positions, tree, weights and names.
void readNamesInTree(RigFeatures& rig);

}  // namespace lutka::animation
