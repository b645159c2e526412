#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Puts all pulls into the lanes of their dolls, for a step of `dt` s. Call it after makeJobs().
void placeDrags(CrowdState& state, float dt);

/// What a pull did in a substep.
struct DragDeed {
    double work = 0.0;      ///< On the doll, joules.
    vec3 impulse{0, 0, 0};  ///< N s
};
/// Before and after a substep's velocities are solved.
void beginDrag(CrowdState& state, DragRecord& record);
[[nodiscard]] DragDeed endDrag(CrowdState& state, DragRecord& record);

}  // namespace lutka::physics::crowd
