#pragma once

#include "animation/humanoid/limb_candidates.hpp"

namespace lutka::animation {

/// Where the skin at and below the last pair of a limb (else its joints) ends, in the stance, mean of both sides with
/// the second mirrored: as far down as a leg's goes, as far away as an arm's. Stands for the joint that a limb lacks
/// there. Where one arm is far longer than the other, and the shorter one is as long as an arm, a weapon is weighted to
/// the longer one: the shorter one tells. A side without skin and joints says nothing.
[[nodiscard]] vec3 endOfSkin(const FramedRig& framed, LimbKind kind, int first, int last);

/// How far joints with skin go on below a pair, mean of both sides.
[[nodiscard]] float reachBeyond(const FramedRig& framed, int pair);

}  // namespace lutka::animation
