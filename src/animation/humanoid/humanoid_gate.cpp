#include "animation/humanoid/humanoid_gate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "animation/humanoid/tails.hpp"

namespace lutka::animation {
namespace {

constexpr float kMostTilt = radians(40.0F);  // of the trunk from upright; hunched figures reach 30 degrees
constexpr float kUprightTrunk = radians(20.0F);
constexpr float kStraightTrunk = radians(8.0F);
constexpr float kTallRise = 1.5F;                // of the arms' roots above the legs', as a share of the legs' height
constexpr float kMostHeadTilt = radians(42.0F);  // … of a head without a name from above the shoulders
constexpr float kMostBend = radians(22.0F);      // of trunk and legs of a figure that leans as a whole
constexpr float kMostLegTilt = radians(50.0F);   // of the legs from straight down
constexpr float kLeastHandHeight = 0.16F;        // above the feet, as a share of the way up to the arms' roots
// Figures of blocks have one joint a limb and any proportions; names of arms and legs tell them.
constexpr float kNamedBlock = 2.0F;
constexpr float kBlocksShape = 1.0F;
constexpr float kBlocksWhole = 5.0F;
// Names of every joint of all four limbs, of hips and head carry a figure of any proportions whose trunk is upright;
// where every limb has three joints, and nothing is a tail, hips need no name.
constexpr float kToldTrunk = 8.0F;
constexpr float kToldShape = 12.0F;
// Of shape and half the whole, where no name speaks for a figure: upright; headless; lying or leaning; on its head or
// side. Turned far enough, many a creature has something of a figure.
constexpr float kLeastUpright = -3.5F;
constexpr float kLeastHeadless = 4.5F;
constexpr float kLeastTurned = -1.1F;
constexpr float kLeastOdd = 4.0F;
constexpr float kOddPrior = -3.5F;
constexpr float kLeastRise = 0.10F;  // of the arms' roots above the legs', as a share of the legs' length

float angleTo(const vec3& direction, const vec3& axis) {
    const float length = glm::length(direction) * glm::length(axis);
    return length > 0.0F ? std::acos(std::clamp(glm::dot(direction, axis) / length, -1.0F, 1.0F)) : 0.0F;
}

// Share of the placed limb joints whose names are such; clavicles and toes count for nothing: wings hang on shoulders.
template <class Names>
float shareNamed(const FramedRig& framed, const LimbCandidate& limb, const Names& areSuch) {
    int named = 0;
    int placed = 0;
    for (std::size_t slot = 0; slot < 3; ++slot) {
        const int pair = limb.pairs[slot];
        if (pair == kNoPair) continue;
        ++placed;
        if (areSuch(framed.rig->names[framed.pairs[pair].joints[0]])) ++named;
    }
    return placed > 0 ? static_cast<float>(named) / static_cast<float>(placed) : 0.0F;
}

float creatureShare(const FramedRig& framed, const LimbCandidate& limb) {
    return shareNamed(framed, limb, [](const NameEvidence& name) { return name.creature; });
}

// Ears beside a head, of a figure that has no arms.
float faceShare(const FramedRig& framed, const LimbCandidate& limb) {
    return shareNamed(framed, limb, [](const NameEvidence& name) { return name.face; });
}

// Arms that are called just "leg": one of several pairs of them. Who copies legs to make arms keeps the names of parts.
bool areLegsByName(const FramedRig& framed, const LimbCandidate& arms) {
    const auto isLeg = [](const NameEvidence& name) { return name.bareLimb && name.parts[Part::upperLeg] > 0.0F; };
    return shareNamed(framed, arms, isLeg) >= 1.0F;
}

// Two joints of the limb hang side by side and are named as limbs, alike but for their numbers: several legs, of one
// joint each, which follow each other when the animal is turned.
bool areSeveral(const FramedRig& framed, const LimbCandidate& limb) {
    const RigFeatures& rig = *framed.rig;
    for (std::size_t slot = 1; slot < 3; ++slot) {
        if (limb.pairs[slot - 1] == kNoPair || limb.pairs[slot] == kNoPair) continue;
        const int upper = framed.pairs[limb.pairs[slot - 1]].joints[0];
        const int lower = framed.pairs[limb.pairs[slot]].joints[0];
        if (rig.parents[upper] == rig.parents[lower] && rig.names[upper].bareLimb &&
            rig.names[upper].words == rig.names[lower].words)
            return true;
    }
    return false;
}

// Share of the joints below a limb's first pair that are named as an animal's: wings that hang on shoulders. What hangs
// on a hand by its name is its own affair: a robot's claws.
float creaturesBelow(const FramedRig& framed, const LimbCandidate& limb) {
    constexpr float kNamedHand = 2.0F;
    const RigFeatures& rig = *framed.rig;
    const int top = framed.pairs[limb.first].joints[0];
    const auto ofHand = [&](int joint) {
        for (int above = rig.parents[joint]; above != kNoJoint && above != top; above = rig.parents[above]) {
            if (rig.names[above].parts[Part::hand] >= kNamedHand) return true;
        }
        return false;
    };
    int named = 0;
    int all = 0;
    for (int joint = 0; joint < rig.count(); ++joint) {
        if (joint == top || !rig.isAncestorOrSelf(top, joint) || !rig.names[joint].meaningful) continue;
        if (ofHand(joint)) continue;
        ++all;
        if (rig.names[joint].creature) ++named;
    }
    return all > 0 ? static_cast<float>(named) / static_cast<float>(all) : 0.0F;
}

struct LimbEnd {
    vec3 place;
    float length;  // of the way there, along the joints
};

// Where a limb ends. Without a joint there it is twice as far from the last one as the middle of that one's skin,
// wherever that points.
LimbEnd endOf(const FramedRig& framed, const LimbCandidate& limb) {
    const int last = limb.pairs[1] != kNoPair ? limb.pairs[1] : limb.first;
    const int joint = framed.pairs[last].joints[0];
    if (limb.pairs[2] != kNoPair || framed.subtreeSkin[joint].count == 0) return {limb.tip, limb.length};
    const vec3 beyond = 2.0F * (framed.subtreeSkin[joint].mean() - framed.positions[joint]);
    const float before = last != limb.first ? framed.segment(limb.first, last) : 0.0F;
    return {framed.pairs[last].position + beyond, before + glm::length(beyond)};
}

// Straight arms and straight legs side by side, across the trunk, which end at one height: names of a human do not make
// an animal one. The hands of one who bows hang above the ground.
bool isOnAllFours(const Figure& figure, const FramedRig& framed) {
    constexpr float kStraight = 0.8F;     // of the limb's length
    constexpr float kAboveGround = 0.2F;  // of the legs' length
    const LimbEnd foot = endOf(framed, figure.legs);
    const LimbEnd hand = endOf(framed, figure.arms);
    const vec3 legs = foot.place - figure.legs.root;
    const vec3 arms = hand.place - figure.arms.root;
    const float above = glm::dot(foot.place - hand.place, legs) / std::max(glm::dot(legs, legs), 1e-9F);
    if (above > kAboveGround) return false;
    const auto straight = [](const LimbEnd& end, const vec3& along) {
        return glm::length(along) > kStraight * end.length;
    };
    return straight(foot, legs) && straight(hand, arms) && angleTo(legs, vec3(0, -1, 0)) > kMostLegTilt &&
           angleTo(arms, legs) < kMostTilt;
}

// A level trunk above four splayed limbs without hands and feet, which end on one ground and are of one length: a beast
// with a man's names. The arms of a man who crawls are shorter than his legs.
bool isCarriedByFour(const Figure& figure, const FramedRig& framed) {
    constexpr float kLevel = 0.42F;      // sine of the trunk to the ground
    constexpr float kSplayed = 0.3F;     // of a limb's length, to its side
    constexpr float kDown = 0.25F;       // … down
    constexpr float kOneGround = 0.25F;  // of the legs' length
    constexpr float kOneLength = 0.8F;   // the shorter of the longer
    if (!framed.rig->skinned) return false;
    const Stance& stance = framed.stance;
    const vec3 up(stance.across().y, stance.up.y, stance.through().y);
    const vec3 trunk = figure.arms.root - figure.legs.root;
    if (std::abs(glm::dot(trunk, up)) > kLevel * glm::length(trunk)) return false;
    const LimbEnd foot = endOf(framed, figure.legs);
    const LimbEnd hand = endOf(framed, figure.arms);
    if (std::min(foot.length, hand.length) < kOneLength * std::max(foot.length, hand.length)) return false;
    const auto goesDown = [&](const LimbCandidate& limb, const LimbEnd& end) {
        return limb.pairs[2] == kNoPair && glm::dot(limb.root - end.place, up) > kDown * end.length &&
               end.place.x - limb.root.x > kSplayed * end.length;
    };
    return goesDown(figure.legs, foot) && goesDown(figure.arms, hand) &&
           std::abs(glm::dot(foot.place - hand.place, up)) < kOneGround * foot.length;
}

// Parts that neither hang on each other nor bear a limb's name: props side by side, whatever pattern they lie in.
bool isScattered(const Figure& figure, const FramedRig& framed) {
    if (framed.rig->skinned || figure.legs.names > 0.0F || figure.arms.names > 0.0F) return false;
    for (const LimbCandidate* limb : {&figure.legs, &figure.arms}) {
        for (std::size_t slot = 1; slot < 3; ++slot) {
            const int upper = limb->pairs[slot - 1];
            const int lower = limb->pairs[slot];
            if (upper != kNoPair && lower != kNoPair && framed.isAbove(upper, lower)) return false;
        }
    }
    return true;
}

// Of a figure that was turned to stand: a tail that reaches further down than the feet goes on with the trunk.
bool trailsTail(const Figure& figure, const FramedRig& framed) {
    const RigFeatures& rig = *framed.rig;
    const float least = figure.legs.tip.y - 0.1F * figure.legs.length;
    for (int joint = 0; joint < rig.count(); ++joint) {
        if (rig.names[joint].tail && rig.carriesSkin(joint) && framed.positions[joint].y < least) return true;
    }
    return false;
}

bool namesHead(const Figure& figure, const FramedRig& framed) {
    const int head = figure.trunk.head;
    return head != kNoJoint && framed.rig->names[head].parts[Part::head] >= kTellsTrunkEnd;
}

// Of the way from the shoulders to a head that is not named so, from upright; 0 without one, or where it is shorter
// than the trunk. With a tail the name proves nothing: a raptor's joints may be called as a man's.
float headTilt(const Figure& figure, const FramedRig& framed) {
    const int head = figure.trunk.head;
    if (head == kNoJoint) return 0.0F;
    if (namesHead(figure, framed) && !hasTail(*framed.rig)) return 0.0F;
    vec3 way = framed.positions[head] - figure.arms.root;
    way.x = 0.0F;
    const bool far = glm::length(way) > glm::distance(figure.arms.root, figure.legs.root);
    return far ? angleTo(way, vec3(0, 1, 0)) : 0.0F;
}

// Names tell both limbs, whatever the pose. Where one goes from its first joint to its end the other one is whole: a
// frog of blocks has two joints for every limb.
bool areTold(const LimbCandidate& a, const LimbCandidate& b) {
    const auto skipsMiddle = [](const LimbCandidate& limb) {
        return limb.pairs[1] == kNoPair && limb.pairs[2] != kNoPair;
    };
    return a.whole && b.whole && (!skipsMiddle(a) || b.named) && (!skipsMiddle(b) || a.named);
}

// A body that leans over its legs, ends in a tail and has stumps for arms.
bool isBird(const Figure& figure, const FramedRig& framed, float tilt) {
    const RigFeatures& rig = *framed.rig;
    if (tilt < kUprightTrunk || figure.arms.told || figure.arms.named) return false;
    for (int joint = 0; joint < rig.count(); ++joint) {
        if (rig.names[joint].tail && rig.skinned && rig.directWeight[joint] > 0.0F) return true;
    }
    return false;
}

// Both legs hang on one arm: what a hand holds in a view of the player's own hands, a weapon or a pet, stands for them.
// Where names tell whole limbs, and the hips hang on no arm, the file has hung the figure's own legs there by mistake.
bool hangOnOneArm(const Figure& figure, const FramedRig& framed) {
    const RigFeatures& rig = *framed.rig;
    const auto& legs = framed.pairs[figure.legs.first].joints;
    const auto& arms = framed.pairs[figure.arms.first].joints;
    const bool named = figure.legs.named && figure.arms.named;
    return std::any_of(arms.begin(), arms.end(), [&](int arm) {
        const auto hangsThere = [&](int joint) { return rig.isAncestorOrSelf(arm, joint); };
        const bool ownLegs = named && !hangsThere(figure.trunk.hips);
        return !ownLegs && std::all_of(legs.begin(), legs.end(), hangsThere);
    });
}

float leastUnnamed(const Figure& figure) {
    const float least = figure.prior >= 0.0F ? kLeastUpright : figure.prior < kOddPrior ? kLeastOdd : kLeastTurned;
    return figure.trunk.head == kNoJoint ? std::max(least, kLeastHeadless) : least;
}

}  // namespace

float trunkTilt(const Figure& figure, const FramedRig& framed) {
    const vec3 up(0, 1, 0);
    vec3 from = figure.legs.root;
    vec3 shoulders = figure.arms.root;
    from.x = shoulders.x = 0.0F;
    const float toShoulders = angleTo(shoulders - from, up);
    if (figure.trunk.head == kNoJoint) return toShoulders;
    vec3 head = framed.positions[figure.trunk.head];
    head.x = 0.0F;
    return 0.5F * (toShoulders + angleTo(head - from, up));
}

std::string refusalOf(const Figure& figure, const FramedRig& framed) {
    const float tilt = trunkTilt(figure, framed);
    const float legTilt = angleTo(figure.legs.tip - figure.legs.root, vec3(0, -1, 0));
    // A leaning figure is straight: an animal's legs and trunk are not in one line, however it is turned.
    // Without names a sitting animal reads as such a figure.
    if (figure.leans && !(figure.legs.named && figure.arms.named)) return "no figure stands upright in it";
    if (figure.prior < 0.0F && !figure.leans && trailsTail(figure, framed))
        return "it lies, and its tail is an animal's";
    // Nor is one that was turned to stand, where its limbs bear no clear names: a frog sits as a man lies.
    const bool turned = figure.prior < 0.0F && !figure.posed && !(figure.legs.named && figure.arms.named);
    if ((figure.leans || turned) && (tilt > kMostBend || legTilt > kMostBend))
        return "the trunk and the legs are not in one line";
    // The names tell a seated or kneeling figure, as long as its trunk is upright.
    const bool named = figure.posed ? areTold(figure.legs, figure.arms)
                                    : figure.legs.named && figure.arms.named && figure.prior >= 0.0F;
    if (figure.posed && !named) return "its names are not those of its limbs";
    if (figure.posed && (isOnAllFours(figure, framed) || isCarriedByFour(figure, framed)))
        return "it stands on all fours, whatever its names say";
    if (tilt > kMostTilt) {
        return fmt::format("the trunk lies at {:.0f} degrees from upright: an animal, not a standing figure",
                           degrees(tilt));
    }
    if (isBird(figure, framed, tilt)) return "its trunk leans over its legs, it has a tail, and its arms have no parts";
    if (headTilt(figure, framed) > kMostHeadTilt)
        return "its head lies before its shoulders, not above them: an animal";
    if (legTilt > kMostLegTilt && !named) return "the legs do not go down";
    const float rise = figure.arms.root.y - figure.legs.root.y;
    if (rise < kLeastRise * figure.legs.length) return "the arms start no higher than the legs";
    const float feet = std::min(figure.legs.tip.y, framed.floor + 0.15F * figure.legs.length);
    const float hands = (figure.arms.tip.y - feet) / (figure.arms.root.y - feet);
    // Long arms of a goblin, upright by its trunk and told by its names.
    const bool blocks = figure.isBlocky() && figure.legs.names > kNamedBlock && figure.arms.names > kNamedBlock;
    // So is one whose straight trunk is far longer than its legs: no animal's shoulders are that high.
    const bool tall = tilt < kStraightTrunk && rise > kTallRise * (figure.legs.root.y - feet);
    const bool upright = (((figure.legs.told && figure.arms.told) || blocks) && tilt < kUprightTrunk) || tall;
    if (hands < kLeastHandHeight && !named && !upright) return "the hands stand on the ground: a four-legged animal";
    if (creatureShare(framed, figure.arms) > 0.6F || creaturesBelow(framed, figure.arms) > 0.5F)
        return "what would be the arms are named as wings or front legs";
    if (faceShare(framed, figure.arms) > 0.6F) return "what would be the arms are named as parts of a face";
    if (figure.prior < 0.0F && areLegsByName(framed, figure.arms)) return "what would be the arms are named as legs";
    if (creatureShare(framed, figure.legs) > 0.6F) return "what would be the legs are named as an animal's";
    if (figure.prior < 0.0F && areSeveral(framed, figure.legs))
        return "what would be a leg is several legs side by side";
    if (hangOnOneArm(figure, framed)) return "what would be the legs hang on one of the arms";
    if (isScattered(figure, framed)) return "its parts hang on nothing and are named as no limbs";
    // Names alone never make a humanoid, but they carry one that is put together oddly.
    const float names = figure.legs.names + figure.arms.names + figure.trunk.names;
    const float whole = figure.score - figure.prior - names;
    if (names <= 0.0F && figure.shapeScore() + 0.5F * whole < leastUnnamed(figure))
        return "no figure stands upright in it";
    const bool wholeLimbs = figure.legs.named && figure.arms.named && !hasTail(*framed.rig);
    const bool toldTrunk = figure.trunk.names >= kToldTrunk || (wholeLimbs && namesHead(figure, framed));
    // So do names of arms, legs and head of rigid blocks, of which there is one or two for each limb.
    const bool toldBlocks = blocks && !framed.rig->skinned && namesHead(figure, framed) && tilt < kUprightTrunk &&
                            figure.prior >= 0.0F && !hasTail(*framed.rig);
    const bool told = (figure.legs.told && figure.arms.told && toldTrunk) || toldBlocks;
    const float helpShape =
        std::clamp(0.2F * names, -6.0F, 4.0F) + (blocks ? kBlocksShape : 0.0F) + (told ? kToldShape : 0.0F);
    const float helpWhole =
        std::clamp(0.6F * names, -10.0F, 10.0F) + (blocks ? kBlocksWhole : 0.0F) + (told ? kToldShape : 0.0F);
    if (figure.shapeScore() + helpShape < kLeastShapeScore)
        return fmt::format("the limbs have not the proportions of a human figure (score {:.1f})", figure.shapeScore());
    if (whole + helpWhole < kLeastWholeScore)
        return fmt::format("too little tells a figure: its limbs or its trunk have too few joints (score {:.1f})",
                           whole);
    return {};
}

}  // namespace lutka::animation
