#pragma once

#include <functional>

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Runs the substeps of a step of `dt` s over all jobs. `afterSubstep`, when set, is called CrowdTuning::substeps times
/// at equal distances; a job that has fewer substeps is then where its last one ended. The results do not depend on
/// whether it is set.
void solveJobs(CrowdState& state, float dt, const std::function<void()>& afterSubstep);

/// Takes the contacts' impulses over into what the next step starts from.
void keepImpulses(CrowdState& state);

}  // namespace lutka::physics::crowd
