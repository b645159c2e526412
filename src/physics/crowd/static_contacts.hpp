#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// For when static contacts are looked for.
struct StaticSearch {
    float seconds;               ///< That lie ahead, within which planes are met.
    float substep;               ///< Seconds, within which other geometry is met.
    bool keepsPressing = false;  ///< Whether what was kept of the dolls' contacts stays even where it is not found: the
                                 ///< bodies are where they were then.
};

/// The static contacts of one batch, with the impulses that its dolls' contacts were kept with. Needs the bounds of its
/// dolls.
void findStatics(CrowdState& state, Batch& batch, const Topology& topology, const StaticSearch& search);

/// Whether a body, as it moves now, will be inside static geometry at the substep's end where no contact of the last
/// search holds it: something has turned it since.
[[nodiscard]] bool straysIntoStatics(const CrowdState& state, const Batch& batch, const Topology& topology,
                                     float substep);

}  // namespace lutka::physics::crowd
