#include "animation/humanoid/trunk_measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "animation/humanoid/stray_faces.hpp"

namespace lutka::animation {
namespace {

constexpr float kNamedHead = 4.0F;     // a name's score from which it says head and nothing else
constexpr float kClearlyBelow = 0.4F;  // of the trunk: hips below the chest that they hang on
constexpr float kUpright = 0.99F;      // cosine between the stance's up and the file's
constexpr float kSamePlace = 0.01F;    // of the trunk: a copy's
constexpr float kSameJoint = 0.03F;    // … and of a part that has a joint of its own

}  // namespace

TrunkMeasures::TrunkMeasures(const FramedRig& framed, const LimbCandidate& legs, const LimbCandidate& arms)
    : framed_(framed),
      rig_(*framed.rig),
      legs_(legs),
      arms_(arms),
      length_(std::max(arms.root.y - legs.root.y, 0.05F * framed.spread)),
      slack_(legs.jointCount() + arms.jointCount() < 4 ? 2.0F : 1.0F) {
    const auto& leg = framed.pairs[legs.first].joints;
    const auto& arm = framed.pairs[arms.first].joints;
    legParent_ = rig_.commonAncestor(leg[0], leg[1]);
    armParent_ = rig_.commonAncestor(arm[0], arm[1]);
    if (rig_.parents[leg[0]] == rig_.parents[leg[1]]) thighParent_ = rig_.parents[leg[0]];
    trunkRoot_ =
        legParent_ == kNoJoint || armParent_ == kNoJoint ? kNoJoint : rig_.commonAncestor(legParent_, armParent_);
    isCentral_.reserve(static_cast<std::size_t>(rig_.count()));
    for (int joint = 0; joint < rig_.count(); ++joint) {
        isCentral_.push_back(standsInTheMiddle(joint));
        if (isCentral(joint)) central_.push_back(joint);
    }
    strayFaces_ = countStrayFaces(framed, central_, armRoot(), arms.root.y);
}

bool TrunkMeasures::standsInTheMiddle(int joint) const {
    const int pair = framed_.pairOf[joint];
    if (pair >= 0 && (legs_.uses(pair) || arms_.uses(pair))) return false;
    // A dancer's or fallen figure's trunk may lie to the side; its names tell.
    const bool told = isNamedTrunk(joint) || (joint == thighParent_ && legs_.told);
    const float aside = !told ? 0.12F : framed_.stance.byNames ? 2.0F : 0.4F;
    return std::abs(position(joint).x) < aside * length_ && pair < 0;
}

float TrunkMeasures::ownSkin(int joint) const {
    float own = rig_.directWeight[joint];
    for (const int child : rig_.children[joint]) {
        if (rig_.children[child].empty() && framed_.pairOf[child] < 0) own += rig_.directWeight[child];
    }
    return own;
}

bool TrunkMeasures::isTrunkBlock(int joint) const {
    constexpr float kBelow = 0.25F;  // of the trunk
    constexpr float kAbove = 1.0F;   // … above the middle of arms that hang down
    if (rig_.skinned || !rig_.rigidPart[joint] || !isCentral(joint) || rig_.names[joint].helper) return false;
    const PartScores& parts = rig_.names[joint].parts;
    const float height = (position(joint).y - legs_.root.y) / length_;
    return std::max({parts[Part::hips], parts[Part::trunk], parts[Part::chest]}) > 0.0F && height > -kBelow &&
           height < 1.0F + kAbove;
}

bool TrunkMeasures::isFileRoot(int joint) const {
    if (rig_.rigidPart[joint] || name(joint, Part::hips) >= kNamedChest) return false;
    int root = joint;
    while (rig_.parents[root] != kNoJoint)
        root = rig_.parents[root];
    return isInPlaceOf(joint, root);
}

bool TrunkMeasures::standsForSpine(int joint) const {
    constexpr float kAtThighs = 0.25F;  // of the trunk
    if (!rig_.skinned || ownSkin(joint) > 0.0F) return false;
    return std::any_of(rig_.children[joint].begin(), rig_.children[joint].end(), [&](int child) {
        return isCentral(child) && ownSkin(child) > 0.0F && rig_.isAncestorOrSelf(child, armRoot()) &&
               std::abs(position(child).y - legs_.root.y) < kAtThighs * length_;
    });
}

bool TrunkMeasures::isNamedTrunk(int joint) const {
    constexpr std::array<Part, 5> kTrunk{Part::hips, Part::trunk, Part::chest, Part::neck, Part::head};
    const NameEvidence& said = rig_.names[joint];
    const auto tells = [&](Part part) { return said.parts[part] >= kNamedTrunk; };
    return said.side == Side::center && !said.helper && std::any_of(kTrunk.begin(), kTrunk.end(), tells);
}

bool TrunkMeasures::isNamedHead(int joint) const {
    return name(joint, Part::head) >= kNamedHead;
}

bool TrunkMeasures::goesOnAlike(int joint) const {
    return std::any_of(rig_.children[joint].begin(), rig_.children[joint].end(), [&](int child) {
        return isCentral(child) && rig_.carriesSkin(child) && position(child).y > position(joint).y &&
               !isInPlaceOf(child, joint) && isSecondSegment(rig_.names[joint], rig_.names[child]);
    });
}

bool TrunkMeasures::isSpineBelowHead(int joint) const {
    constexpr float kAsHeavy = 0.7F;
    if (!rig_.skinned || name(joint, Part::trunk) < kNamedTrunk || name(joint, Part::head) > 0.0F) return false;
    return std::any_of(rig_.children[joint].begin(), rig_.children[joint].end(), [&](int child) {
        const NameEvidence& said = rig_.names[child];
        const bool mayBeHead = !said.helper && !said.worn && !said.face && said.parts[Part::head] >= 0.0F;
        return isCentral(child) && mayBeHead && position(child).y > position(joint).y && !isInPlaceOf(child, joint) &&
               rig_.subtreeWeight[child] >= kAsHeavy * rig_.directWeight[joint];
    });
}

bool TrunkMeasures::endsSpine(int joint) const {
    const int parent = rig_.parents[joint];
    return parent != kNoJoint && legs_.told && arms_.told && name(joint, Part::trunk) <= 0.0F &&
           isSpineBelowHead(parent);
}

bool TrunkMeasures::isPartOfFace(int joint) const {
    constexpr float kNextToNothing = 0.1F;
    const int parent = rig_.parents[joint];
    if (!rig_.skinned || parent == kNoJoint || !isCentral(parent)) return false;
    return rig_.directWeight[parent] > 0.0F && rig_.subtreeWeight[joint] < kNextToNothing * rig_.directWeight[parent];
}

int TrunkMeasures::facesOn(int joint) const {
    int faces = strayFaces_[joint];
    for (const int child : rig_.children[joint]) {
        if (rig_.names[child].face) ++faces;
        if (isInPlaceOf(child, joint)) faces += facesOn(child);
    }
    return faces;
}

bool TrunkMeasures::isInPlaceOf(int joint, int other) const {
    return glm::distance(position(joint), position(other)) < kSameJoint * length_;
}

// What hangs in the joint's own place is a part of it and goes nowhere.
float TrunkMeasures::skinOnwards(int joint) const {
    float onward = 0.0F;
    for (const int child : rig_.children[joint]) {
        if (!isCentral(child)) continue;
        const bool part = rig_.rigidPart[child] && rig_.children[child].empty() && !rig_.rigidPart[joint];
        const float weight = isInPlaceOf(child, joint) ? skinOnwards(child) : rig_.subtreeWeight[child];
        onward = std::max(onward, (part ? 0.3F : 1.0F) * weight);
    }
    return onward;
}

bool TrunkMeasures::areToldHips(int joint) const {
    return isTold() && joint == legParent_ && name(joint, Part::hips) >= kNamedHips;
}

bool TrunkMeasures::isToldChest(int joint) const {
    return isTold() && joint == armParent_ && name(joint, Part::chest) >= kNamedChest;
}

bool TrunkMeasures::carriesLegsBelowControl(int joint) const {
    return joint == legParent_ && legs_.told && trunkRoot_ != kNoJoint && joint != trunkRoot_ &&
           rig_.names[trunkRoot_].helper && rig_.isAncestorOrSelf(trunkRoot_, joint);
}

bool TrunkMeasures::isCopyOfWhatCarries(int joint, int below) const {
    if (rig_.skinned || rig_.isAncestorOrSelf(joint, below)) return false;
    return std::any_of(central_.begin(), central_.end(), [&](int other) {
        return other != joint && rig_.isAncestorOrSelf(other, below) && !rig_.isAncestorOrSelf(other, joint) &&
               glm::distance(position(other), position(joint)) < kSamePlace * length_;
    });
}

bool TrunkMeasures::isTurnedOver(int chest, int hips) const {
    if (chest != armParent_ || hips != legParent_) return false;
    const bool named = name(hips, Part::hips) >= kNamedHips && name(chest, Part::chest) >= kNamedChest;
    return named || (hips == thighParent_ && hangsBelow(hips, chest));
}

// The lower of two joints that move skin hangs on the upper one: a tree that starts further up than at the hips. So
// do animals', whose trunk lies.
bool TrunkMeasures::hangsBelow(int lower, int upper) const {
    if (framed_.stance.up.y < kUpright) return false;
    const bool moves = !rig_.skinned || (rig_.directWeight[lower] > 0.0F && rig_.directWeight[upper] > 0.0F);
    return moves && lower != upper && rig_.isAncestorOrSelf(upper, lower) &&
           position(upper).y - position(lower).y > kClearlyBelow * length_;
}

}  // namespace lutka::animation
