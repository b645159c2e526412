#pragma once

#include <vector>

#include "core/random.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::test {

/// A hand-made ragdoll of makeBiped(): 16 bodies with a man's masses (75 kg), hinges at knees and elbows, cones
/// elsewhere; the bind pose lies inside all limits. Its joint names are makeBiped()'s.
[[nodiscard]] physics::RagdollProfile makeDoll();

/// Two capsules of `massKg` each, hung together end to end along x by one constraint at the origin: the parent reaches
/// from -0.4 m to the anchor, the child to +0.4 m. Frames are the world's axes; no friction.
[[nodiscard]] physics::RagdollProfile makePair(const physics::ConeTwistLimits& limits, float massKg = 2.0F);
[[nodiscard]] physics::RagdollProfile makePair(const physics::HingeLimits& limits, float massKg = 2.0F);

/// `count` points of an ellipsoid's surface, half axes `half` about the origin, in directions drawn evenly.
[[nodiscard]] std::vector<vec3> pointsOnEllipsoid(const vec3& half, int count, Random& random);

}  // namespace lutka::test
