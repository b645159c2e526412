#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Forgets the reports and the sums of the last step; call before the solving.
void beginReports(CrowdState& state);
/// Adds the impulses of a substep that was just solved.
void sumImpulses(CrowdState& state, const Job& job);
/// Call before a batch's static contacts are found anew within a step, and `openSums` after it.
void closeSums(const CrowdState& state, Batch& batch);
void openSums(Batch& batch);
/// Makes the step's reports of the sums.
void makeReports(CrowdState& state);

}  // namespace lutka::physics::crowd
