#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Within a step, finds the contacts within limp dolls anew that do not follow their bodies by themselves, those of
/// boxes, hulls and further shapes: as far as these have moved, in the `seconds` since the step began, by so much that
/// it matters.
void refreshOwn(CrowdState& state, const Job& job, float seconds);

}  // namespace lutka::physics::crowd
