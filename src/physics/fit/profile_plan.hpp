#pragma once

#include <vector>

#include "animation/character.hpp"
#include "animation/humanoid/map_humanoid.hpp"
#include "physics/fit/body_plan.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// What the bodies of a profile stand for on a rig: by the map's joint where they have a role, else by their own joint,
/// with the lengths and sides that the profile tells. Roles and joints that the rig lacks are left out, so that the
/// plan may have fewer bodies than the profile. Bodies that are hulls are asked for as hulls.
[[nodiscard]] BodyPlan planOfProfile(const RagdollProfile& profile, const animation::Character& character,
                                     const animation::HumanoidMap& map);

/// The place of each body of the profile in such a plan; -1 for those left out.
[[nodiscard]] std::vector<int> placesInPlan(const RagdollProfile& profile, const BodyPlan& plan);

/// The joint that a body names, by its path, else by its name; kNoJoint when the skeleton lacks it.
[[nodiscard]] int jointOfBody(const BodyProfile& body, const animation::Skeleton& skeleton);

}  // namespace lutka::physics
