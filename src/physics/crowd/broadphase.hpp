#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Pairs of dolls whose bounds meet, at least one of them awake, by index: a sweep along x.
void sweepDolls(CrowdState& state, float dt);

}  // namespace lutka::physics::crowd
