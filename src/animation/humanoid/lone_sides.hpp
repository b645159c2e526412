#pragma once

#include "animation/humanoid/limb_candidates.hpp"

namespace lutka::animation {

/// Goes on with a limb whose pairs end early on the side that has more joints: where one arm is a stump, or ends in a
/// hook on one joint, the other keeps its forearm and hand. Fills LimbCandidate::lone.
void findLoneSides(const FramedRig& framed, LimbCandidate& limb);

}  // namespace lutka::animation
