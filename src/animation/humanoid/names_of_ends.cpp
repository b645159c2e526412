#include "animation/humanoid/names_of_ends.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace lutka::animation {
namespace {

// Whether a joint of that side, or one above it, is surely called one of the two parts.
bool tellsLimb(const RigFeatures& rig, int joint, Side side, Part upper, Part middle) {
    for (; joint != kNoJoint && rig.names[joint].side == side; joint = rig.parents[joint]) {
        const PartScores& parts = rig.names[joint].parts;
        if (parts[upper] >= kTellsSurely || parts[middle] >= kTellsSurely) return true;
    }
    return false;
}

// Whether a shoulder or hip is where the limb starts, no clavicle: about as far from the next joint as that is from the
// one after it (`length`), and farther from its other side, as clavicles never are.
bool startsLimb(const RigFeatures& rig, int top, int next, float length) {
    constexpr float kAsLong = 0.7F;
    if (top == kNoJoint || rig.names[top].side != rig.names[next].side) return false;
    const float bone = glm::distance(rig.positions[top], rig.positions[next]);
    if (bone < kAsLong * length) return false;
    for (int other = 0; other < rig.count(); ++other) {
        const bool isPartner = rig.names[other].words == rig.names[top].words &&
                               rig.names[other].numbers == rig.names[top].numbers &&
                               rig.names[other].side == otherSide(rig.names[top].side);
        if (isPartner && glm::distance(rig.positions[top], rig.positions[other]) > bone) return true;
    }
    return false;
}

// Whether a joint on the same limb, other than `end`, is called a hand or foot.
bool hasNamedEnd(const RigFeatures& rig, int middle, int end, Part part) {
    for (int joint = 0; joint < rig.count(); ++joint) {
        const NameEvidence& name = rig.names[joint];
        if (joint == end || name.side != rig.names[middle].side || name.helper || name.parts[part] <= 0.0F) continue;
        if (rig.isAncestorOrSelf(middle, joint)) return true;
    }
    return false;
}

}  // namespace

void readNumberedEnds(RigFeatures& rig) {
    constexpr float kAsLong = 0.7F;  // of the bone above: the half of a bone is shorter
    for (int end = 0; end < rig.count(); ++end) {
        const int middle = rig.parents[end];
        const int upper = middle == kNoJoint ? kNoJoint : rig.parents[middle];
        if (upper == kNoJoint || !rig.children[end].empty() || !rig.carriesSkin(end)) continue;
        const NameEvidence& name = rig.names[end];
        if (name.helper || name.side == Side::center || name.side != rig.names[middle].side) continue;
        if (name.words != rig.names[middle].words || name.numbers == rig.names[middle].numbers) continue;
        const float length = glm::distance(rig.positions[middle], rig.positions[end]);
        if (length < kAsLong * glm::distance(rig.positions[upper], rig.positions[middle])) continue;
        for (const auto& [part, of] : {std::pair{Part::hand, Part::lowerArm}, std::pair{Part::foot, Part::lowerLeg}}) {
            if (rig.names[middle].parts[of] < kTellsSurely || hasNamedEnd(rig, middle, end, part)) continue;
            std::swap(rig.names[end].parts[part], rig.names[end].parts[of]);
        }
    }
}

void readNamesOfEnds(RigFeatures& rig) {
    constexpr float kHalfway = 0.8F;  // of the way from the joint above
    constexpr float kMaybe = 2.0F;    // a name's score
    constexpr float kSurelyNot = -2.5F;
    struct Limb {
        Part upper, middle, end;
    };
    const auto rename = [&](int joint, Part from, Part to) {
        rig.names[joint].parts[from] = kSurelyNot;
        rig.names[joint].parts[to] = kTellsSurely;
    };
    for (const Limb& limb :
         {Limb{Part::upperArm, Part::lowerArm, Part::hand}, Limb{Part::upperLeg, Part::lowerLeg, Part::foot}}) {
        for (int joint = 0; joint < rig.count(); ++joint) {
            const int parent = rig.parents[joint];
            if (parent == kNoJoint || rig.names[joint].parts[limb.end] < kTellsSurely) continue;
            const Side side = rig.names[joint].side;
            if (rig.names[parent].side != side) continue;
            const PartScores& above = rig.names[parent].parts;
            const bool middleAbove = above[limb.middle] >= kTellsSurely;
            if (!middleAbove && above[limb.upper] < kMaybe) continue;
            const int top = rig.parents[parent];
            // All parts have their names already: a wrist in the middle of the forearm only turns with it.
            if (middleAbove && tellsLimb(rig, top, side, limb.upper, limb.middle)) continue;
            const float length = glm::distance(rig.positions[parent], rig.positions[joint]);
            const auto goesOn = [&](int child) {
                return rig.names[child].parts[limb.end] >= kTellsSurely && rig.names[child].side == side &&
                       rig.carriesSkin(child) &&
                       glm::distance(rig.positions[joint], rig.positions[child]) > kHalfway * length;
            };
            if (std::none_of(rig.children[joint].begin(), rig.children[joint].end(), goesOn)) continue;
            if (middleAbove && startsLimb(rig, top, parent, length)) continue;
            rename(joint, limb.end, limb.middle);
            if (!middleAbove) continue;
            rename(parent, limb.middle, limb.upper);
            if (top != kNoJoint && rig.names[top].parts[Part::clavicle] >= kMaybe && limb.end == Part::hand)
                rename(top, Part::upperArm, Part::clavicle);
        }
    }
}

}  // namespace lutka::animation
