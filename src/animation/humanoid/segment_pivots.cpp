#include "animation/humanoid/segment_pivots.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "animation/humanoid/name_lexicon.hpp"

namespace lutka::animation {
namespace {

// "arm_twist" beside "arm_stretch": a twist joint of the same part.
bool isTwistOf(const NameEvidence& name, const NameEvidence& half) {
    bool twist = false;
    bool samePart = false;
    for (const std::string& word : name.words) {
        const auto meaning = conceptOf(word);
        if (!meaning) continue;
        const bool shared = std::find(half.words.begin(), half.words.end(), word) != half.words.end();
        if (*meaning == Concept::twist) twist = true;
        if (*meaning != Concept::twist && *meaning != Concept::noise && shared) samePart = true;
    }
    return twist && samePart && name.side == half.side;
}

// The twist joint that lies as far before `half` as the next joint of the limb lies behind it, in one line. In a
// flattened rig, where the limb's next joint does not hang on `half`, it hangs anywhere.
int pivotBefore(const RigFeatures& rig, int half, int next) {
    constexpr float kLeastShare = 0.3F;
    constexpr float kMostShare = 0.7F;
    constexpr float kOffLine = 0.1F;  // of the segment
    if (next == kNoJoint) return kNoJoint;
    for (int other = 0; other < rig.count(); ++other) {
        if (other == half || !rig.children[other].empty() || !rig.carriesSkin(other)) continue;
        if (!isTwistOf(rig.names[other], rig.names[half])) continue;
        const bool flat = !rig.isAncestorOrSelf(half, next) && !rig.isAncestorOrSelf(half, other);
        if (rig.parents[other] != rig.parents[half] && !flat) continue;
        const vec3 along = rig.positions[next] - rig.positions[other];
        const vec3 away = rig.positions[half] - rig.positions[other];
        const float square = glm::dot(along, along);
        if (square <= 0.0F) continue;
        const float share = glm::dot(away, along) / square;
        const bool inLine = glm::length(away - share * along) < kOffLine * std::sqrt(square);
        if (inLine && share > kLeastShare && share < kMostShare) return other;
    }
    return kNoJoint;
}

}  // namespace

void bindSegmentPivots(const RigFeatures& rig, HumanoidMap& map) {
    for (const auto& [start, next] :
         {std::pair(Role::leftUpperArm, Role::leftLowerArm), std::pair(Role::leftUpperLeg, Role::leftLowerLeg)}) {
        if (!map[start] || !map[mirrored(start)]) continue;
        const int left = pivotBefore(rig, map.jointOf(start), map.jointOf(next));
        const int right = pivotBefore(rig, map.jointOf(mirrored(start)), map.jointOf(mirrored(next)));
        if (left == kNoJoint || right == kNoJoint) continue;
        for (const auto& [role, joint] : {std::pair(start, left), std::pair(mirrored(start), right)}) {
            RoleBinding& binding = *map.roles[indexOf(role)];
            binding.joint = joint;
            binding.reason += ", at its pivot: the joint beside it lies halfway down";
        }
    }
}

}  // namespace lutka::animation
