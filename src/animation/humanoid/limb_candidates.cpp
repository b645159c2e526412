#include "animation/humanoid/limb_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "animation/humanoid/limb_evidence.hpp"
#include "animation/humanoid/limb_links.hpp"
#include "animation/humanoid/limb_reach.hpp"

namespace lutka::animation {
namespace {

using namespace limb_costs;
using namespace limb_bounds;
namespace terms = limb_terms;

constexpr vec3 kDown{0, -1, 0};

float angleTerm(const vec3& a, const vec3& b, const LimbTerm& term) {
    const float lengths = glm::length(a) * glm::length(b);
    if (lengths <= 0.0F) return kNoDirection;
    return term.atLeast(glm::dot(a, b) / lengths);
}

bool likelier(const LimbCandidate& a, const LimbCandidate& b) {
    return a.score > b.score;
}

class LimbFinder {
  public:
    LimbFinder(const FramedRig& framed, LimbKind kind)
        : framed_(framed),
          kind_(kind),
          parts_(partsOf(kind)),
          links_(framed, kind),
          reach_(framed.pairs.size(), -1.0F) {
        const int count = static_cast<int>(framed.pairs.size());
        for (int pair = 0; pair < count; ++pair)
            place_.push_back(skinTerm(pair));
        if (kind == LimbKind::arm) findClavicles();
    }

    std::vector<LimbCandidate> find() {
        for (int root = 0; root < static_cast<int>(framed_.pairs.size()); ++root)
            findFrom(root);
        std::stable_sort(found_.begin(), found_.end(), likelier);
        if (found_.size() > kMost) found_.resize(kMost);
        return found_;
    }

  private:
    [[nodiscard]] const JointPair& at(int pair) const { return framed_.pairs[pair]; }

    [[nodiscard]] float skinTerm(int pair) const {
        const float shadow = at(pair).shadow ? kShadow : 0.0F;
        if (!framed_.rig->skinned) return shadow;
        return shadow + (at(pair).ownWeight > 0.0F ? 0.0F : kNoOwnSkin) +
               (at(pair).subtreeWeight > 0.0F ? 0.0F : kNoSkinBelow);
    }
    [[nodiscard]] float placing(int pair, int slot) const { return place_[pair] + nameTerm(pair, slot); }

    [[nodiscard]] float nameTerm(int pair, int slot) const {
        const RigFeatures& rig = *framed_.rig;
        const int joint = at(pair).joints[0];
        const int parent = rig.parents[joint];
        const NameEvidence& name = rig.names[joint];
        const bool second = parent != kNoJoint && !name.bareLimb && isSecondSegment(rig.names[parent], name);
        return at(pair).names[parts_[slot]] + (second ? kSecondSegment : 0.0F);
    }

    // A limb of one joint may start anywhere along it: proportions bind it less.
    [[nodiscard]] static float slackOf(const LimbCandidate& limb) {
        return limb.pairs[1] == kNoPair ? kSlackOfOneJoint : 1.0F;
    }

    // All readings that start at a pair: of one joint, two and three; the best few are kept.
    void findFrom(int root) {
        best_.clear();
        LimbCandidate candidate;
        candidate.kind = kind_;
        candidate.first = root;
        candidate.root = at(root).position;
        candidate.pairs = {root, kNoPair, kNoPair, kNoPair};
        candidate.missing = kMissingEnd + kMissingMiddle;
        consider(candidate, 0.0F);
        for (const int middle : links_.next(root)) {
            if (!mayFollow(root, middle, 1)) continue;
            candidate.pairs = {root, middle, kNoPair, kNoPair};
            candidate.missing = kMissingEnd;
            consider(candidate, links_.link(root, middle));
            findEndsFrom(candidate);
        }
        std::stable_sort(best_.begin(), best_.end(), likelier);
        best_.resize(std::min(best_.size(), kPerRoot));
        found_.insert(found_.end(), best_.begin(), best_.end());
    }

    // The readings of three joints that go on from one of two.
    void findEndsFrom(LimbCandidate candidate) {
        const int root = candidate.pairs[0];
        const int middle = candidate.pairs[1];
        candidate.missing = 0.0F;
        for (const int end : links_.next(middle)) {
            if (end == root || !mayFollow(middle, end, 2) || framed_.rig->isOneOfFingers(at(end).joints[0])) continue;
            const float ratio = framed_.segment(root, middle) / framed_.segment(middle, end);
            if (ratio < kLeastRatio || ratio > kMostRatio) continue;
            candidate.pairs[2] = end;
            consider(candidate, links_.link(root, middle) + links_.link(middle, end));
        }
    }

    [[nodiscard]] bool mayFollow(int from, int to, int slot) const {
        return framed_.segment(from, to) >= kShortestSegment * framed_.spread &&
               (rightWay(from, to) || (links_.isNamed(from, slot - 1) && links_.isNamed(to, slot)));
    }

    // Legs go down but for those of seated and kneeling figures, which their names tell; arms may go anywhere.
    [[nodiscard]] bool rightWay(int from, int to) const {
        return kind_ == LimbKind::arm || at(to).position.y < at(from).position.y;
    }

    // Scores a reading and holds it; they are thinned before they grow too many.
    void consider(LimbCandidate candidate, float links) {
        candidate.score = links + candidate.missing;
        candidate.names = 0.0F;
        const auto& [upper, lower, end, extra] = candidate.pairs;
        candidate.told = lower != kNoPair && links_.isNamed(upper, 0) && links_.isNamed(lower, 1) &&
                         (end == kNoPair || links_.isNamed(end, 2));
        candidate.named = candidate.told && end != kNoPair;
        // Where names tell the stance, then also that a limb has one joint, or none between the first and its end.
        const bool shorter = framed_.stance.byNames && end == kNoPair && links_.isNamed(upper, 0) &&
                             (lower == kNoPair || links_.isNamed(lower, 2));
        const int last = lower == kNoPair ? upper : lower;
        candidate.whole = candidate.named || ((candidate.told || shorter) && links_.endsThere(last));
        kind_ == LimbKind::leg ? scoreLeg(candidate) : scoreArm(candidate);
        candidate.score += leftOver(candidate);
        nameByWords(candidate);
        for (int slot = 0; slot < 3; ++slot) {
            if (candidate.pairs[slot] == kNoPair) continue;
            candidate.score += placing(candidate.pairs[slot], slot) + kJoint;
            candidate.names += nameTerm(candidate.pairs[slot], slot);
        }
        if (candidate.score <= kImpossible) return;
        best_.push_back(candidate);
        if (best_.size() <= kHeldPerRoot) return;
        std::nth_element(best_.begin(), best_.begin() + kPerRoot, best_.end(), likelier);
        best_.resize(kPerRoot);
    }

    // A limb that is read as shorter than its chain of skinned joints.
    [[nodiscard]] float leftOver(const LimbCandidate& limb) const {
        if (limb.pairs[2] != kNoPair) return 0.0F;
        const int last = limb.pairs[1] != kNoPair ? limb.pairs[1] : limb.pairs[0];
        if (links_.endsThere(last)) return 0.0F;
        return limb.pairs[1] != kNoPair ? kLeftOverAfterTwo : kLeftOverAfterOne;
    }

    // Limbs of one or two joints: the last one may be the hand or foot, if its name says so.
    void nameByWords(LimbCandidate& limb) const {
        auto& [root, middle, end, extra] = limb.pairs;
        if (end != kNoPair) return;
        int& last = middle != kNoPair ? middle : root;
        const PartScores& names = at(last).names;
        const float asEnd = names[parts_[2]];
        if (asEnd > names[middle != kNoPair ? parts_[1] : parts_[0]] + kEndWordLead && asEnd > 0.0F) {
            end = last;
            last = kNoPair;
        }
    }

    void measure(LimbCandidate& limb) const {
        const auto& [root, middle, end, extra] = limb.pairs;
        if (end != kNoPair) {
            limb.tip = at(end).position;
            limb.length = framed_.segment(root, middle) + framed_.segment(middle, end);
            return;
        }
        // The end of the skin below the last joint stands for the joint that is not there.
        const int last = middle != kNoPair ? middle : root;
        limb.tip = endOfSkin(framed_, kind_, root, last);
        const float before = middle != kNoPair ? framed_.segment(root, middle) : 0.0F;
        limb.length = before + glm::distance(at(last).position, limb.tip);
    }

    void scoreLeg(LimbCandidate& leg) const {
        measure(leg);
        const auto& [upper, lower, foot, toes] = leg.pairs;
        const float length = leg.length;
        if (length < kShortestLimb * kShortestSegment * framed_.spread) {
            leg.score += kImpossible;
            return;
        }
        float pose = angleTerm(leg.tip - leg.root, kDown, terms::kLegDown);
        float proportions = terms::kThighAside.near(leg.root.x / length, slackOf(leg));
        if (leg.root.x < kMiddle * length) leg.score += kInMiddle;
        const float height = std::max(leg.root.y - framed_.floor, kLeastHipHeight * length);
        const float heightOfTip = (leg.tip.y - framed_.floor) / height;
        pose += (foot != kNoPair ? terms::kAnkleHeight : terms::kSkinEndHeight).near(heightOfTip);
        if (lower != kNoPair) pose += angleTerm(at(lower).position - leg.root, kDown, terms::kThighDown);
        if (foot != kNoPair) {
            proportions +=
                terms::kThighToShin.near(std::log(framed_.segment(upper, lower) / framed_.segment(lower, foot)));
            pose += angleTerm(at(foot).position - at(lower).position, kDown, terms::kShinDown);
            addToes(leg, height);
        } else if (lower != kNoPair) {
            const float thigh = framed_.segment(upper, lower);
            proportions += terms::kThighToRest.near(std::log(thigh / (length - thigh + 1e-6F)));
        }
        leg.score += poseOf(leg, pose) + proportionsOf(leg, proportions) + unusedAbove(upper, length);
    }

    // A limb whose names are clear may be posed in any way.
    [[nodiscard]] static float poseOf(const LimbCandidate& limb, float pose) {
        return limb.whole ? std::max(pose, kNamedPose) : pose;
    }

    // Chibis and giants have limbs of any proportions.
    [[nodiscard]] static float proportionsOf(const LimbCandidate& limb, float proportions) {
        return limb.whole ? std::max(proportions, kNamedProportions) : proportions;
    }

    void addToes(LimbCandidate& leg, float height) const {
        const int foot = leg.pairs[2];
        float best = 0.0F;
        for (int pair = 0; pair < static_cast<int>(framed_.pairs.size()); ++pair) {
            // In a flat hierarchy names tell whose toes they are.
            const bool below = framed_.isAbove(foot, pair);
            const bool told = links_.isNamed(foot, 2) && links_.isSurelyNamed(pair, 3);
            if (!below && !(told && links_.mayContinueDetached(foot, pair))) continue;
            const vec3 away = at(pair).position - at(foot).position;
            const float distance = framed_.segment(foot, pair) / height;
            // Toes by their names may point up: in a bow the legs slant in the trunk's upright.
            if (distance < kShortestToes || (!told && away.y > kHighestToes * leg.length)) continue;
            const float sideways = std::abs(away.x) / (glm::length(away) + 1e-6F);
            const float score = kToes + placing(pair, 3) + terms::kToeDistance.near(distance) +
                                terms::kToesSideways.atMost(sideways) +
                                (below ? links_.skipped(foot, pair, false) : kDetachedNamed);
            if (score <= best) continue;
            best = score;
            leg.pairs[3] = pair;
        }
        leg.score += best;
        if (leg.pairs[3] != kNoPair) leg.names += nameTerm(leg.pairs[3], 3);
    }

    void scoreArm(LimbCandidate& arm) const {
        measure(arm);
        const auto& [upper, lower, hand, clavicle] = arm.pairs;
        const float length = arm.length;
        if (length < kShortestLimb * kShortestSegment * framed_.spread) {
            arm.score += kImpossible;
            return;
        }
        const vec3 along = (arm.tip - arm.root) / (glm::distance(arm.tip, arm.root) + 1e-6F);
        float pose = terms::kArmOut.atLeast(along.x) + terms::kArmRaised.atMost(along.y);
        float proportions = terms::kShoulderAside.near(arm.root.x / length, slackOf(arm));
        if (arm.root.x < kMiddle * length) arm.score += kInMiddle;
        if (hand != kNoPair) {
            const vec3 first = at(lower).position - arm.root;
            const vec3 second = at(hand).position - at(lower).position;
            proportions +=
                terms::kUpperToFore.near(std::log(framed_.segment(upper, lower) / framed_.segment(lower, hand)));
            pose += angleTerm(first, second, terms::kElbowStraight);
            proportions += beyondTerm(hand, length);
        } else if (lower != kNoPair) {
            const float first = framed_.segment(upper, lower);
            proportions += terms::kUpperToRest.near(std::log(first / (length - first + 1e-6F)));
        }
        arm.score += poseOf(arm, pose) + proportionsOf(arm, proportions);
        addClavicle(arm);
    }

    // Beyond the hand there are fingers, not another segment.
    [[nodiscard]] float beyondTerm(int hand, float length) const {
        float& known = reach_[hand];
        if (known < 0.0F) known = reachBeyond(framed_, hand);
        const float reach = known / length;
        return reach > 0.0F ? terms::kBeyondHand.near(reach) : kNothingBeyondHand;
    }

    // The pair above the upper arm (or beside it) that is likeliest its clavicle, if that is likelier than none.
    void addClavicle(LimbCandidate& arm) const {
        const int upper = arm.pairs[0];
        float best = unusedAbove(upper, arm.length);
        for (const int pair : clavicles_[upper]) {
            const float score = clavicleTerm(arm, pair);
            if (score <= best) continue;
            best = score;
            arm.pairs[3] = pair;
        }
        arm.score += best;
        if (arm.pairs[3] != kNoPair) arm.names += nameTerm(arm.pairs[3], 3);
    }

    // Per pair the pairs above or beside it that may be its clavicle.
    void findClavicles() {
        const int count = static_cast<int>(framed_.pairs.size());
        clavicles_.resize(framed_.pairs.size());
        for (int upper = 0; upper < count; ++upper) {
            for (int pair = 0; pair < count; ++pair) {
                const bool may = framed_.isAbove(pair, upper) || areSiblings(pair, upper);
                if (may && links_.skipped(pair, upper, false) > kImpossible) clavicles_[upper].push_back(pair);
            }
        }
    }

    [[nodiscard]] float clavicleTerm(const LimbCandidate& arm, int pair) const {
        const int upper = arm.pairs[0];
        const bool beside = areSiblings(pair, upper);
        const float length = framed_.segment(pair, upper) / arm.length;
        if (length < kShortestClavicle) return kImpossible;
        const float shape =
            terms::kClavicleLength.near(length) + terms::kClavicleAside.near(at(pair).position.x / arm.length);
        const bool named = links_.isNamed(pair, 3) && links_.isNamed(upper, 0);
        return kClavicle + placing(pair, 3) + (named ? std::max(shape, kNamedProportions) : shape) +
               links_.skipped(pair, upper, false) + unusedAbove(pair, arm.length) + (beside ? kDetached : 0.0F);
    }

    // A clavicle may hang beside the upper arm instead of above it.
    [[nodiscard]] bool areSiblings(int pair, int upper) const {
        const RigFeatures& rig = *framed_.rig;
        const auto& a = at(pair).joints;
        const auto& b = at(upper).joints;
        return pair != upper && rig.children[a[0]].empty() && rig.children[a[1]].empty() &&
               rig.parents[a[0]] == rig.parents[b[0]] && rig.parents[a[1]] == rig.parents[b[1]];
    }

    // Skinned pairs above the first one that the reading leaves over.
    [[nodiscard]] float unusedAbove(int first, float length) const {
        float total = 0.0F;
        for (const int pair : links_.above(first)) {
            const bool counts = !framed_.rig->skinned || at(pair).ownWeight > 0.0F;
            if (counts && !at(pair).helper && at(pair).position.x > kMiddle * length) total += kUnusedAbove;
        }
        return total;
    }

    const FramedRig& framed_;
    LimbKind kind_;
    std::array<Part, 4> parts_;
    LimbLinks links_;
    std::vector<float> place_;
    std::vector<std::vector<int>> clavicles_;
    mutable std::vector<float> reach_;  // reachBeyond() of every pair once asked for, -1 before
    std::vector<LimbCandidate> best_;
    std::vector<LimbCandidate> found_;
};

}  // namespace

std::vector<LimbCandidate> findLimbs(const FramedRig& framed, LimbKind kind) {
    return LimbFinder(framed, kind).find();
}

}  // namespace lutka::animation
