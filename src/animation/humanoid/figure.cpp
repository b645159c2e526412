#include "animation/humanoid/figure.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "animation/humanoid/evidence_terms.hpp"
#include "animation/humanoid/humanoid_gate.hpp"
#include "animation/humanoid/lone_sides.hpp"
#include "animation/humanoid/named_stance.hpp"

namespace lutka::animation {
namespace {

constexpr std::size_t kCombinationsTried = 14;
constexpr float kSnapCosine = 0.9990F;  // 2.5 degrees
constexpr float kAgreement = 10.0F;     // log-odds of a plane that mirrors all joints against one that mirrors none
constexpr float kRefusedLoss = 4.0F;
constexpr float kCrossedLoss = 12.0F;
constexpr float kMoreLimbs = -3.0F;
constexpr float kMostOfPosed = 3.0F;    // the most that shape says of the front of a figure in any pose
constexpr float kUnknownMargin = 6.0F;  // no other reading at all

struct Combination {
    std::size_t legs;
    std::size_t arms;
    float score;
};

// Terms that bind legs and arms: how they stand to each other.
float bindingTerms(const FramedRig& framed, const LimbCandidate& legs, const LimbCandidate& arms) {
    const float rise = arms.root.y - legs.root.y;
    // Of the hips above the ground; a seated figure's, whose names are clear, would be as high as its legs are long.
    const auto clear = [&](const LimbCandidate& limb) { return limb.named || (framed.stance.byNames && limb.whole); };
    const float height = std::max(legs.root.y - framed.floor, (clear(legs) ? 0.95F : 0.3F) * legs.length);
    const float slack = legs.jointCount() == 1 || arms.jointCount() == 1 ? 2.0F : 1.0F;
    float score = rise > 0.05F * height ? near(std::log(rise / height), std::log(0.65F), 0.5F * slack) : -8.0F;
    score += near(std::log(arms.length / height), std::log(0.62F), 0.4F * slack);
    score += atLeast((arms.tip.y - framed.floor) / legs.length, 0.45F, 0.15F, clear(legs) && clear(arms) ? 2.0F : 8.0F);
    const float tilt = std::atan2(std::abs(arms.root.z - legs.root.z), std::max(rise, 1e-6F));
    score += atMost(tilt, radians(12.0F), radians(14.0F), 10.0F);
    if (framed.rig->skinned) {
        const float legSkin = framed.pairs[legs.first].subtreeWeight;
        const float armSkin = framed.pairs[arms.first].subtreeWeight;
        score += 1.5F * std::min(legSkin / 0.08F, 1.0F) + 1.5F * std::min(armSkin / 0.05F, 1.0F);
    }
    return score;
}

// Whether the two limbs can belong to one figure: no joint in both, neither hanging from the other.
bool compatible(const FramedRig& framed, const LimbCandidate& legs, const LimbCandidate& arms) {
    for (const int pair : legs.pairs) {
        if (pair != kNoPair && arms.uses(pair)) return false;
    }
    const int leg = legs.first;
    const int arm = arms.pairs[3] != kNoPair ? arms.pairs[3] : arms.first;
    return !framed.isAbove(leg, arm) && !framed.isAbove(arm, leg);
}

std::vector<Combination> combine(const FramedRig& framed, const std::vector<LimbCandidate>& legs,
                                 const std::vector<LimbCandidate>& arms) {
    std::vector<Combination> combinations;
    for (std::size_t leg = 0; leg < legs.size(); ++leg) {
        for (std::size_t arm = 0; arm < arms.size(); ++arm) {
            if (!compatible(framed, legs[leg], arms[arm])) continue;
            const float score = legs[leg].score + arms[arm].score + bindingTerms(framed, legs[leg], arms[arm]);
            combinations.push_back({leg, arm, score});
        }
    }
    std::stable_sort(combinations.begin(), combinations.end(),
                     [](const Combination& a, const Combination& b) { return a.score > b.score; });
    if (combinations.size() > kCombinationsTried) combinations.resize(kCombinationsTried);
    return combinations;
}

// A second pair of arms or legs, as long and as heavy as the first: spiders, centaurs. What hangs from the head (ears,
// plaits) does not count.
float moreLimbs(const FramedRig& framed, const Figure& figure) {
    const RigFeatures& rig = *framed.rig;
    const int arm = figure.arms.first;
    const float leastSkin =
        0.5F * std::min(framed.pairs[arm].subtreeWeight, framed.pairs[figure.legs.first].subtreeWeight);
    const auto related = [&](int a, int b) { return a == b || framed.isAbove(a, b) || framed.isAbove(b, a); };
    float total = 0.0F;
    for (int pair = 0; pair < static_cast<int>(framed.pairs.size()); ++pair) {
        const JointPair& limb = framed.pairs[pair];
        const int parent = rig.parents[limb.joints[0]];
        const bool inner = parent != kNoJoint && framed.pairOf[parent] >= 0;
        if (inner || limb.shadow || related(pair, arm) || related(pair, figure.legs.first)) continue;
        if (figure.arms.uses(pair) || figure.legs.uses(pair) || limb.subtreeWeight < leastSkin) continue;
        if (figure.trunk.head != kNoJoint && rig.isAncestorOrSelf(figure.trunk.head, limb.joints[0])) continue;
        float reach = 0.0F;
        for (int other = 0; other < static_cast<int>(framed.pairs.size()); ++other) {
            if (framed.isAbove(pair, other)) reach = std::max(reach, framed.segment(pair, other));
        }
        if (reach > 0.5F * figure.arms.length) total += kMoreLimbs;
    }
    return std::max(total, 3.0F * kMoreLimbs);
}

float limbMargin(const std::vector<LimbCandidate>& all, const LimbCandidate& best, std::size_t slot) {
    float margin = kUnknownMargin;
    for (const LimbCandidate& other : all) {
        if (other.pairs[slot] != best.pairs[slot]) margin = std::min(margin, best.score - other.score);
    }
    return std::max(margin, 0.0F);
}

void findMargins(Figure& figure, const std::vector<LimbCandidate>& legs, const std::vector<LimbCandidate>& arms) {
    for (std::size_t slot = 0; slot < figure.margins.legs.size(); ++slot) {
        figure.margins.legs[slot] = limbMargin(legs, figure.legs, slot);
        figure.margins.arms[slot] = limbMargin(arms, figure.arms, slot);
    }
    const auto without = [&](const TrunkBan& ban) {
        const float other = findTrunk(figure.framed, figure.legs, figure.arms, ban).score;
        return std::clamp(figure.trunk.score - other, 0.0F, kUnknownMargin);
    };
    figure.margins.hips = without({.hips = figure.trunk.hips});
    figure.margins.chest = without({.chest = figure.trunk.chest});
    if (figure.trunk.head != kNoJoint) figure.margins.head = without({.head = figure.trunk.head});
}

// The better of two readings: one that is not refused, unless a refused one is likelier by far (a raptor reads as a
// standing figure once its thighs are left out); then the likelier.
bool better(const Figure& a, const Figure& b) {
    const auto loss = [](const Figure& figure) {
        return (figure.refusal.empty() ? 0.0F : kRefusedLoss) + (figure.crossed ? kCrossedLoss : 0.0F);
    };
    return a.score - loss(a) > b.score - loss(b);
}

// Whether a joint that is named head and nothing else has no place in a reading that has no head.
bool losesItsHead(const RigFeatures& rig, const Figure& figure) {
    constexpr float kNamedHead = 4.0F;
    return figure.trunk.head == kNoJoint &&
           std::any_of(rig.names.begin(), rig.names.end(),
                       [](const NameEvidence& name) { return !name.helper && name.parts[Part::head] >= kNamedHead; });
}

// Whether a joint that is named hips and nothing else carries the joint that stands for them: a plane askew through a
// running figure leaves them beside it.
bool losesItsHips(const RigFeatures& rig, const Figure& figure) {
    constexpr float kNamedHips = 4.0F;
    const int hips = figure.trunk.hips;
    if (hips == kNoJoint || rig.names[hips].parts[Part::hips] > 0.0F) return false;
    for (int above = rig.parents[hips]; above != kNoJoint; above = rig.parents[above]) {
        const NameEvidence& name = rig.names[above];
        if (!name.helper && name.side == Side::center && name.parts[Part::hips] >= kNamedHips) return true;
    }
    return false;
}

// Which side the names give the joints of the +x half: +1 left, -1 right, 0 where they disagree or are too few.
int sideByNames(const FramedRig& framed, const LimbCandidate& limb) {
    constexpr int kFewest = 1;
    int sum = 0;
    int counted = 0;
    for (const int index : limb.pairs) {
        if (index == kNoPair) continue;
        const Side plus = framed.rig->names[framed.pairs[index].joints[0]].side;
        const Side minus = framed.rig->names[framed.pairs[index].joints[1]].side;
        if (plus == Side::center || minus == Side::center || plus == minus) continue;
        sum += plus == Side::left ? 1 : -1;
        ++counted;
    }
    return counted >= kFewest && std::abs(sum) == counted ? sum / counted : 0;
}

struct UpAxis {
    vec3 axis;
    float prior;         // log-odds against +Y, which import takes care of
    bool leans = false;  // the figure leans as a whole
    bool posed = false;  // its names tell the stance
};

// The best reading in one stance.
Figure readInStance(const RigFeatures& rig, const Stance& stance, const UpAxis& up, float agreement) {
    Figure best;
    best.refusal = "no joints stand as legs, trunk and arms of a figure";
    const FramedRig framed = frameRig(rig, stance);
    const std::vector<LimbCandidate> legs = findLimbs(framed, LimbKind::leg);
    const std::vector<LimbCandidate> arms = findLimbs(framed, LimbKind::arm);
    for (const Combination& combination : combine(framed, legs, arms)) {
        Figure figure;
        figure.legs = legs[combination.legs];
        figure.arms = arms[combination.arms];
        figure.trunk = findTrunk(framed, figure.legs, figure.arms);
        if (figure.trunk.hips == kNoJoint) continue;
        figure.prior = up.prior;
        figure.leans = up.leans;
        figure.posed = up.posed;
        figure.score = up.prior + agreement + combination.score + figure.trunk.score;
        figure.score += moreLimbs(framed, figure);
        figure.score += atMost(trunkTilt(figure, framed), radians(20.0F), radians(10.0F));
        figure.refusal = refusalOf(figure, framed);
        figure.crossed = figure.legs.names > 0.0F && figure.arms.names > 0.0F &&
                         sideByNames(framed, figure.legs) * sideByNames(framed, figure.arms) < 0;
        if (better(figure, best)) best = std::move(figure);
    }
    best.framed = framed;
    if (best.trunk.hips == kNoJoint) return best;
    findMargins(best, legs, arms);
    findLoneSides(framed, best.legs);
    findLoneSides(framed, best.arms);
    best.facing = findFacing(framed, best.legs, best.arms, best.trunk);
    // Feet and knees of a figure in any pose prove little of its front.
    if (best.posed) best.facing.shape = std::clamp(best.facing.shape, -kMostOfPosed, kMostOfPosed);
    return best;
}

// The plane's normal and the up axis made perpendicular, snapped to the model's axes where they nearly are those. The
// plane turns about the middle of its pairs: about the origin a slight turn would carry it beside the trunk.
Stance makeStance(MirrorPlane plane, const vec3& up) {
    const vec3 middle = plane.middle - (glm::dot(plane.middle, plane.normal) - plane.offset) * plane.normal;
    for (int axis = 0; axis < 3; ++axis) {
        vec3 unit(0);
        unit[axis] = 1.0F;
        const float cosine = glm::dot(unit, plane.normal);
        if (std::abs(cosine) < kSnapCosine) continue;
        plane.normal = unit;
    }
    plane.normal = glm::normalize(plane.normal - glm::dot(plane.normal, up) * up);
    plane.offset = glm::dot(middle, plane.normal);
    return {plane, up};
}

constexpr float kLeanPrior = -3.0F;
constexpr float kMostLean = 0.3F;  // sine between the mirror plane and the up axis

// The up axes of figures that lean as a whole: to their side, where the plane tells by how much, or to the front or
// back in it.
std::vector<UpAxis> leaningUps(const MirrorPlane& plane) {
    constexpr float kMostSideways = 0.8F;
    const vec3 vertical(0, 1, 0);
    const float sideways = glm::dot(plane.normal, vertical);
    if (std::abs(sideways) > kMostSideways) return {};
    const vec3 up = glm::normalize(vertical - sideways * plane.normal);
    const vec3 through = glm::cross(plane.normal, up);
    std::vector<UpAxis> ups;
    if (std::abs(sideways) > kMostLean) ups.push_back({up, kLeanPrior, true});
    for (const float angle : {-45.0F, -30.0F, 30.0F, 45.0F})
        ups.push_back({std::cos(radians(angle)) * up + std::sin(radians(angle)) * through, kLeanPrior, true});
    return ups;
}

// Reads the rig with that up axis, where the plane holds it, and keeps the better reading.
void readUpright(const RigFeatures& rig, const MirrorPlane& plane, float agreement, const UpAxis& up, Figure& best) {
    if (std::abs(glm::dot(plane.normal, up.axis)) > kMostLean) return;
    Figure figure = readInStance(rig, makeStance(plane, up.axis), up, agreement);
    if (better(figure, best)) best = std::move(figure);
}

}  // namespace

Figure findFigure(const RigFeatures& rig) {
    const UpAxis upright{{0, 1, 0}, 0.0F};
    const UpAxis lying[] = {
        {{0, 0, 1}, -3.0F}, {{0, -1, 0}, -5.0F}, {{0, 0, -1}, -4.0F}, {{1, 0, 0}, -4.0F}, {{-1, 0, 0}, -4.0F}};
    Figure best;
    best.refusal = "no joints that mirror each other: nothing here has a left and a right limb";
    const std::vector<MirrorPlane> planes = findMirrorPlanes(rig);
    const auto agreement = [&](const MirrorPlane& plane) {
        return kAgreement * (plane.agreement - planes.front().agreement);
    };
    // +Y is what nearly every file has by now: the others are read only where it fails.
    for (const MirrorPlane& plane : planes)
        readUpright(rig, plane, agreement(plane), upright, best);
    // Where the likeliest plane leans, an upright reading is made of skirts and hair in another one.
    const bool leans = !planes.empty() && std::abs(glm::dot(planes.front().normal, upright.axis)) > kMostLean;
    const bool complete = !losesItsHead(rig, best) && !losesItsHips(rig, best);
    if (best.refusal.empty() && !leans && !best.crossed && complete) return best;
    for (const MirrorPlane& plane : planes) {
        for (const UpAxis& up : leaningUps(plane))
            readUpright(rig, plane, agreement(plane), up, best);
    }
    const std::optional<Stance> stance = stanceOfNames(rig);
    Figure posed;
    if (stance) posed = readInStance(rig, *stance, {stance->up, kLeanPrior, false, true}, 0.0F);
    // Of fewer joints, names are fewer, too: where such a figure lies straight its feet tell more of its sides.
    const bool ofAllJoints = posed.legs.named && posed.arms.named;
    // What names tell whole needs not be likelier than what is refused: a bow stands in line with nothing.
    const auto takePosed = [&] {
        const bool told = posed.refusal.empty() && !best.refusal.empty();
        if (told || better(posed, best)) best = std::move(posed);
    };
    if (stance && ofAllJoints) takePosed();
    for (const UpAxis& up : lying) {
        if (best.refusal.empty()) break;
        for (const MirrorPlane& plane : planes)
            readUpright(rig, plane, agreement(plane), up, best);
    }
    if (stance && !ofAllJoints && !best.refusal.empty()) takePosed();
    return best;
}

}  // namespace lutka::animation
