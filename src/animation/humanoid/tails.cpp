#include "animation/humanoid/tails.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace lutka::animation {
namespace {

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

// How the legs stand, by the joints that names tell.
struct NamedLegs {
    vec3 start{0.0F};  // between the thighs
    vec3 down{0.0F};   // along both
    vec3 front{0.0F};  // across them: where the toes point, or without any where the knees bend; 0 where neither tells
};

// A side whose shin has no name tells nothing.
NamedLegs namedLegs(const RigFeatures& rig, int leftThigh, int rightThigh) {
    constexpr float kLeastBend = 0.02F;  // of the leg
    NamedLegs legs;
    legs.start = 0.5F * (rig.positions[leftThigh] + rig.positions[rightThigh]);
    vec3 bend(0.0F);
    vec3 toesFromFeet(0.0F);
    for (const Side side : {Side::left, Side::right}) {
        const auto named = [&](Part part) { return rig.namedJoint(part, side, kTellsPartOfLimb); };
        const int thigh = side == Side::left ? leftThigh : rightThigh;
        const int shin = named(Part::lowerLeg);
        if (shin == kNoJoint) continue;
        const int foot = named(Part::foot);
        const int toes = named(Part::toes);
        const int end = foot != kNoJoint ? foot : shin;
        legs.down += rig.positions[end] - rig.positions[thigh];
        bend += rig.positions[shin] - 0.5F * (rig.positions[thigh] + rig.positions[end]);
        if (foot != kNoJoint && toes != kNoJoint) toesFromFeet += rig.positions[toes] - rig.positions[foot];
    }
    const float length = glm::length(legs.down);
    if (length <= 0.0F) return legs;
    legs.down /= length;
    for (const vec3& way : {toesFromFeet, bend}) {
        const vec3 across = way - glm::dot(way, legs.down) * legs.down;
        if (glm::length(across) <= kLeastBend * length) continue;
        legs.front = glm::normalize(across);
        break;
    }
    return legs;
}

// A coat's back or a sash hangs down beside the legs, or lies on what one kneels on.
bool leadsBehind(const NamedLegs& legs, const vec3& end) {
    constexpr float kBehind = 0.8F;  // cosine
    const vec3 way = end - legs.start;
    const float length = glm::length(way);
    if (glm::length(legs.front) > 0.0F) return glm::dot(way, legs.front) < -kBehind * length;
    return std::abs(glm::dot(way, legs.down)) < std::sqrt(1.0F - kBehind * kBehind) * length;
}

// A tail without a name: a chain in the middle, as long as much of a leg, that hangs on what carries the thighs, leads
// away behind and carries neither arm nor head. A dinosaur whose limbs have a man's names.
bool trailsChain(const RigFeatures& rig) {
    constexpr int kFewest = 4;
    constexpr float kShortest = 0.6F;    // of the leg
    constexpr float kMostAside = 0.15F;  // of the leg, nearer to one thigh than to the other
    const int left = rig.namedJoint(Part::upperLeg, Side::left, kTellsPartOfLimb);
    const int right = rig.namedJoint(Part::upperLeg, Side::right, kTellsPartOfLimb);
    const int shin = rig.namedJoint(Part::lowerLeg, Side::left, kTellsPartOfLimb);
    if (!rig.skinned || left == kNoJoint || right == kNoJoint || shin == kNoJoint) return false;
    const int carrier = rig.commonAncestor(left, right);
    if (carrier == kNoJoint) return false;
    const float leg = 2.0F * glm::distance(rig.positions[left], rig.positions[shin]);
    const NamedLegs legs = namedLegs(rig, left, right);
    return std::any_of(rig.children[carrier].begin(), rig.children[carrier].end(), [&](int top) {
        if (rig.names[top].meaningful || rig.isAncestorOrSelf(top, left) || rig.isAncestorOrSelf(top, right))
            return false;
        for (int joint = 0; joint < rig.count(); ++joint) {
            const PartScores& parts = rig.names[joint].parts;
            const bool other = parts[Part::upperArm] >= kTellsPartOfLimb || parts[Part::head] >= kTellsTrunkEnd;
            if (other && rig.isAncestorOrSelf(top, joint)) return false;
        }
        const Chain chain = namelessChain(rig, top);
        const float toLeft = glm::distance(rig.positions[chain.end], rig.positions[left]);
        const float toRight = glm::distance(rig.positions[chain.end], rig.positions[right]);
        return chain.joints >= kFewest && std::min(toLeft, toRight) > kShortest * leg &&
               std::abs(toLeft - toRight) < kMostAside * leg && leadsBehind(legs, rig.positions[chain.end]);
    });
}

}  // namespace

bool hasTail(const RigFeatures& rig) {
    return namesTail(rig) || trailsChain(rig);
}

}  // namespace lutka::animation
