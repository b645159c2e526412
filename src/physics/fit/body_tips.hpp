#pragma once

#include "physics/fit/body_plan.hpp"

namespace lutka::physics {

/// Sets `end` of the bodies that end at no joint (head, hands, feet, toes, cut limbs) from their skin, else from the
/// joints below them, else from proportions (head 0.12, hand 0.10, foot 0.13 of the height).
void findTips(BodyPlan& plan, const animation::Character& character, const animation::HumanoidMap& map);

/// The part of a body's skin that is the limb itself: without what hangs or is held far from the segment (weapons,
/// skirts, long hair).
[[nodiscard]] std::vector<SkinPoint> skinNearSegment(const BodyPlan& plan, const PlannedBody& body);

}  // namespace lutka::physics
