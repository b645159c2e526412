#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Brakes dolls that hardly move, and, where the world lets dolls sleep, puts those to rest that have been still for
/// long enough together with all that they touch.
void settle(CrowdState& state, float dt);

}  // namespace lutka::physics::crowd
