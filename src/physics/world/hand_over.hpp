#pragma once

#include "physics/world/world.hpp"

namespace lutka::physics {

/// Takes a doll out of one world and puts it into another as it is: bodies with their velocities, filter, motors, drags
/// (whose ids must not be in use there), sleep and the time it has rested. Between steps, at any time, between any
/// solvers; what the solver remembers of its impulses stays behind, so that the first step there starts cold. Returns
/// the doll's index in `to`; in `from` the later ones go down by one.
int moveDoll(World& from, int doll, World& to);

}  // namespace lutka::physics
