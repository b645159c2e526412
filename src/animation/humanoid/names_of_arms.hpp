#pragma once

#include "animation/humanoid/rig_features.hpp"

namespace lutka::animation {

/// Reads "shoulder, arm, hand" as upper arm, forearm and hand where the shoulder is no clavicle by its place and
/// length.
void readShouldersAsArms(RigFeatures& rig);

}  // namespace lutka::animation
