#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Splits the step into jobs (batches that touch each other) and packs each job's contacts between bodies into blocks
/// of lanes in which no body comes twice.
void makeJobs(CrowdState& state);

}  // namespace lutka::physics::crowd
