#pragma once

#include "animation/humanoid/map_humanoid.hpp"
#include "animation/humanoid/rig_features.hpp"

namespace lutka::animation {

/// Some rigs have two joints side by side for one upper arm or thigh: Auto-Rig Pro's "arm_twist" stands at the shoulder
/// and "arm_stretch" halfway down. The mapper takes the one with the forearm below it. This gives the role to the one
/// at the pivot, on both sides or on none.
void bindSegmentPivots(const RigFeatures& rig, HumanoidMap& map);

}  // namespace lutka::animation
