#include "animation/humanoid/limb_links.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "animation/humanoid/limb_evidence.hpp"

namespace lutka::animation {

LimbLinks::LimbLinks(const FramedRig& framed, LimbKind kind) : framed_(framed), kind_(kind), parts_(partsOf(kind)) {
    findAbove();
    findEnds();
    findLinks();
}

void LimbLinks::findAbove() {
    const int count = static_cast<int>(framed_.pairs.size());
    above_.resize(framed_.pairs.size());
    for (int upper = 0; upper < count; ++upper) {
        for (int lower = 0; lower < count; ++lower)
            if (framed_.isAbove(upper, lower)) above_[lower].push_back(upper);
    }
}

void LimbLinks::findEnds() {
    const RigFeatures& rig = *framed_.rig;
    endsThere_.assign(framed_.pairs.size(), true);
    // The mesh of a part that has its joint above, or a thing that is held.
    const auto isMesh = [&](int joint) {
        return rig.rigidPart[joint] && rig.children[joint].empty() && rig.names[joint].helper;
    };
    for (const JointPair& pair : framed_.pairs) {
        if (rig.skinned && (pair.ownWeight <= 0.0F || framed_.isTip(pair))) continue;
        if (std::all_of(pair.joints.begin(), pair.joints.end(), isMesh)) continue;
        // What hangs on a garment goes on with that, and a garment with nothing.
        for (int joint = pair.joints[0]; joint != kNoJoint && !rig.names[joint].worn; joint = rig.parents[joint]) {
            const int above = rig.parents[joint] != kNoJoint ? framed_.pairOf[rig.parents[joint]] : -1;
            if (above >= 0) endsThere_[above] = false;
        }
    }
}

void LimbLinks::findLinks() {
    const int count = static_cast<int>(framed_.pairs.size());
    next_.resize(framed_.pairs.size());
    for (int upper = 0; upper < count; ++upper) {
        for (int lower = 0; lower < count; ++lower) {
            links_.push_back(linkTerm(upper, lower));
            if (links_.back() > limb_costs::kImpossible) next_[upper].push_back(lower);
        }
    }
}

float LimbLinks::skipped(int upper, int lower, bool straight) const {
    float total = 0.0F;
    int passed = 0;
    const RigFeatures& rig = *framed_.rig;
    const vec3& start = framed_.positions[at(upper).joints[0]];
    const vec3 along = framed_.positions[at(lower).joints[0]] - start;
    const float square = glm::dot(along, along) + 1e-9F;
    for (int joint = rig.parents[at(lower).joints[0]]; joint != kNoJoint; joint = rig.parents[joint]) {
        if (joint == at(upper).joints[0]) break;
        const int pair = framed_.pairOf[joint];
        if (pair < 0 || at(pair).helper || (rig.skinned && at(pair).ownWeight <= 0.0F)) continue;
        const vec3 away = framed_.positions[joint] - start;
        const vec3 off = away - glm::dot(away, along) / square * along;
        if (++passed > limb_bounds::kMostSkipped) return limb_costs::kImpossible;
        total += limb_costs::kSkippedJoint;
        if (straight) total += limb_terms::kStraightTwist.near(glm::length(off) / std::sqrt(square));
    }
    return total;
}

// A limb goes on where most of the skin does: hands before thumbs, shins before pockets.
float LimbLinks::mainBranchTerm(int upper, int lower) const {
    const RigFeatures& rig = *framed_.rig;
    if (!rig.skinned) return 0.0F;
    float total = 0.0F;
    for (int side = 0; side < 2; ++side) {
        int branch = at(lower).joints[side];
        while (rig.parents[branch] != at(upper).joints[side])
            branch = rig.parents[branch];
        float widest = rig.subtreeWeight[branch];
        for (const int sibling : rig.children[at(upper).joints[side]])
            widest = std::max(widest, rig.subtreeWeight[sibling]);
        total += 0.5F * std::log((rig.subtreeWeight[branch] + 1e-4F) / (widest + 1e-4F));
    }
    return limb_costs::kMainBranch * std::max(total, limb_costs::kLeastMainBranch);
}

bool LimbLinks::mayContinueDetached(int upper, int lower) const {
    const std::size_t pairs = framed_.pairs.size();
    if (pairs > limb_bounds::kMostPairsNamedDetached || (pairs > limb_bounds::kMostPairsDetached && !saysLimb(lower)))
        return false;
    if (framed_.isAbove(lower, upper) || upper == lower) return false;
    const RigFeatures& rig = *framed_.rig;
    if (rig.skinned && at(lower).ownWeight <= 0.0F) return false;
    // An arm beside a leg is no thigh of it.
    if (saysLimb(lower) && saysOtherLimb(upper)) return false;
    for (int joint = rig.parents[at(lower).joints[0]]; joint != kNoJoint; joint = rig.parents[joint]) {
        const int pair = framed_.pairOf[joint];
        if (pair >= 0 && !rig.names[joint].control && (!rig.skinned || at(pair).ownWeight > 0.0F)) return false;
    }
    return true;
}

// 0 below it in the tree, a loss where detached, limb_costs::kImpossible otherwise.
float LimbLinks::linkTerm(int upper, int lower) const {
    if (framed_.isAbove(upper, lower)) {
        const float passedOver = skipped(upper, lower);
        return passedOver > limb_costs::kImpossible ? passedOver + mainBranchTerm(upper, lower)
                                                    : limb_costs::kImpossible;
    }
    if (!mayContinueDetached(upper, lower)) return limb_costs::kImpossible;
    if (areNamedInOrder(upper, lower)) return limb_costs::kDetachedNamed;
    // A hand or foot by its name may hang on a control, though helpers hang on the limb.
    return endsThere_[upper] || isSurelyNamed(lower, 2) ? limb_costs::kDetached : limb_costs::kDetachedFromMore;
}

bool LimbLinks::saysOtherLimb(int pair) const {
    const auto says = [&](Part part) { return at(pair).names[part] >= limb_bounds::kNamedPart; };
    const std::array<Part, 4> others = partsOf(kind_ == LimbKind::leg ? LimbKind::arm : LimbKind::leg);
    return std::any_of(others.begin(), others.begin() + 3, says);
}

bool LimbLinks::areNamedInOrder(int upper, int lower) const {
    return (isNamed(upper, 0) && isNamed(lower, 1)) || (isNamed(upper, 1) && isNamed(lower, 2));
}

bool LimbLinks::isNamed(int pair, int slot) const {
    return at(pair).names[parts_[slot]] >= limb_bounds::kNamedPart;
}

bool LimbLinks::isSurelyNamed(int pair, int slot) const {
    return at(pair).names[parts_[slot]] >= limb_bounds::kSurelyNamed;
}

}  // namespace lutka::animation
