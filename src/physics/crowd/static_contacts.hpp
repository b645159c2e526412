#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// The static contacts of one batch for the next `dt` s, with the impulses that its dolls' contacts were kept with.
/// Needs the bounds of its dolls.
void findStatics(CrowdState& state, Batch& batch, const Topology& topology, float dt, float substep);

/// Whether a body, as it moves now, will be inside static geometry at the substep's end where no contact of the last
/// search holds it: something has turned it since.
[[nodiscard]] bool straysIntoStatics(const CrowdState& state, const Batch& batch, const Topology& topology,
                                     float substep);

}  // namespace lutka::physics::crowd
