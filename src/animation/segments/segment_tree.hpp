#pragma once

#include <vector>

#include "animation/humanoid/rig_features.hpp"
#include "animation/segments/segment.hpp"

namespace lutka::animation {

/// Measures of a rig that decide where segments start.
struct RigMeasures {
    float size = 0.0F;         ///< Longest extent of the skin, else of the joints, metres.
    std::vector<float> reach;  ///< One a joint: to the furthest skin (else joint) at or below it, metres.
};
[[nodiscard]] RigMeasures measureRig(const RigFeatures& rig);

/// Segments in the order of the tree, with name, joint, parent and end; kinds and sides are not known yet. `shortest`:
/// metres; a segment is at least as long, and something at least as long hangs on its joint.
[[nodiscard]] std::vector<Segment> segmentTree(const RigFeatures& rig, const RigMeasures& measures,
                                               const std::vector<std::string>& names, float shortest);

/// The segments of one chain that hangs on something else: those at and below `top`.
[[nodiscard]] std::vector<Segment> segmentBranch(const RigFeatures& rig, const RigMeasures& measures,
                                                 const std::vector<std::string>& names, int top, float shortest);

}  // namespace lutka::animation
