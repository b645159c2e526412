#pragma once

#include "animation/humanoid/map_humanoid.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// The profile with its trunk bodies under the trunk roles that the map has: spine, chest and upperChest stand in for
/// one another, the topmost for the topmost. Trunk bodies beyond the number of the rig's trunk joints are merged into
/// the body below them, with their mass and their children.
/// Shapes and frames are left to rebindProfile(). A profile whose trunk fits comes back as it is.
[[nodiscard]] RagdollProfile adaptTrunk(RagdollProfile profile, const animation::HumanoidMap& map);

}  // namespace lutka::physics
