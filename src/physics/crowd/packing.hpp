#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Packs the contacts of each part of each job (see partTouches()) into blocks of lanes in which no body comes twice.
void packTouches(CrowdState& state);

}  // namespace lutka::physics::crowd
