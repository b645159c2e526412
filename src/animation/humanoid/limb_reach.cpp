#include "animation/humanoid/limb_reach.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

namespace lutka::animation {

vec3 endOfSkin(const FramedRig& framed, LimbKind kind, int first, int last) {
    constexpr float kFarLonger = 1.3F;
    constexpr float kArm = 0.35F;  // of the shoulders' height: as long as an arm
    const vec3 from = framed.pairs[last].position;
    std::array<vec3, 2> ends{from, from};
    std::array<bool, 2> isThere{false, false};
    for (std::size_t side = 0; side < ends.size(); ++side) {
        const int joint = framed.pairs[last].joints[side];
        const bool skin = framed.subtreeSkin[joint].count > 0;
        const Box& box = skin ? framed.subtreeSkin[joint] : framed.subtreeJoints[joint];
        if (box.count == 0) continue;
        isThere[side] = true;
        const vec3 mean = box.mean();
        const float out = side == 0 ? box.high.x : -box.low.x;
        const bool hangs = kind == LimbKind::leg || from.y - box.low.y > out - from.x;
        ends[side] = hangs ? vec3(std::abs(mean.x), box.low.y, mean.z) : vec3(out, mean.y, mean.z);
    }
    if (isThere[0] != isThere[1]) return isThere[0] ? ends[0] : ends[1];
    const float before = first != last ? framed.segment(first, last) : 0.0F;
    const auto lengthTo = [&](const vec3& end) { return before + glm::distance(from, end); };
    const auto& [shorter, longer] =
        lengthTo(ends[0]) < lengthTo(ends[1]) ? std::tie(ends[0], ends[1]) : std::tie(ends[1], ends[0]);
    const float least = kArm * (framed.pairs[first].position.y - framed.floor);
    const bool armed =
        kind == LimbKind::arm && lengthTo(shorter) > least && lengthTo(longer) > kFarLonger * lengthTo(shorter);
    return armed ? shorter : 0.5F * (ends[0] + ends[1]);
}

float reachBeyond(const FramedRig& framed, int pair) {
    float reach = 0.0F;
    const RigFeatures& rig = *framed.rig;
    for (const int joint : framed.pairs[pair].joints) {
        float farthestJoint = 0.0F;
        for (int other = 0; other < rig.count(); ++other) {
            if (!rig.isAncestorOrSelf(joint, other) || (rig.skinned && rig.ownWeight[other] <= 0.0F)) continue;
            farthestJoint = std::max(farthestJoint, glm::distance(framed.positions[joint], framed.positions[other]));
        }
        reach += 0.5F * farthestJoint;
    }
    return reach;
}

}  // namespace lutka::animation
