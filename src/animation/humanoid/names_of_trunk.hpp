#pragma once

#include "animation/humanoid/rig_features.hpp"

namespace lutka::animation {

/// Corrects what names say of the trunk by what hangs on it: hubs that are all called pelvis, a lower body above the
/// hips, a helmet in the head's place.
void readNamesOfTrunk(RigFeatures& rig);

}  // namespace lutka::animation
