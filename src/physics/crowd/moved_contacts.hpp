#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Within a step, finds the contacts between bodies anew that do not follow these by themselves, those of boxes, hulls
/// and further shapes: as far as the bodies have moved, in the `seconds` since the step began, by so much that it
/// matters.
void refreshMoved(CrowdState& state, const Job& job, float seconds);

}  // namespace lutka::physics::crowd
