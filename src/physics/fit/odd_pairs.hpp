#pragma once

#include "physics/fit/body_plan.hpp"

namespace lutka::physics {

/// Finds, in a plan whose joints are symmetric, the pairs of a humanoid's parts whose skin is not:
/// PlannedBody::posedApart, and PlannedBody::holds with the tip that the other side has.
void findOddPairs(BodyPlan& plan);

}  // namespace lutka::physics
