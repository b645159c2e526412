#include "animation/humanoid/trunk_candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "animation/humanoid/evidence_terms.hpp"
#include "animation/humanoid/stray_faces.hpp"

namespace lutka::animation {
namespace {

constexpr float kNoOwnSkin = -1.0F;
constexpr float kUnskinnedHips = -2.2F;  // besides: controls of the whole body stand where the hips do
constexpr float kNoSkinBelow = -5.0F;
constexpr float kShadow = -3.0F;
constexpr float kOneJointTrunk = -1.5F;   // hips and chest in one
constexpr float kUnskinnedTrunk = -4.0F;  // … that moves no skin
constexpr float kCarriesThighs = 1.5F;    // the parent of told thighs and of all above, where no name says hips
constexpr float kHeadless = -3.0F;
constexpr float kNamedChest = 2.0F;
constexpr float kNamedHips = 4.0F;
constexpr float kNamedTrunk = 3.0F;       // a name's score from which it says which part of the trunk this is
constexpr float kNamedHead = 4.0F;        // a name's score from which it says head and nothing else
constexpr float kNamedPose = -2.0F;       // the most that the place of a head so named may cost
constexpr float kOfTwoSkeletons = -4.0F;  // of a trunk and what hangs on it, of its copy
constexpr float kArmsAboveChest = -1.5F;  // the arms hang on a joint between chest and neck
constexpr float kNamedNoSkin = -2.0F;     // the most that a head so named, on top of all skin, costs without any
constexpr float kCarriesFace = 3.0F;      // eyes or ears hang on it
constexpr float kGoesOnAlike = -1.0F;     // the joint above it is named as its next segment
constexpr float kWholeHead = 0.8F;        // of the skin above the arms
constexpr float kWholePose = -1.0F;       // the most that the place of what keeps so much may cost
constexpr float kClearlyBelow = 0.4F;     // of the trunk: hips below the chest that they hang on
constexpr float kUpright = 0.99F;         // cosine between the stance's up and the file's
constexpr float kSamePlace = 0.01F;       // of the trunk: a copy's
constexpr float kSameJoint = 0.03F;       // … and of a part that has a joint of its own
constexpr std::size_t kHeadsTried = 6;
constexpr std::size_t kHipsTried = 4;
constexpr float kFarAway = 1e8F;

class TrunkFinder {
  public:
    TrunkFinder(const FramedRig& framed, const LimbCandidate& legs, const LimbCandidate& arms)
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
        for (int joint = rig_.parents[trunk.chest]; joint != kNoJoint && joint != trunk.hips;
             joint = rig_.parents[joint]) {
            if (rig_.isAncestorOrSelf(joint, trunk.hips)) break;  // of the whole body
            // A spine that starts beside hips of their own, and not on them, starts at their height.
            const bool beside = !rig_.isAncestorOrSelf(joint, trunk.hips) && !rig_.isAncestorOrSelf(trunk.hips, joint);
            const float least = beside ? low - 0.06F * length_ : low;
            const NameEvidence& name = rig_.names[joint];
            const bool told = isTold() && name.parts[Part::trunk] >= kNamedTrunk && !isInPlaceOf(joint, trunk.hips);
            const bool between = told || (position(joint).y > std::min(least, position(trunk.chest).y) &&
                                          position(joint).y < arms_.root.y + 0.1F * length_);
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

    [[nodiscard]] const vec3& position(int joint) const { return framed_.positions[joint]; }
    [[nodiscard]] float name(int joint, Part part) const { return rig_.names[joint].parts[part]; }
    [[nodiscard]] bool isCentral(int joint) const { return isCentral_[static_cast<std::size_t>(joint)]; }
    [[nodiscard]] bool standsInTheMiddle(int joint) const {
        const int pair = framed_.pairOf[joint];
        if (pair >= 0 && (legs_.uses(pair) || arms_.uses(pair))) return false;
        // A dancer's or fallen figure's trunk may lie to the side; its names tell.
        const bool told = isNamedTrunk(joint) || (joint == thighParent_ && legs_.told);
        const float aside = !told ? 0.12F : framed_.stance.byNames ? 2.0F : 0.4F;
        return std::abs(position(joint).x) < aside * length_ && pair < 0;
    }
    // Share of the skin that a joint moves itself, or by leaves in the middle (rigid parts, collision volumes).
    [[nodiscard]] float ownSkin(int joint) const {
        float own = rig_.directWeight[joint];
        for (const int child : rig_.children[joint]) {
            if (rig_.children[child].empty() && framed_.pairOf[child] < 0) own += rig_.directWeight[child];
        }
        return own;
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
        for (const int joint : central_) {
            if (joint == banned) continue;
            const float height = (position(joint).y - legs_.root.y) / length_;
            const float place = near(height, 0.05F, 0.15F * slack_, 6.0F) +
                                near((position(joint).z - legs_.root.z) / length_, 0.0F, 0.25F, 4.0F);
            float score = name(joint, Part::hips) + skinTerm(joint) + centralTerm(joint) +
                          (areToldHips(joint) ? std::max(place, kNamedPose) : place);
            if (trunkRoot_ != kNoJoint && rig_.isAncestorOrSelf(joint, trunkRoot_)) score += 1.5F;
            if (joint == trunkRoot_) score += 0.6F;
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

    // Moves no skin, and a joint on it does, that starts the spine at the thighs' height: the armature's own node.
    [[nodiscard]] bool standsForSpine(int joint) const {
        constexpr float kAtThighs = 0.25F;  // of the trunk
        if (!rig_.skinned || ownSkin(joint) > 0.0F) return false;
        return std::any_of(rig_.children[joint].begin(), rig_.children[joint].end(), [&](int child) {
            return isCentral(child) && ownSkin(child) > 0.0F && rig_.isAncestorOrSelf(child, armRoot()) &&
                   std::abs(position(child).y - legs_.root.y) < kAtThighs * length_;
        });
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
                          (isNamedHead(joint) ? std::max(pose, kNamedPose)
                           : keepsAll         ? std::max(pose, kWholePose)
                                              : pose);
            if (skinAbove > 0.0F) score += 2.0F * std::min(retainedSkin(joint) / (0.4F * skinAbove), 1.0F);
            if (carriesFace(joint)) score += kCarriesFace;
            if (!isNamedHead(joint) && goesOnAlike(joint)) score += kGoesOnAlike;
            // Arms on the head: a head that is the trunk, too, has that name.
            if (rig_.isAncestorOrSelf(joint, armRoot())) score -= first || isNamedHead(joint) ? 1.0F : 6.0F;
            heads.push_back({joint, score});
        }
        keepBest(heads, kHeadsTried);
        heads.push_back({kNoJoint, anyAbove ? 2.0F * kHeadless : kHeadless});
        return heads;
    }

    [[nodiscard]] bool isNamedTrunk(int joint) const {
        constexpr std::array<Part, 5> kTrunk{Part::hips, Part::trunk, Part::chest, Part::neck, Part::head};
        const NameEvidence& said = rig_.names[joint];
        const auto tells = [&](Part part) { return said.parts[part] >= kNamedTrunk; };
        return said.side == Side::center && !said.helper && std::any_of(kTrunk.begin(), kTrunk.end(), tells);
    }

    // A head that is thrust forward is still one by its name.
    [[nodiscard]] bool isNamedHead(int joint) const { return name(joint, Part::head) >= kNamedHead; }

    // "spine.005" goes on as "spine.006": where the spine is numbered up to the head, the last one is the head.
    [[nodiscard]] bool goesOnAlike(int joint) const {
        return std::any_of(rig_.children[joint].begin(), rig_.children[joint].end(), [&](int child) {
            return isCentral(child) && rig_.carriesSkin(child) && position(child).y > position(joint).y &&
                   !isInPlaceOf(child, joint) && isSecondSegment(rig_.names[joint], rig_.names[child]);
        });
    }

    // Two joints of a face hang on it: eyes, ears. A face in its place is part of it.
    [[nodiscard]] bool carriesFace(int joint) const { return !rig_.names[joint].face && facesOn(joint) >= 2; }

    [[nodiscard]] int facesOn(int joint) const {
        int faces = strayFaces_[joint];
        for (const int child : rig_.children[joint]) {
            if (rig_.names[child].face) ++faces;
            if (isInPlaceOf(child, joint)) faces += facesOn(child);
        }
        return faces;
    }

    [[nodiscard]] bool isInPlaceOf(int joint, int other, float tolerance = kSameJoint) const {
        return glm::distance(position(joint), position(other)) < tolerance * length_;
    }

    // Skin at and below a joint, without what goes on upwards along the middle: much for a head, little for a neck.
    [[nodiscard]] float retainedSkin(int joint) const { return rig_.subtreeWeight[joint] - skinOnwards(joint); }
    // What hangs in the joint's own place is a part of it and goes nowhere.
    [[nodiscard]] float skinOnwards(int joint) const {
        float onward = 0.0F;
        for (const int child : rig_.children[joint]) {
            if (!isCentral(child)) continue;
            const bool part = rig_.rigidPart[child] && rig_.children[child].empty() && !rig_.rigidPart[joint];
            const float weight = isInPlaceOf(child, joint) ? skinOnwards(child) : rig_.subtreeWeight[child];
            onward = std::max(onward, (part ? 0.3F : 1.0F) * weight);
        }
        return onward;
    }

    // What carries limbs whose joints are all told is hips or chest by its name, in whatever frame a capture begins.
    [[nodiscard]] bool areToldHips(int joint) const {
        return isTold() && joint == legParent_ && name(joint, Part::hips) >= kNamedHips;
    }
    [[nodiscard]] bool isToldChest(int joint) const {
        return isTold() && joint == armParent_ && name(joint, Part::chest) >= kNamedChest;
    }
    [[nodiscard]] bool isTold() const { return framed_.stance.byNames && legs_.named && arms_.named; }

    // Central joints from the thighs up to somewhat above the arms: no face, no tail.
    [[nodiscard]] std::vector<int> possibleChests(int banned) const {
        std::vector<int> chests;
        for (const int joint : central_) {
            const float height = (position(joint).y - legs_.root.y) / length_;
            if (joint != banned && ((height > -0.6F && height < 1.4F) || isToldChest(joint))) chests.push_back(joint);
        }
        return chests;
    }

    [[nodiscard]] int armRoot() const { return framed_.pairs[arms_.first].joints[0]; }
    [[nodiscard]] int legRoot() const { return framed_.pairs[legs_.first].joints[0]; }
    [[nodiscard]] float chestScore(const TrunkCandidate& trunk, float neckScore) const {
        const int chest = trunk.chest;
        const vec3& place = position(chest);
        if (chest == trunk.head) return -kFarAway;
        const bool headFirst = trunk.head != kNoJoint && rig_.isAncestorOrSelf(trunk.head, chest);
        if (headFirst && (chest != armParent_ || !carriesTrunk(trunk.head))) return -kFarAway;
        if (chest != trunk.hips && rig_.isAncestorOrSelf(chest, trunk.hips) && !isTurnedOver(chest, trunk.hips))
            return -kFarAway;
        float score = skinTerm(chest) + centralTerm(chest) + near((place.z - arms_.root.z) / length_, 0.0F, 0.3F, 4.0F);
        score +=
            chest == trunk.hips ? kOneJointTrunk + std::max(name(chest, Part::chest), 0.0F) : name(chest, Part::chest);
        if (chest == trunk.hips && rig_.skinned && ownSkin(chest) <= 0.0F) score += kUnskinnedTrunk;
        if (chest == armParent_ && chest != trunk.hips) {
            score += ownSkin(chest) > 0.0F || !rig_.skinned ? 2.5F : 1.5F;
        } else if (!rig_.isAncestorOrSelf(chest, armRoot())) {
            score -= 0.5F;
        }
        if (chest != trunk.hips) {
            const float below = (arms_.root.y - place.y) / length_;
            const float height =
                near(below, 0.2F, 0.2F * slack_, 5.0F) + atMost(-below, 0.08F, 0.05F * slack_ * slack_, 3.0F);
            // Squat figures' arms start below the joint that they hang from; its name tells.
            const bool named = chest == armParent_ && name(chest, Part::chest) >= kNamedChest;
            score += named || isToldChest(chest) ? std::max(height, kNamedPose) : height;
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
                      headFirst || isNamedHead(trunk.head) ? 1.5F : 4.0F);
        return score + neckScore;
    }

    // What carries told legs and hangs, beside the spine, on a control of the whole body.
    [[nodiscard]] bool carriesLegsBelowControl(int joint) const {
        return joint == legParent_ && legs_.told && trunkRoot_ != kNoJoint && joint != trunkRoot_ &&
               rig_.names[trunkRoot_].helper && rig_.isAncestorOrSelf(trunkRoot_, joint);
    }

    // `below` hangs on another joint in this one's place: one of the two is a control rig's. A skin tells better which.
    [[nodiscard]] bool isCopyOfWhatCarries(int joint, int below) const {
        if (rig_.skinned || rig_.isAncestorOrSelf(joint, below)) return false;
        return std::any_of(central_.begin(), central_.end(), [&](int other) {
            return other != joint && rig_.isAncestorOrSelf(other, below) && !rig_.isAncestorOrSelf(other, joint) &&
                   isInPlaceOf(other, joint, kSamePlace);
        });
    }

    // A trunk that carries its hips: robots whose body is the root. The hips are named so and carry the legs alone, or
    // hang clearly below the chest with both thighs on them.
    [[nodiscard]] bool isTurnedOver(int chest, int hips) const {
        if (chest != armParent_ || hips != legParent_) return false;
        const bool named = name(hips, Part::hips) >= kNamedHips && name(chest, Part::chest) >= kNamedChest;
        return named || (hips == thighParent_ && hangsBelow(hips, chest));
    }

    // The lower of two joints that move skin hangs on the upper one: a tree that starts further up than at the hips. So
    // do animals', whose trunk lies.
    [[nodiscard]] bool hangsBelow(int lower, int upper) const {
        if (framed_.stance.up.y < kUpright) return false;
        const bool moves = !rig_.skinned || (rig_.directWeight[lower] > 0.0F && rig_.directWeight[upper] > 0.0F);
        return moves && lower != upper && rig_.isAncestorOrSelf(upper, lower) &&
               position(upper).y - position(lower).y > kClearlyBelow * length_;
    }

    // A head that everything hangs on: what carries the arms hangs below it.
    [[nodiscard]] bool carriesTrunk(int head) const { return armParent_ != kNoJoint && hangsBelow(armParent_, head); }

    // How many joints lie between chest and head, and what they are called.
    [[nodiscard]] float neckScore(int chest, int head) const {
        if (head == kNoJoint) return 0.0F;
        const std::vector<int> necks = necksOf(chest, head);
        constexpr float kByCount[] = {-0.9F, 0.0F, -0.2F, -0.5F};
        float score = kByCount[std::min<std::size_t>(necks.size(), 3)];
        const int lowest = lowestOf(necks);
        if (lowest == kNoJoint) return score;
        score += name(lowest, Part::neck);
        const bool carries = armParent_ != kNoJoint && armParent_ != chest && armParent_ != lowest &&
                             rig_.isAncestorOrSelf(chest, armParent_) && rig_.isAncestorOrSelf(armParent_, lowest);
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

    const FramedRig& framed_;
    const RigFeatures& rig_;
    const LimbCandidate& legs_;
    const LimbCandidate& arms_;
    float length_;  // from the thighs up to the upper arms
    float slack_;   // limbs of one joint need not start at the shoulder and the hip
    int legParent_ = kNoJoint;
    int thighParent_ = kNoJoint;  // of both, where it is one
    int armParent_ = kNoJoint;
    int trunkRoot_ = kNoJoint;
    std::vector<bool> isCentral_;
    std::vector<int> central_;
    std::vector<int> strayFaces_;  // per joint
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
