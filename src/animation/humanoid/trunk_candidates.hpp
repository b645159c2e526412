#pragma once

#include <array>
#include <vector>

#include "animation/humanoid/limb_candidates.hpp"

namespace lutka::animation {

/// The middle of a figure between given legs and arms.
struct TrunkCandidate {
    int hips = kNoJoint;
    int chest = kNoJoint;  ///< The topmost joint of the trunk; the hips themselves when the trunk is one joint.
    int neck = kNoJoint;   ///< The lowest neck; kNoJoint when there is none.
    int head = kNoJoint;   ///< kNoJoint when the rig has none.
    float names = 0.0F;    ///< The part of the score that comes from names.
    float missing = 0.0F;  ///< The part of the score that joints which are not there cost.
    float score = -1e9F;
};

/// A joint that must not take a place: how much worse the next best reading is tells how sure the best one is.
struct TrunkBan {
    int hips = -2;
    int chest = -2;
    int head = -2;
};

/// The best trunk between these limbs; score below -1e8 when no joint can be the hips.
[[nodiscard]] TrunkCandidate findTrunk(const FramedRig& framed, const LimbCandidate& legs, const LimbCandidate& arms,
                                       const TrunkBan& ban = {});

/// Joints of the spine strictly between hips and chest, from below, without helpers.
[[nodiscard]] std::vector<int> spineBetween(const FramedRig& framed, const TrunkCandidate& trunk,
                                            const LimbCandidate& legs, const LimbCandidate& arms);

}  // namespace lutka::animation
