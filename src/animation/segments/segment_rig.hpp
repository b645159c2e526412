#pragma once

#include <string>
#include <vector>

#include "animation/character.hpp"
#include "animation/segments/segment.hpp"

namespace lutka::animation {

struct SegmentOptions {
    int mostSegments = 40;  ///< In [1, 256]; a finer rig has its shortest parts merged until it keeps to this.
};

/// A rig of any kind parted into what rigid bodies can stand for.
struct SegmentedRig {
    std::vector<Segment> segments;       ///< Parents first; at least one. Of two counterparts the left one comes first.
    quat standardFromModel{1, 0, 0, 0};  ///< As in HumanoidMap, as far as the rig tells its front.
    std::vector<std::string> warnings;
};

/// Parts a rig by its tree, joint lengths and skin weights (docs/creatures.md): the root is where all skin hangs
/// together; a joint starts a segment where it is far enough from the one above and enough hangs on it; twist joints,
/// faces and joints too short for a body belong to the segment above. Sides by a mirror plane and by names, hinges by
/// what the clips do. Never fails: a rig of one joint is one segment.
[[nodiscard]] SegmentedRig segmentRig(const Character& character, const SegmentOptions& options = {});

}  // namespace lutka::animation
