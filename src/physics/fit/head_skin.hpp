#pragma once

#include <span>
#include <vector>

#include "animation/segments/appendages.hpp"
#include "physics/fit/body_plan.hpp"

namespace lutka::physics {

/// Which joints carry what hangs on a humanoid's head without a body of its own: twin tails, hats, long ears. One a
/// joint of the skeleton.
[[nodiscard]] std::vector<bool> jointsHangingOnHead(const BodyPlan& plan, const animation::Character& character,
                                                    std::span<const animation::Appendage> appendages);

/// Gives the head what hangs on it, which counts to the figure's height.
void hangOnHead(BodyPlan& plan, const std::vector<SkinPoint>& hanging);

/// Settles which skin tells the head's shape, after hangOnHead(). What hangs on it does only where hardly any
/// skin is left without; skin of the body below (and so of the neck) that lies beyond the head's joint
/// does where it is more than the head's own.
void settleHeadSkin(BodyPlan& plan, const std::vector<SkinPoint>& hanging);

}  // namespace lutka::physics
