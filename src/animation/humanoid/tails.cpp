#include "animation/humanoid/tails.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace lutka::animation {
namespace {

constexpr float kTellsThigh = 1.5F;  // a name's score from which it says which part of a limb this is
constexpr float kTellsHead = 2.0F;   // … or that it is the head

// Of avatars that could have one the joints are there, and move nothing.
bool namesTail(const RigFeatures& rig) {
    for (int joint = 0; joint < rig.count(); ++joint) {
        if (rig.names[joint].tail && rig.carriesSkin(joint)) return true;
    }
    return false;
}

// The joint below which a chain without names goes on farthest, in so many joints.
struct Chain {
    int end;
    int joints;
};

Chain namelessChain(const RigFeatures& rig, int top) {
    Chain chain{top, 1};
    const auto goesOn = [&](int child) { return !rig.names[child].meaningful && rig.carriesSkin(child); };
    while (true) {
        const std::vector<int>& below = rig.children[chain.end];
        const auto next = std::find_if(below.begin(), below.end(), goesOn);
        if (next == below.end()) return chain;
        chain = {*next, chain.joints + 1};
    }
}

// A tail without a name: a chain in the middle, as long as much of a leg, that hangs on what carries the thighs and
// carries neither arm nor head. A dinosaur whose limbs have a man's names.
bool trailsChain(const RigFeatures& rig) {
    constexpr int kFewest = 4;
    constexpr float kLeastReach = 0.6F;  // of the leg
    constexpr float kMostAside = 0.15F;  // of the leg, nearer to one thigh than to the other
    const int left = rig.namedJoint(Part::upperLeg, Side::left, kTellsThigh);
    const int right = rig.namedJoint(Part::upperLeg, Side::right, kTellsThigh);
    const int shin = rig.namedJoint(Part::lowerLeg, Side::left, kTellsThigh);
    if (!rig.skinned || left == kNoJoint || right == kNoJoint || shin == kNoJoint) return false;
    const int carrier = rig.commonAncestor(left, right);
    if (carrier == kNoJoint) return false;
    const float leg = 2.0F * glm::distance(rig.positions[left], rig.positions[shin]);
    return std::any_of(rig.children[carrier].begin(), rig.children[carrier].end(), [&](int top) {
        if (rig.names[top].meaningful || rig.isAncestorOrSelf(top, left) || rig.isAncestorOrSelf(top, right))
            return false;
        for (int joint = 0; joint < rig.count(); ++joint) {
            const PartScores& parts = rig.names[joint].parts;
            const bool other = parts[Part::upperArm] >= kTellsThigh || parts[Part::head] >= kTellsHead;
            if (other && rig.isAncestorOrSelf(top, joint)) return false;
        }
        const Chain chain = namelessChain(rig, top);
        const float toLeft = glm::distance(rig.positions[chain.end], rig.positions[left]);
        const float toRight = glm::distance(rig.positions[chain.end], rig.positions[right]);
        return chain.joints >= kFewest && std::min(toLeft, toRight) > kLeastReach * leg &&
               std::abs(toLeft - toRight) < kMostAside * leg;
    });
}

}  // namespace

bool hasTail(const RigFeatures& rig) {
    return namesTail(rig) || trailsChain(rig);
}

}  // namespace lutka::animation
