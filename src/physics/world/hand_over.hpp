#pragma once

#include <vector>

#include "physics/world/world.hpp"

namespace lutka::physics {

/// What a doll and its drags are called in the world that they moved to; unset ids where it was refused.
struct MovedDoll {
    DollId doll;
    std::vector<DragId> drags;  ///< In the order of the old world's dragsOf().
};

/// Takes a doll out of one world and puts it into another as it is: bodies with their velocities, filter, motors,
/// drags, sleep and the time it has rested. Between steps, at any time, between any solvers; what the solver remembers
/// of its impulses stays behind, so that the first step there starts cold. The old ids are of nothing afterwards.
MovedDoll moveDoll(World& from, DollId doll, World& to);

}  // namespace lutka::physics
