#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// This substep's arm, mass and error of a drag; applies what it carries from the substep before. Both return the
/// work done on the body, joules.
double beginDrag(CrowdState& state, DragRecord& record);
/// One pass: a damped spring whose force is bounded.
double solveDrag(CrowdState& state, DragRecord& record, float dt);

}  // namespace lutka::physics::crowd
