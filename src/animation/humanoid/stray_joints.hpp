#pragma once

#include "animation/humanoid/map_humanoid.hpp"
#include "animation/humanoid/rig_features.hpp"

namespace lutka::animation {

/// Binds parts of limbs that have no joint yet, by name alone: a forearm that was parented to the other arm by mistake
/// is still the forearm. There must be exactly one joint on that side that has the name and moves skin. Where the other
/// side has the part, the distance to the joint above must be about the same on both. `confidence` is that of such a
/// binding. The doctor has a finding for joints with a wrong parent.
void bindStrayJoints(const RigFeatures& rig, float confidence, HumanoidMap& map);

}  // namespace lutka::animation
