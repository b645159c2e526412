#pragma once

#include <span>
#include <vector>

#include "animation/segments/appendages.hpp"
#include "physics/fit/body_plan.hpp"

namespace lutka::physics {

/// Which joints move a weapon (docs/creatures.md, "Appendages") that a humanoid's arm holds without a joint for the
/// hand and without a body of its own, or rigid meshes that a hand holds: their skin is not the arm's or the hand's.
/// Where its body has hardly any other, it is. One a joint of the skeleton.
[[nodiscard]] std::vector<bool> jointsOfHeldWeapons(const BodyPlan& plan, const animation::Character& character,
                                                    std::span<const animation::Appendage> appendages);

}  // namespace lutka::physics
