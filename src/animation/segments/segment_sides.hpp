#pragma once

#include <vector>

#include "animation/humanoid/rig_features.hpp"
#include "animation/segments/segment.hpp"

namespace lutka::animation {

/// Finds the creature's front and mirror plane, pairs its segments (mirror, side) and tells their kinds. The order
/// stays. Pairs are found by place, then by names that differ in the side alone. Returns standardFromModel: +Y stays
/// up; the front is where head, neck and jaw are against tail and hips, else +Z.
quat findSides(const RigFeatures& rig, float size, std::vector<Segment>& segments);

/// Finds the counterparts alone, in a stance that is known: `middle` is the x of the mirror plane in its axes.
void pairSegments(const RigFeatures& rig, float size, const quat& standardFromModel, float middle,
                  std::vector<Segment>& segments);

/// Puts left ones before right ones and parents before children; indices follow.
void orderSegments(std::vector<Segment>& segments);

}  // namespace lutka::animation
