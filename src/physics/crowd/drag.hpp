#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Puts all pulls into the lanes of their dolls, for a step of `dt` s. Call it after makeJobs().
void placeDrags(CrowdState& state, float dt);

/// Before and after a substep's velocities are solved: the work that the pull has done on the doll, joules, is returned
/// by the latter.
void beginDrag(CrowdState& state, DragRecord& record);
[[nodiscard]] double endDrag(CrowdState& state, DragRecord& record);

}  // namespace lutka::physics::crowd
