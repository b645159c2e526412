#include "animation/humanoid/trunk_candidates.hpp"

#include <algorithm>
#include <cmath>

#include "animation/humanoid/evidence_terms.hpp"
#include "animation/humanoid/trunk_measures.hpp"

namespace lutka::animation {
namespace {

constexpr float kNoOwnSkin = -1.0F;
constexpr float kUnskinnedHips = -2.2F;  // besides: controls of the whole body stand where the hips do
constexpr float kNoSkinBelow = -5.0F;
constexpr float kShadow = -3.0F;
constexpr float kOneJointTrunk = -1.5F;   // hips and chest in one
constexpr float kUnskinnedTrunk = -4.0F;  // … that moves no skin
constexpr float kFileRoot = -6.0F;        // of a node without a mesh at the origin, where a block is the trunk
constexpr float kCarriesThighs = 1.5F;    // the parent of told thighs and of all above, where no name says hips
constexpr float kHeadless = -3.0F;
constexpr float kNamedPose = -2.0F;       // the most that the place of a head so named may cost
constexpr float kOfTwoSkeletons = -4.0F;  // of a trunk and what hangs on it, of its copy
constexpr float kArmsAboveChest = -1.5F;  // the arms hang on a joint between chest and neck
constexpr float kArmsBelow = -1.5F;       // of a chest that hangs on what carries the arms and moves more
constexpr float kNamedNoSkin = -2.0F;     // the most that a head so named, on top of all skin, costs without any
constexpr float kCarriesFace = 3.0F;      // eyes or ears hang on it
constexpr float kGoesOnAlike = -1.0F;     // the joint above it is named as its next segment
constexpr float kSpineBelowHead = -4.0F;  // a joint named spine, on which one hangs that may be the head
constexpr float kPartOfFace = -1.5F;      // a leaf that moves next to nothing of what the joint above it does
constexpr float kHeavyChest = 0.15F;      // of the skin: what carries both arms and moves so much is the chest
constexpr float kHeavyNamed = -0.5F;      // … the most that its name may cost
constexpr float kWholeHead = 0.8F;        // of the skin above the arms
constexpr float kWholePose = -1.0F;       // the most that the place of what keeps so much may cost
constexpr std::size_t kHeadsTried = 6;
constexpr std::size_t kHipsTried = 4;
constexpr float kFarAway = 1e8F;

class TrunkFinder : private TrunkMeasures {
  public:
    TrunkFinder(const FramedRig& framed, const LimbCandidate& legs, const LimbCandidate& arms)
        : TrunkMeasures(framed, legs, arms) {}

    TrunkCandidate find(const TrunkBan& ban) {
        TrunkCandidate best;
        const std::vector<Scored> heads = likelyHeads(ban.head);
        const std::vector<int> chests = possibleChests(ban.chest);
        std::vector<float> neckScores;  // of every head on every chest, whatever the hips
        for (const Scored& head : heads) {
            for (const int chest : chests)
                neckScores.push_back(neckScore(chest, head.joint));
        }
        for (const auto& [hips, hipsScore] : likelyHips(ban.hips)) {
            auto neck = neckScores.begin();
            for (const auto& [head, headScore] : heads) {
                for (const int chest : chests) {
                    TrunkCandidate candidate;
                    candidate.hips = hips;
                    candidate.chest = chest;
                    candidate.head = head;
                    candidate.score = hipsScore + headScore + chestScore(candidate, *neck++);
                    if (candidate.score > best.score) best = candidate;
                }
            }
        }
        if (best.hips == kNoJoint) return best;
        best.neck = lowestOf(necksOf(best.chest, best.head));
        account(best);
        return best;
    }

    std::vector<int> spine(const TrunkCandidate& trunk) const {
        std::vector<int> joints;
        const float low = std::max(position(trunk.hips).y, legs_.root.y) + 0.03F * length_;
        const float high = std::max(arms_.root.y + 0.1F * length_, position(trunk.chest).y);
        for (int joint = rig_.parents[trunk.chest]; joint != kNoJoint && joint != trunk.hips;
             joint = rig_.parents[joint]) {
            if (rig_.isAncestorOrSelf(joint, trunk.hips)) break;  // of the whole body
            // A spine that starts beside hips of their own, and not on them, starts at their height.
            const bool beside = !rig_.isAncestorOrSelf(joint, trunk.hips) && !rig_.isAncestorOrSelf(trunk.hips, joint);
            const float least = beside ? low - 0.06F * length_ : low;
            const NameEvidence& name = rig_.names[joint];
            const bool told = isTold() && name.parts[Part::trunk] >= kNamedTrunk && !isInPlaceOf(joint, trunk.hips);
            const bool between =
                told || (position(joint).y > std::min(least, position(trunk.chest).y) && position(joint).y < high);
            const bool otherPart = name.meaningful && name.parts[Part::trunk] < 0.0F && name.parts[Part::chest] < 0.0F;
            if (isCentral(joint) && between && !name.helper && !otherPart) joints.push_back(joint);
        }
        if (joints.empty() && rig_.parents[trunk.chest] == rig_.parents[trunk.hips]) joints = spineBeside(trunk, low);
        // Unskinned joints only where the spine has no others.
        const auto skinned = [&](int joint) { return ownSkin(joint) > 0.0F; };
        if (std::any_of(joints.begin(), joints.end(), skinned)) {
            joints.erase(std::remove_if(joints.begin(), joints.end(), [&](int joint) { return !skinned(joint); }),
                         joints.end());
        }
        std::reverse(joints.begin(), joints.end());
        return joints;
    }

  private:
    // In a flat hierarchy the spine's joints hang beside hips and chest: names tell them. Highest first; of those at
    // one height (a belly before the back) the one with more skin.
    [[nodiscard]] std::vector<int> spineBeside(const TrunkCandidate& trunk, float low) const {
        constexpr float kApart = 0.1F;  // of the trunk
        std::vector<int> found;
        if (rig_.parents[trunk.chest] == kNoJoint) return found;
        const float high = position(trunk.chest).y - kApart * length_;
        for (const int joint : rig_.children[rig_.parents[trunk.chest]]) {
            const bool between = position(joint).y > low && position(joint).y < high;
            const bool other = joint != trunk.hips && joint != trunk.head;
            if (other && between && isCentral(joint) && isNamedTrunk(joint) && name(joint, Part::trunk) > 0.0F)
                found.push_back(joint);
        }
        std::sort(found.begin(), found.end(), [this](int a, int b) { return position(a).y > position(b).y; });
        std::vector<int> joints;
        for (const int joint : found) {
            if (joints.empty() || position(joints.back()).y - position(joint).y > kApart * length_) {
                joints.push_back(joint);
            } else if (ownSkin(joint) > ownSkin(joints.back())) {
                joints.back() = joint;
            }
        }
        return joints;
    }

    // What of the score comes from names and from joints that are not there.
    void account(TrunkCandidate& trunk) const {
        trunk.names = name(trunk.hips, Part::hips) + name(trunk.chest, Part::chest);
        if (trunk.head != kNoJoint) trunk.names += name(trunk.head, Part::head);
        if (trunk.neck != kNoJoint) trunk.names += name(trunk.neck, Part::neck);
        trunk.missing =
            (trunk.head == kNoJoint ? kHeadless : 0.0F) + (trunk.chest == trunk.hips ? kOneJointTrunk : 0.0F);
    }

    struct Scored {
        int joint;
        float score;
    };

    static void keepBest(std::vector<Scored>& candidates, std::size_t count) {
        std::stable_sort(candidates.begin(), candidates.end(),
                         [](const Scored& a, const Scored& b) { return a.score > b.score; });
        if (candidates.size() > count) candidates.resize(count);
    }

    [[nodiscard]] float skinTerm(int joint) const {
        const float shadow = rig_.shadow[joint] ? kShadow : 0.0F;
        if (!rig_.skinned) return shadow;
        return shadow + (ownSkin(joint) > 0.0F ? 0.0F : kNoOwnSkin) +
               (rig_.subtreeWeight[joint] > 0.0F ? 0.0F : kNoSkinBelow);
    }
    [[nodiscard]] float centralTerm(int joint) const {
        return near(position(joint).x / length_, 0.0F, 0.05F, framed_.stance.byNames ? 1.0F : 3.0F);
    }

    [[nodiscard]] std::vector<Scored> likelyHips(int banned) const {
        std::vector<Scored> hips;
        const bool namesHips = std::any_of(central_.begin(), central_.end(),
                                           [&](int joint) { return name(joint, Part::hips) >= kNamedHips; });
        const bool blocks =
            std::any_of(central_.begin(), central_.end(), [&](int joint) { return isTrunkBlock(joint); });
        for (const int joint : central_) {
            if (joint == banned) continue;
            const float height = (position(joint).y - legs_.root.y) / length_;
            const float place = near(height, 0.05F, 0.15F * slack_, 6.0F) +
                                near((position(joint).z - legs_.root.z) / length_, 0.0F, 0.25F, 4.0F);
            // What all limbs hang on may lie beside them: a figure bent like a bow.
            const bool block = isTrunkBlock(joint);
            const bool carriesAll = joint == trunkRoot_ && joint == thighParent_ && legs_.told && rig_.skinned &&
                                    rig_.directWeight[joint] > 0.0F;
            float score = name(joint, Part::hips) + skinTerm(joint) + centralTerm(joint) +
                          (areToldHips(joint) || carriesAll || block ? std::max(place, kNamedPose) : place);
            if (trunkRoot_ != kNoJoint && rig_.isAncestorOrSelf(joint, trunkRoot_)) score += 1.5F;
            if (joint == trunkRoot_) score += 0.6F;
            if (blocks && isFileRoot(joint)) score += kFileRoot;
            const bool clear = legs_.told || (!rig_.skinned && !rig_.names[joint].meaningful);
            const bool carries = joint == trunkRoot_ && joint == thighParent_ && !standsForSpine(joint);
            if (carries && clear && !namesHips) score += kCarriesThighs;
            if (carriesLegsBelowControl(joint) && !namesHips) score += kCarriesThighs;
            if (rig_.skinned && ownSkin(joint) <= 0.0F) score += kUnskinnedHips;
            // The joint above would be the hips if it moves skin at the same height.
            const int parent = rig_.parents[joint];
            if (parent != kNoJoint && isCentral(parent) && (ownSkin(parent) > 0.0F || !rig_.skinned) &&
                std::abs(position(parent).y - legs_.root.y) < 0.25F * length_) {
                score -= 0.7F;
            }
            hips.push_back({joint, score});
        }
        keepBest(hips, kHipsTried);
        return hips;
    }

    [[nodiscard]] std::vector<Scored> likelyHeads(int banned) const {
        float skinAbove = 0.0F;
        bool anyAbove = false;  // a figure with joints where its head would be is not headless
        std::vector<int> joints;
        for (const int joint : central_) {
            const float lowest = !isNamedHead(joint) ? 0.15F : framed_.stance.byNames ? 1.0F : 0.5F;
            if (position(joint).y < arms_.root.y - lowest * length_ || joint == banned) continue;
            joints.push_back(joint);
            if (carriesTrunk(joint)) skinAbove = std::max(skinAbove, retainedSkin(joint));
            if (rig_.isAncestorOrSelf(joint, armRoot())) continue;
            skinAbove = std::max(skinAbove, rig_.subtreeWeight[joint]);
            const bool above = position(joint).y > arms_.root.y + 0.25F * length_;
            anyAbove = anyAbove || (above && rig_.carriesSkin(joint));
        }
        // Where nothing above the arms moves skin, the trunk moves the head's: its joint is there by its name.
        const bool bare = skinAbove <= 0.0F && !anyAbove;
        std::vector<Scored> heads;
        for (const int joint : joints) {
            const float pose = near((position(joint).y - arms_.root.y) / length_, 0.32F, 0.2F, 5.0F) +
                               near((position(joint).z - arms_.root.z) / length_, 0.0F, 0.3F, 3.0F);
            const bool first = carriesTrunk(joint);
            const float skin = bare && isNamedHead(joint) ? std::max(skinTerm(joint), kNamedNoSkin) : skinTerm(joint);
            // A head as well: the end of a long neck that keeps nearly all skin above the arms, where names tell limbs.
            const bool keepsAll = first || (skinAbove > 0.0F && legs_.names + arms_.names > 0.0F &&
                                            retainedSkin(joint) >= kWholeHead * skinAbove);
            float score = name(joint, Part::head) + skin + centralTerm(joint) +
                          (isNamedHead(joint) || endsSpine(joint) ? std::max(pose, kNamedPose)
                           : keepsAll                             ? std::max(pose, kWholePose)
                                                                  : pose);
            if (skinAbove > 0.0F) score += 2.0F * std::min(retainedSkin(joint) / (0.4F * skinAbove), 1.0F);
            if (carriesFace(joint)) score += kCarriesFace;
            if (!isNamedHead(joint) && goesOnAlike(joint)) score += kGoesOnAlike;
            if (isSpineBelowHead(joint)) score += kSpineBelowHead;
            if (!isNamedHead(joint) && isPartOfFace(joint)) score += kPartOfFace;
            // Arms on the head: a head that is the trunk, too, has that name.
            if (rig_.isAncestorOrSelf(joint, armRoot())) score -= first || isNamedHead(joint) ? 1.0F : 6.0F;
            heads.push_back({joint, score});
        }
        keepBest(heads, kHeadsTried);
        heads.push_back({kNoJoint, anyAbove ? 2.0F * kHeadless : kHeadless});
        return heads;
    }

    // Central joints from the thighs up to somewhat above the arms: no face, no tail.
    [[nodiscard]] std::vector<int> possibleChests(int banned) const {
        std::vector<int> chests;
        for (const int joint : central_) {
            const float height = (position(joint).y - legs_.root.y) / length_;
            // Told arms may start well below the chest that they hang on, where it is named so.
            const bool told =
                isToldChest(joint) || (joint == armParent_ && arms_.told && name(joint, Part::chest) >= kNamedChest);
            if (joint != banned && ((height > -0.6F && height < 1.4F) || told)) chests.push_back(joint);
        }
        return chests;
    }

    [[nodiscard]] float chestScore(const TrunkCandidate& trunk, float neckScore) const {
        const int chest = trunk.chest;
        const vec3& place = position(chest);
        if (chest == trunk.head) return -kFarAway;
        const bool headFirst = trunk.head != kNoJoint && rig_.isAncestorOrSelf(trunk.head, chest);
        if (headFirst && (chest != armParent_ || !carriesTrunk(trunk.head))) return -kFarAway;
        if (chest != trunk.hips && rig_.isAncestorOrSelf(chest, trunk.hips) && !isTurnedOver(chest, trunk.hips))
            return -kFarAway;
        float score = skinTerm(chest) + centralTerm(chest) + near((place.z - arms_.root.z) / length_, 0.0F, 0.3F, 4.0F);
        const bool heavy = chest == armParent_ && rig_.skinned && ownSkin(chest) >= kHeavyChest && !isNamedHead(chest);
        const float named = name(chest, Part::chest);
        score += chest == trunk.hips ? kOneJointTrunk + std::max(named, 0.0F)
                 : heavy             ? std::max(named, kHeavyNamed)
                                     : named;
        if (chest == trunk.hips && rig_.skinned && ownSkin(chest) <= 0.0F) score += kUnskinnedTrunk;
        if (chest == armParent_ && chest != trunk.hips) {
            score += ownSkin(chest) > 0.0F || !rig_.skinned ? 2.5F : 1.5F;
        } else if (!rig_.isAncestorOrSelf(chest, armRoot())) {
            score -= 0.5F;
            const bool lighter = rig_.skinned && armParent_ != kNoJoint && isCentral(armParent_) &&
                                 rig_.directWeight[armParent_] > ownSkin(chest);
            if (lighter && armParent_ != trunk.hips && rig_.isAncestorOrSelf(armParent_, chest)) score += kArmsBelow;
        }
        if (chest != trunk.hips) {
            const float below = (arms_.root.y - place.y) / length_;
            const float height =
                near(below, 0.2F, 0.2F * slack_, 5.0F) + atMost(-below, 0.08F, 0.05F * slack_ * slack_, 3.0F);
            // Squat figures' arms start below the joint that they hang from; its name tells.
            const bool told = chest == armParent_ && named >= kNamedChest;
            score += told || heavy || isToldChest(chest) ? std::max(height, kNamedPose) : height;
        }
        // Hips that are named so and carry the legs may hang beside the spine, on a joint of the whole body.
        const bool beside = (trunk.hips == legParent_ && name(trunk.hips, Part::hips) >= kNamedHips) ||
                            carriesLegsBelowControl(trunk.hips);
        if (rig_.isAncestorOrSelf(trunk.hips, chest) || beside) score += 1.5F;
        // Hips without skin below a trunk that is no higher are a control of that trunk.
        const bool low = place.y - legs_.root.y < 0.3F * length_;
        if (low && chest != trunk.hips && rig_.skinned && ownSkin(trunk.hips) <= 0.0F) score += 1.5F * kUnskinnedTrunk;
        if (isCopyOfWhatCarries(chest, armRoot())) score += kOfTwoSkeletons;
        if (isCopyOfWhatCarries(trunk.hips, legRoot())) score += kOfTwoSkeletons;
        if (isCopyOfWhatCarries(trunk.hips, chest)) score += kOfTwoSkeletons;
        if (trunk.head == kNoJoint) return score;
        if (isCopyOfWhatCarries(chest, trunk.head)) score += kOfTwoSkeletons;
        score += near((position(trunk.head).y - place.y) / length_, 0.6F, 0.25F,
                      headFirst || isNamedHead(trunk.head) || endsSpine(trunk.head) ? 1.5F : 4.0F);
        return score + neckScore;
    }

    // How many joints lie between chest and head, and what they are called.
    [[nodiscard]] float neckScore(int chest, int head) const {
        if (head == kNoJoint) return 0.0F;
        const std::vector<int> necks = necksOf(chest, head);
        constexpr float kByCount[] = {-0.9F, 0.0F, -0.2F, -0.5F};
        float score = kByCount[std::min<std::size_t>(necks.size(), 3)];
        const int lowest = lowestOf(necks);
        if (lowest == kNoJoint) return score;
        score += name(lowest, Part::neck);
        const bool carries = std::find(necks.begin(), necks.end(), armParent_) != necks.end() &&
                             (armParent_ != lowest || name(armParent_, Part::neck) <= 0.0F);
        return carries ? score + kArmsAboveChest : score;
    }

    [[nodiscard]] std::vector<int> necksOf(int chest, int head) const {
        std::vector<int> necks;
        if (head == kNoJoint) return necks;
        for (int joint = rig_.parents[head]; joint != kNoJoint && joint != chest; joint = rig_.parents[joint]) {
            if (rig_.isAncestorOrSelf(joint, chest)) break;
            const bool between = position(joint).y > position(chest).y - 0.02F * length_;
            const bool control = rig_.skinned && rig_.names[joint].helper && rig_.directWeight[joint] <= 0.0F;
            if (isCentral(joint) && between && !rig_.names[joint].face && !control) necks.push_back(joint);
        }
        return necks;
    }

    [[nodiscard]] int lowestOf(const std::vector<int>& necks) const {
        int best = kNoJoint;
        float bestScore = -kFarAway;
        // What carries the arms is the trunk, unless its name says neck or nothing else is one.
        const auto carriesArms = [&](int joint) {
            return rig_.isAncestorOrSelf(joint, armRoot()) && name(joint, Part::neck) <= 0.0F;
        };
        const bool onlyThose = std::all_of(necks.begin(), necks.end(), carriesArms);
        for (const int joint : necks) {
            if (carriesArms(joint) && !onlyThose) continue;
            const float score = name(joint, Part::neck) + (ownSkin(joint) > 0.0F || !rig_.skinned ? 0.5F : 0.0F);
            if (score < bestScore) continue;
            bestScore = score;
            best = joint;
        }
        return best;
    }
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
