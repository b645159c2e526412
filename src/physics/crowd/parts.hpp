#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Orders the contacts between bodies of each job by parts (Job::parts), within those by whether they are likely to
/// press, which come first.
///
/// A job that is split over the threads is cut into slabs across the axis along which its contacts spread farthest. A
/// contact belongs to the slab of whichever of its bodies comes first along it, and a slab is so wide that no contact
/// reaches across all of it. So only neighbours share bodies: every other part can be worked on at the same time. The
/// cuts do not depend on the number of threads. Any other job is one part.
void partTouches(CrowdState& state);

}  // namespace lutka::physics::crowd
