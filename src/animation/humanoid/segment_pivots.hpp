#pragma once

#include "animation/humanoid/map_humanoid.hpp"
#include "animation/humanoid/rig_features.hpp"

namespace lutka::animation {

/// Where upper arms or thighs are two joints side by side (Auto-Rig Pro's "arm_twist" at the shoulder and "arm_stretch"
/// halfway down), the half that goes on is read as the limb's start. Gives the role to the half at the pivot, on both
/// sides or on none.
void bindSegmentPivots(const RigFeatures& rig, HumanoidMap& map);

}  // namespace lutka::animation
