#include "animation/humanoid/trunk_candidates.hpp"

#include <algorithm>
#include <cmath>

#include "animation/humanoid/evidence_terms.hpp"

namespace lutka::animation {
namespace {

constexpr float kNoOwnSkin = -1.0F;
constexpr float kNoSkinBelow = -3.0F;
constexpr float kOneJointTrunk = -3.0F;  // hips and chest in one
constexpr float kHeadless = -3.0F;
constexpr std::size_t kHeadsTried = 6;
constexpr float kFarAway = 1e8F;

class TrunkFinder {
  public:
    TrunkFinder(const FramedRig& framed, const LimbCandidate& legs, const LimbCandidate& arms)
        : framed_(framed),
          rig_(*framed.rig),
          legs_(legs),
          arms_(arms),
          length_(std::max(arms.root.y - legs.root.y, 0.05F * framed.spread)) {
        const auto& leg = framed.pairs[legs.first].joints;
        const auto& arm = framed.pairs[arms.first].joints;
        legParent_ = rig_.commonAncestor(leg[0], leg[1]);
        armParent_ = rig_.commonAncestor(arm[0], arm[1]);
        trunkRoot_ =
            legParent_ == kNoJoint || armParent_ == kNoJoint ? kNoJoint : rig_.commonAncestor(legParent_, armParent_);
        for (int joint = 0; joint < rig_.count(); ++joint) {
            if (isCentral(joint)) central_.push_back(joint);
        }
    }

    TrunkCandidate find(const TrunkBan& ban) {
        TrunkCandidate best;
        const auto [hips, hipsScore] = bestHips(ban.hips);
        if (hips == kNoJoint) return best;
        const auto heads = likelyHeads(ban.head);
        for (const auto& [head, headScore] : heads) {
            for (const int chest : central_) {
                if (chest == ban.chest) continue;
                TrunkCandidate candidate{hips, chest, kNoJoint, head, 0.0F};
                candidate.score = hipsScore + headScore + chestScore(candidate);
                if (candidate.score <= best.score) continue;
                candidate.neck = lowestNeck(candidate);
                best = candidate;
            }
        }
        return best;
    }

    std::vector<int> spine(const TrunkCandidate& trunk) const {
        std::vector<int> joints;
        const float low = std::max(position(trunk.hips).y, legs_.root.y) + 0.03F * length_;
        for (int joint = rig_.parents[trunk.chest]; joint != kNoJoint && joint != trunk.hips;
             joint = rig_.parents[joint]) {
            const bool between = position(joint).y > std::min(low, position(trunk.chest).y) &&
                                 position(joint).y < arms_.root.y + 0.1F * length_;
            const NameEvidence& name = rig_.names[joint];
            const bool otherPart = name.meaningful && name.parts[Part::trunk] < 0.0F && name.parts[Part::chest] < 0.0F;
            if (isCentral(joint) && between && !name.helper && !otherPart) joints.push_back(joint);
        }
        // Unskinned joints only where the spine has no others.
        const auto skinned = [&](int joint) { return rig_.ownWeight[joint] > 0.0F; };
        if (std::any_of(joints.begin(), joints.end(), skinned)) {
            joints.erase(std::remove_if(joints.begin(), joints.end(), [&](int joint) { return !skinned(joint); }),
                         joints.end());
        }
        std::reverse(joints.begin(), joints.end());
        return joints;
    }

  private:
    struct Scored {
        int joint;
        float score;
    };

    [[nodiscard]] const vec3& position(int joint) const { return framed_.positions[joint]; }
    [[nodiscard]] float name(int joint, Part part) const { return rig_.names[joint].parts[part]; }

    [[nodiscard]] bool isCentral(int joint) const {
        const int pair = framed_.pairOf[joint];
        if (pair >= 0 && (legs_.uses(pair) || arms_.uses(pair))) return false;
        return std::abs(position(joint).x) < 0.12F * length_ && pair < 0;
    }

    [[nodiscard]] float skinTerm(int joint) const {
        if (!rig_.skinned) return 0.0F;
        return (rig_.ownWeight[joint] > 0.0F ? 0.0F : kNoOwnSkin) +
               (rig_.subtreeWeight[joint] > 0.0F ? 0.0F : kNoSkinBelow);
    }
    [[nodiscard]] float centralTerm(int joint) const { return near(position(joint).x / length_, 0.0F, 0.05F, 3.0F); }

    [[nodiscard]] Scored bestHips(int banned) const {
        Scored best{kNoJoint, -kFarAway};
        for (const int joint : central_) {
            if (joint == banned) continue;
            const float height = (position(joint).y - legs_.root.y) / length_;
            float score = name(joint, Part::hips) + skinTerm(joint) + centralTerm(joint) +
                          near(height, 0.05F, 0.15F, 6.0F) +
                          near((position(joint).z - legs_.root.z) / length_, 0.0F, 0.25F, 4.0F);
            if (trunkRoot_ != kNoJoint && rig_.isAncestorOrSelf(joint, trunkRoot_)) score += 1.0F;
            if (joint == trunkRoot_) score += 0.5F;
            // The joint above would be the hips if it moves skin at the same height.
            const int parent = rig_.parents[joint];
            if (parent != kNoJoint && isCentral(parent) && rig_.ownWeight[parent] > 0.0F &&
                std::abs(position(parent).y - legs_.root.y) < 0.25F * length_) {
                score -= 0.7F;
            }
            if (score > best.score) best = {joint, score};
        }
        return best;
    }

    [[nodiscard]] std::vector<Scored> likelyHeads(int banned) const {
        float skinAbove = 0.0F;
        std::vector<int> joints;
        for (const int joint : central_) {
            if (position(joint).y < arms_.root.y - 0.15F * length_ || joint == banned) continue;
            joints.push_back(joint);
            if (!rig_.isAncestorOrSelf(joint, armRoot())) skinAbove = std::max(skinAbove, rig_.subtreeWeight[joint]);
        }
        std::vector<Scored> heads;
        for (const int joint : joints) {
            float score = name(joint, Part::head) + skinTerm(joint) + centralTerm(joint) +
                          near((position(joint).y - arms_.root.y) / length_, 0.32F, 0.2F, 5.0F) +
                          near((position(joint).z - arms_.root.z) / length_, 0.0F, 0.3F, 3.0F);
            if (skinAbove > 0.0F) score += 2.0F * std::min(rig_.subtreeWeight[joint] / skinAbove, 1.0F);
            if (rig_.isAncestorOrSelf(joint, armRoot())) score -= 6.0F;
            heads.push_back({joint, score});
        }
        std::stable_sort(heads.begin(), heads.end(),
                         [](const Scored& a, const Scored& b) { return a.score > b.score; });
        if (heads.size() > kHeadsTried) heads.resize(kHeadsTried);
        heads.push_back({kNoJoint, kHeadless});
        return heads;
    }

    [[nodiscard]] int armRoot() const { return framed_.pairs[arms_.first].joints[0]; }

    [[nodiscard]] float chestScore(const TrunkCandidate& trunk) const {
        const int chest = trunk.chest;
        const vec3& place = position(chest);
        if (chest == trunk.head) return -kFarAway;
        if (trunk.head != kNoJoint && rig_.isAncestorOrSelf(trunk.head, chest)) return -kFarAway;
        if (chest != trunk.hips && rig_.isAncestorOrSelf(chest, trunk.hips)) return -kFarAway;
        float score = skinTerm(chest) + centralTerm(chest) + near((place.z - arms_.root.z) / length_, 0.0F, 0.3F, 4.0F);
        score +=
            chest == trunk.hips ? kOneJointTrunk + std::max(name(chest, Part::chest), 0.0F) : name(chest, Part::chest);
        if (chest == armParent_ && chest != trunk.hips) {
            score += 2.5F;
        } else if (!rig_.isAncestorOrSelf(chest, armRoot())) {
            score -= 0.5F;
        }
        if (chest != trunk.hips) {
            const float below = (arms_.root.y - place.y) / length_;
            score += near(below, 0.2F, 0.2F, 5.0F) + atMost(-below, 0.08F, 0.05F, 3.0F);
            if (rig_.isAncestorOrSelf(trunk.hips, chest)) score += 0.5F;
        }
        if (trunk.head == kNoJoint) return score;
        score += near((position(trunk.head).y - place.y) / length_, 0.5F, 0.22F, 4.0F);
        return score + neckScore(trunk);
    }

    // How many joints lie between chest and head, and what they are called.
    [[nodiscard]] float neckScore(const TrunkCandidate& trunk) const {
        const std::vector<int> necks = necksOf(trunk);
        constexpr float kByCount[] = {-0.4F, 0.0F, -0.4F, -1.0F};
        float score = kByCount[std::min<std::size_t>(necks.size(), 3)];
        if (!necks.empty()) score += name(lowestNeck(trunk), Part::neck);
        return score;
    }

    [[nodiscard]] std::vector<int> necksOf(const TrunkCandidate& trunk) const {
        std::vector<int> necks;
        if (trunk.head == kNoJoint) return necks;
        for (int joint = rig_.parents[trunk.head]; joint != kNoJoint && joint != trunk.chest;
             joint = rig_.parents[joint]) {
            if (rig_.isAncestorOrSelf(joint, trunk.chest)) break;
            const bool between = position(joint).y > position(trunk.chest).y - 0.02F * length_;
            if (isCentral(joint) && between) necks.push_back(joint);
        }
        return necks;
    }

    [[nodiscard]] int lowestNeck(const TrunkCandidate& trunk) const {
        int best = kNoJoint;
        float bestScore = -kFarAway;
        for (const int joint : necksOf(trunk)) {
            const float score = name(joint, Part::neck) + (rig_.ownWeight[joint] > 0.0F || !rig_.skinned ? 0.5F : 0.0F);
            if (score < bestScore) continue;
            bestScore = score;
            best = joint;
        }
        return best;
    }

    const FramedRig& framed_;
    const RigFeatures& rig_;
    const LimbCandidate& legs_;
    const LimbCandidate& arms_;
    float length_;  // from the thighs up to the upper arms
    int legParent_ = kNoJoint;
    int armParent_ = kNoJoint;
    int trunkRoot_ = kNoJoint;
    std::vector<int> central_;
};

}  // namespace

TrunkCandidate findTrunk(const FramedRig& framed, const LimbCandidate& legs, const LimbCandidate& arms,
                         const TrunkBan& ban) {
    return TrunkFinder(framed, legs, arms).find(ban);
}

std::vector<int> spineBetween(const FramedRig& framed, const TrunkCandidate& trunk, const LimbCandidate& legs,
                              const LimbCandidate& arms) {
    return TrunkFinder(framed, legs, arms).spine(trunk);
}

}  // namespace lutka::animation
