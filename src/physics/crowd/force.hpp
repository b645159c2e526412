#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// The force's impulse of a substep of `dt` s. Returns the work done, J.
double applyForce(CrowdState& state, const ForceRecord& record, float dt);

}  // namespace lutka::physics::crowd
