#pragma once

#include "animation/humanoid/map_humanoid.hpp"
#include "animation/humanoid/rig_features.hpp"

namespace lutka::animation {

/// Binds parts of limbs that no joint in its right place plays, where exactly one joint of that side is named so and
/// moves skin, however it hangs: a forearm that was hung on the other arm by mistake is still the forearm. Where the
/// other side has the part, the joint is about as far from the one above it as over there. `confidence` is that of
/// such a binding. The doctor tells of those that hang astray.
void bindStrayJoints(const RigFeatures& rig, float confidence, HumanoidMap& map);

}  // namespace lutka::animation
