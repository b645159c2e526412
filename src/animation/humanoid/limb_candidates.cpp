#include "animation/humanoid/limb_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "animation/humanoid/evidence_terms.hpp"

namespace lutka::animation {
namespace {

// A limb that lacks joints is the less likely reading of a chain that has them.
constexpr float kMissingEnd = -2.5F;
constexpr float kMissingMiddle = -2.5F;
constexpr float kNoOwnSkin = -1.2F;
constexpr float kNoSkinBelow = -2.5F;
constexpr float kDetachedFromMore = -6.0F;  // … though the limb has joints to go on with
constexpr float kDetached = -1.5F;          // the next joint is not below this one in the tree
constexpr float kShadow = -3.0F;
constexpr float kMainBranch = 0.7F;
constexpr float kInMiddle = -3.5F;               // thighs and upper arms never start in the mirror plane
constexpr float kSecondSegment = -4.0F;          // named like the joint above it: "upper_arm.L.001"
constexpr float kSkippedJoint = -0.4F;           // a skinned joint between two placed ones: twist, or a second segment
constexpr float kShortestSegment = 0.02F;        // of the spread
constexpr std::size_t kMostPairsDetached = 200;  // any pair may follow any other: time grows with the cube
constexpr std::size_t kPerRoot = 3;
constexpr std::size_t kMost = 48;

float angleTerm(const vec3& a, const vec3& b, float cosineLimit, float deviation) {
    const float lengths = glm::length(a) * glm::length(b);
    if (lengths <= 0.0F) return -1.0F;
    return atLeast(glm::dot(a, b) / lengths, cosineLimit, deviation);
}

class LimbFinder {
  public:
    LimbFinder(const FramedRig& framed, LimbKind kind) : framed_(framed), kind_(kind), parts_(partsOf(kind)) {
        const int count = static_cast<int>(framed.pairs.size());
        for (int pair = 0; pair < count; ++pair)
            place_.push_back(skinTerm(pair));
        findRelations();
        findEnds();
        findLinks();
    }

    std::vector<LimbCandidate> find() {
        for (int root = 0; root < static_cast<int>(framed_.pairs.size()); ++root)
            findFrom(root);
        std::stable_sort(found_.begin(), found_.end(),
                         [](const LimbCandidate& a, const LimbCandidate& b) { return a.score > b.score; });
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
        const bool second = parent != kNoJoint && name.meaningful && !name.bareLimb &&
                            name.words == rig.names[parent].words && name.side == rig.names[parent].side;
        return at(pair).names[parts_[slot]] + (second ? kSecondSegment : 0.0F);
    }

    // A limb of one joint may start anywhere along it: proportions bind it less.
    [[nodiscard]] static float slackOf(const LimbCandidate& limb) { return limb.pairs[1] == kNoPair ? 3.0F : 1.0F; }

    void findRelations() {
        const int count = static_cast<int>(framed_.pairs.size());
        above_.resize(framed_.pairs.size());
        below_.resize(framed_.pairs.size());
        for (int upper = 0; upper < count; ++upper) {
            for (int lower = 0; lower < count; ++lower) {
                if (!framed_.isAbove(upper, lower)) continue;
                below_[upper].push_back(lower);
                above_[lower].push_back(upper);
            }
        }
        reach_.assign(framed_.pairs.size(), -1.0F);
    }

    void findLinks() {
        const int count = static_cast<int>(framed_.pairs.size());
        for (int upper = 0; upper < count; ++upper) {
            for (int lower = 0; lower < count; ++lower)
                links_.push_back(linkTerm(upper, lower));
        }
    }
    [[nodiscard]] float link(int upper, int lower) const {
        return links_[static_cast<std::size_t>(upper) * framed_.pairs.size() + static_cast<std::size_t>(lower)];
    }

    void findEnds() {
        endsThere_.assign(framed_.pairs.size(), true);
        for (const JointPair& pair : framed_.pairs) {
            if (framed_.rig->skinned && pair.ownWeight <= 0.0F) continue;
            const int parent = framed_.rig->parents[pair.joints[0]];
            for (int joint = parent; joint != kNoJoint; joint = framed_.rig->parents[joint]) {
                if (framed_.pairOf[joint] >= 0) endsThere_[framed_.pairOf[joint]] = false;
            }
        }
    }

    // Skinned joints that lie between two placed ones and are passed over: twist joints and second segments lie on the
    // straight line between them, an elbow or a knee does not.
    [[nodiscard]] float skipped(int upper, int lower, bool straight = true) const {
        float total = 0.0F;
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
            total += kSkippedJoint;
            if (straight) total += near(glm::length(off) / std::sqrt(square), 0.0F, 0.06F, 2.0F);
        }
        return total;
    }

    // A limb goes on where most of the skin does: hands before thumbs, shins before pockets.
    [[nodiscard]] float mainBranchTerm(int upper, int lower) const {
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
        return kMainBranch * std::max(total, -4.0F);
    }

    // Whether `lower` may follow `upper` though it hangs elsewhere: rigs with feet under a control root, flat trees.
    [[nodiscard]] bool mayContinueDetached(int upper, int lower) const {
        if (framed_.pairs.size() > kMostPairsDetached) return false;
        if (framed_.isAbove(lower, upper) || upper == lower) return false;
        const RigFeatures& rig = *framed_.rig;
        if (rig.skinned && at(lower).ownWeight <= 0.0F) return false;
        for (int joint = rig.parents[at(lower).joints[0]]; joint != kNoJoint; joint = rig.parents[joint]) {
            const int pair = framed_.pairOf[joint];
            if (pair >= 0 && (!rig.skinned || at(pair).ownWeight > 0.0F)) return false;
        }
        return true;
    }

    // 0 below it in the tree, a loss where detached, kImpossible otherwise.
    static constexpr float kImpossible = -100.0F;
    [[nodiscard]] float linkTerm(int upper, int lower) const {
        if (framed_.isAbove(upper, lower)) return skipped(upper, lower) + mainBranchTerm(upper, lower);
        if (!mayContinueDetached(upper, lower)) return kImpossible;
        return endsThere_[upper] ? kDetached : kDetachedFromMore;
    }

    void findFrom(int root) {
        best_.clear();
        const int count = static_cast<int>(framed_.pairs.size());
        const float shortest = kShortestSegment * framed_.spread;
        LimbCandidate candidate;
        candidate.kind = kind_;
        candidate.first = root;
        candidate.root = at(root).position;
        candidate.pairs = {root, kNoPair, kNoPair, kNoPair};
        candidate.missing = kMissingEnd + kMissingMiddle;
        consider(candidate, 0.0F);
        for (int middle = 0; middle < count; ++middle) {
            const float first = link(root, middle);
            if (first <= kImpossible || framed_.segment(root, middle) < shortest) continue;
            if (!rightWay(root, middle)) continue;
            candidate.pairs = {root, middle, kNoPair, kNoPair};
            candidate.missing = kMissingEnd;
            consider(candidate, first);
            for (int end = 0; end < count; ++end) {
                const float second = end == root ? kImpossible : link(middle, end);
                if (second <= kImpossible || framed_.segment(middle, end) < shortest) continue;
                const float ratio = framed_.segment(root, middle) / framed_.segment(middle, end);
                if (ratio < 0.2F || ratio > 5.0F || !rightWay(middle, end)) continue;
                candidate.pairs = {root, middle, end, kNoPair};
                candidate.missing = 0.0F;
                consider(candidate, first + second);
            }
        }
        std::stable_sort(best_.begin(), best_.end(),
                         [](const LimbCandidate& a, const LimbCandidate& b) { return a.score > b.score; });
        best_.resize(std::min(best_.size(), kPerRoot));
        found_.insert(found_.end(), best_.begin(), best_.end());
    }

    // Legs go down; arms may go anywhere.
    [[nodiscard]] bool rightWay(int from, int to) const {
        return kind_ == LimbKind::arm || at(to).position.y < at(from).position.y;
    }

    void consider(LimbCandidate candidate, float links) {
        candidate.score = links + candidate.missing;
        candidate.names = 0.0F;
        if (kind_ == LimbKind::leg) {
            scoreLeg(candidate);
        } else {
            scoreArm(candidate);
        }
        candidate.score += leftOver(candidate);
        nameByWords(candidate);
        for (int slot = 0; slot < 3; ++slot) {
            if (candidate.pairs[slot] == kNoPair) continue;
            candidate.score += placing(candidate.pairs[slot], slot) + 1.0F;
            candidate.names += nameTerm(candidate.pairs[slot], slot);
        }
        best_.push_back(candidate);
        if (best_.size() > 64) {
            std::nth_element(best_.begin(), best_.begin() + kPerRoot, best_.end(),
                             [](const LimbCandidate& a, const LimbCandidate& b) { return a.score > b.score; });
            best_.resize(kPerRoot);
        }
    }

    // A limb that is read as shorter than its chain of skinned joints.
    [[nodiscard]] float leftOver(const LimbCandidate& limb) const {
        if (limb.pairs[2] != kNoPair) return 0.0F;
        const int last = limb.pairs[1] != kNoPair ? limb.pairs[1] : limb.pairs[0];
        if (endsThere_[last]) return 0.0F;
        return limb.pairs[1] != kNoPair ? -1.0F : -4.0F;
    }

    // Limbs of one or two joints: the last one may be the hand or foot, if its name says so.
    void nameByWords(LimbCandidate& limb) const {
        auto& [root, middle, end, extra] = limb.pairs;
        if (end != kNoPair) return;
        int& last = middle != kNoPair ? middle : root;
        const PartScores& names = at(last).names;
        const float asEnd = names[parts_[2]];
        if (asEnd > names[middle != kNoPair ? parts_[1] : parts_[0]] + 2.0F && asEnd > 0.0F) {
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
        limb.tip = farthest(last);
        const float before = middle != kNoPair ? framed_.segment(root, middle) : 0.0F;
        limb.length = before + glm::distance(at(last).position, limb.tip);
    }

    // Where the skin below a pair (or its joints, or the joint itself) ends: as far down as it goes for a leg, as far
    // away as it goes for an arm.
    [[nodiscard]] vec3 farthest(int pair) const {
        const vec3 from = at(pair).position;
        vec3 tip = from;
        for (int side = 0; side < 2; ++side) {
            const int joint = at(pair).joints[side];
            const bool skin = framed_.subtreeSkin[joint].count > 0;
            const Box& box = skin ? framed_.subtreeSkin[joint] : framed_.subtreeJoints[joint];
            if (box.count == 0) continue;
            const vec3 mean = box.mean();
            const float out = side == 0 ? box.high.x : -box.low.x;
            const bool hangs = kind_ == LimbKind::leg || from.y - box.low.y > out - from.x;
            const vec3 end = hangs ? vec3(std::abs(mean.x), box.low.y, mean.z) : vec3(out, mean.y, mean.z);
            tip = side == 0 ? end : 0.5F * (tip + end);
        }
        return tip;
    }

    void scoreLeg(LimbCandidate& leg) const {
        measure(leg);
        const auto& [upper, lower, foot, toes] = leg.pairs;
        const float length = leg.length;
        if (length < 3.0F * kShortestSegment * framed_.spread) {
            leg.score += kImpossible;
            return;
        }
        leg.score += angleTerm(leg.tip - leg.root, vec3(0, -1, 0), 0.97F, 0.12F);
        leg.score += near(leg.root.x / length, 0.2F, 0.2F * slackOf(leg), 2.0F);
        if (leg.root.x < 0.03F * length) leg.score += kInMiddle;
        const float height = std::max(leg.root.y - framed_.floor, 0.3F * length);
        const float heightOfTip = (leg.tip.y - framed_.floor) / height;
        leg.score += near(heightOfTip, foot != kNoPair ? 0.1F : 0.0F, 0.18F, 5.0F);
        if (lower != kNoPair) {
            leg.score += angleTerm(at(lower).position - leg.root, vec3(0, -1, 0), 0.7F, 0.25F);
        }
        if (foot != kNoPair) {
            leg.score += near(std::log(framed_.segment(upper, lower) / framed_.segment(lower, foot)), 0.05F, 0.3F);
            leg.score += angleTerm(at(foot).position - at(lower).position, vec3(0, -1, 0), 0.88F, 0.08F);
            addToes(leg, height);
        } else if (lower != kNoPair) {
            leg.score +=
                near(std::log(framed_.segment(upper, lower) / (length - framed_.segment(upper, lower) + 1e-6F)), 0.0F,
                     0.45F, 4.0F);
        }
        leg.score += unusedAbove(upper, length);
    }

    void addToes(LimbCandidate& leg, float height) const {
        const int foot = leg.pairs[2];
        float best = 0.0F;
        for (const int pair : below_[foot]) {
            const vec3 away = at(pair).position - at(foot).position;
            const float distance = framed_.segment(foot, pair) / height;
            if (distance < 0.03F || away.y > 0.04F * leg.length) continue;
            const float sideways = std::abs(away.x) / (glm::length(away) + 1e-6F);
            const float score = 1.6F + placing(pair, 3) + near(distance, 0.18F, 0.2F, 3.0F) +
                                atMost(sideways, 0.3F, 0.25F, 3.0F) + skipped(foot, pair, false);
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
        if (length < 3.0F * kShortestSegment * framed_.spread) {
            arm.score += kImpossible;
            return;
        }
        const vec3 along = (arm.tip - arm.root) / (glm::distance(arm.tip, arm.root) + 1e-6F);
        arm.score += atLeast(along.x, 0.0F, 0.15F) + atMost(along.y, 0.3F, 0.3F, 3.0F);
        if (arm.root.x < 0.03F * length) arm.score += kInMiddle;
        if (hand != kNoPair) {
            const vec3 first = at(lower).position - arm.root;
            const vec3 second = at(hand).position - at(lower).position;
            arm.score +=
                near(std::log(framed_.segment(upper, lower) / framed_.segment(lower, hand)), 0.08F, 0.28F, 3.0F);
            arm.score += angleTerm(first, second, 0.75F, 0.3F);
            arm.score += beyondTerm(hand, length);
        } else if (lower != kNoPair) {
            const float first = framed_.segment(upper, lower);
            arm.score += near(std::log(first / (length - first + 1e-6F)), -0.1F, 0.45F, 4.0F);
        }
        addClavicle(arm);
    }

    // How far skinned joints go on below a pair, mean of both sides.
    [[nodiscard]] float reachBeyond(int pair) const {
        float& reach = reach_[pair];
        if (reach >= 0.0F) return reach;
        reach = 0.0F;
        const RigFeatures& rig = *framed_.rig;
        for (const int joint : at(pair).joints) {
            float farthestJoint = 0.0F;
            for (int other = 0; other < rig.count(); ++other) {
                if (!rig.isAncestorOrSelf(joint, other) || (rig.skinned && rig.ownWeight[other] <= 0.0F)) continue;
                farthestJoint =
                    std::max(farthestJoint, glm::distance(framed_.positions[joint], framed_.positions[other]));
            }
            reach += 0.5F * farthestJoint;
        }
        return reach;
    }

    // Beyond the hand there are fingers, not another segment.
    [[nodiscard]] float beyondTerm(int hand, float length) const {
        const float reach = reachBeyond(hand) / length;
        return reach > 0.0F ? near(reach, 0.3F, 0.22F, 4.0F) : -0.3F;
    }

    void addClavicle(LimbCandidate& arm) const {
        const int upper = arm.pairs[0];
        const float base = near(arm.root.x / arm.length, 0.33F, 0.14F * slackOf(arm), 3.0F);
        float best = unusedAbove(upper, arm.length);
        for (int pair = 0; pair < static_cast<int>(framed_.pairs.size()); ++pair) {
            const bool beside = areSiblings(pair, upper);
            if (!framed_.isAbove(pair, upper) && !beside) continue;
            const vec3 position = at(pair).position;
            const float length = framed_.segment(pair, upper) / arm.length;
            if (length < 0.04F) continue;
            const float score = 1.0F + placing(pair, 3) + near(length, 0.28F, 0.13F, 4.0F) +
                                near(position.x / arm.length, 0.08F, 0.12F, 3.0F) + skipped(pair, upper, false) +
                                unusedAbove(pair, arm.length) + (beside ? kDetached : 0.0F);
            if (score <= best) continue;
            best = score;
            arm.pairs[3] = pair;
        }
        arm.score += base + best;
        if (arm.pairs[3] != kNoPair) arm.names += nameTerm(arm.pairs[3], 3);
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
        for (const int pair : above_[first]) {
            const bool counts = !framed_.rig->skinned || at(pair).ownWeight > 0.0F;
            if (counts && !at(pair).helper && at(pair).position.x > 0.03F * length) total -= 0.8F;
        }
        return total;
    }

    const FramedRig& framed_;
    LimbKind kind_;
    std::array<Part, 4> parts_;
    std::vector<float> place_;
    std::vector<std::vector<int>> above_;  // per pair: the pairs above it in the tree
    std::vector<std::vector<int>> below_;
    std::vector<float> links_;          // linkTerm() of every two pairs
    mutable std::vector<float> reach_;  // reachBeyond() of every pair once asked for, -1 before
    std::vector<bool> endsThere_;       // per pair: no skinned pair below it
    std::vector<LimbCandidate> best_;
    std::vector<LimbCandidate> found_;
};

}  // namespace

bool LimbCandidate::uses(int pair) const {
    return std::find(pairs.begin(), pairs.end(), pair) != pairs.end();
}

int LimbCandidate::jointCount() const {
    return static_cast<int>(std::count_if(pairs.begin(), pairs.begin() + 3, [](int pair) { return pair != kNoPair; }));
}

std::array<Part, 4> partsOf(LimbKind kind) {
    if (kind == LimbKind::leg) return {Part::upperLeg, Part::lowerLeg, Part::foot, Part::toes};
    return {Part::upperArm, Part::lowerArm, Part::hand, Part::clavicle};
}

std::vector<LimbCandidate> findLimbs(const FramedRig& framed, LimbKind kind) {
    return LimbFinder(framed, kind).find();
}

}  // namespace lutka::animation
