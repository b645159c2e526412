#pragma once

#include "animation/humanoid/rig_features.hpp"

namespace lutka::animation {

/// Shifts the names of bones that are called by the joint at their end: "wrist" at the elbow, "ankle" at the knee. What
/// would be the hand or foot lies about halfway down its limb, and another one hangs on it; so the bones above are
/// shifted, too. Not where the joint above them starts the limb, nor where all parts have their names already.
void readNamesOfEnds(RigFeatures& rig);

/// Takes the last joint of a limb for its hand or foot where it is called as the forearm or shin above it, with another
/// number, and lies a whole bone beyond it: so Blender calls a bone that was drawn out of another and never named.
void readNumberedEnds(RigFeatures& rig);

}  // namespace lutka::animation
