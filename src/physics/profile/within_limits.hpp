#pragma once

#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// The rotation of the child body in the parent body that is nearest to `parentFromChild` within `share` (0, 1] of the
/// constraint's limits: of a hinge in its angle, what lies across it being left out; of a cone in swing and in twist.
/// Continuous but at half a turn; what lies within a cone comes back as it is.
[[nodiscard]] quat withinLimits(const ConstraintProfile& constraint, const quat& parentFromChild, float share = 1.0F);

}  // namespace lutka::physics
