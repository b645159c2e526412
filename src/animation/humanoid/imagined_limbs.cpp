#include "animation/humanoid/imagined_limbs.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <string_view>

namespace lutka::animation {
namespace {

constexpr int kFewestTold = 2;         // parts of each limb that is there
constexpr float kMostBeside = 0.35F;   // of the way from the hips up to the head, sideways of it
constexpr float kLegsToRise = 1.54F;   // legs as long, where the arms start one above the hips
constexpr float kArmsToLegs = 0.62F;   // of the legs' length, or of the rise from hips to shoulders
constexpr float kShoulders = 0.85F;    // of the way from hips to head, where the trunk is one joint
constexpr float kSkinOfJoint = 0.05F;  // share of the skin that an imagined joint moves

constexpr std::array<Part, 3> kArm{Part::upperArm, Part::lowerArm, Part::hand};
constexpr std::array<Part, 3> kLeg{Part::upperLeg, Part::lowerLeg, Part::foot};

class Imaginer {
  public:
    explicit Imaginer(const RigFeatures& rig) : rig_(rig), crossed_(crossedArms()) {}

    [[nodiscard]] std::optional<CompletedRig> complete() const {
        const bool arms = isTold(kArm);
        const bool legs = isTold(kLeg);
        if (arms == legs || !isAbsent(arms ? kLeg : kArm) || namesAnimal()) return std::nullopt;
        if (isToldTwice(arms ? kArm[0] : kLeg[0])) return std::nullopt;
        const int hips = lowestOfTrunk();
        const int top = topOfTrunk();
        if (hips == kNoJoint || top == kNoJoint || top == hips) return std::nullopt;
        const vec3 rise = rig_.positions[top] - rig_.positions[hips];
        const vec3 up(0, 1, 0);
        if (rise.y <= 0.0F || glm::length(rise - rise.y * up) > kMostBeside * rise.y) return std::nullopt;
        return arms ? withLegs(hips) : withArms(hips, top);
    }

  private:
    // The joint whose name says that part most clearly; of equals the first.
    [[nodiscard]] int named(Part part, Side side, float least) const {
        int best = kNoJoint;
        for (int joint = 0; joint < rig_.count(); ++joint) {
            const NameEvidence& name = rig_.names[joint];
            if (name.side != side || name.helper || name.parts[part] < least) continue;
            if (best == kNoJoint || name.parts[part] > rig_.names[best].parts[part]) best = joint;
        }
        return best;
    }

    [[nodiscard]] bool isTold(const std::array<Part, 3>& limb) const {
        const auto told = [&](Side side) {
            return std::count_if(limb.begin(), limb.end(),
                                 [&](Part part) { return named(part, side, kTellsPartOfLimb) != kNoJoint; });
        };
        return named(limb[0], Side::left, kTellsPartOfLimb) != kNoJoint &&
               named(limb[0], Side::right, kTellsPartOfLimb) != kNoJoint && told(Side::left) >= kFewestTold &&
               told(Side::right) >= kFewestTold;
    }

    // One leaf for both arms, which are crossed before the chest: named as arms, on neither side. kNoJoint without one.
    [[nodiscard]] int crossedArms() const {
        int found = kNoJoint;
        for (int joint = 0; joint < rig_.count(); ++joint) {
            const NameEvidence& name = rig_.names[joint];
            if (name.side != Side::center || name.helper || !name.bareLimb || !rig_.carriesSkin(joint)) continue;
            if (name.parts[Part::upperArm] < kTellsPartOfLimb || !rig_.children[joint].empty()) continue;
            if (found != kNoJoint) return kNoJoint;
            found = joint;
        }
        return found;
    }

    // Two chains of one side with the names of one limb: the other limb bears them, too.
    [[nodiscard]] bool isToldTwice(Part upper) const {
        const int first = named(upper, Side::left, kTellsPartOfLimb);
        for (int joint = 0; joint < rig_.count(); ++joint) {
            const NameEvidence& name = rig_.names[joint];
            if (name.side != Side::left || name.helper || name.parts[upper] < kTellsPartOfLimb) continue;
            if (!rig_.carriesSkin(joint)) continue;
            if (!rig_.isAncestorOrSelf(first, joint) && !rig_.isAncestorOrSelf(joint, first)) return true;
        }
        return false;
    }

    // A hand or foot that hangs on the trunk: what a robe leaves to be seen of a limb.
    [[nodiscard]] bool isEndOnTrunk(int joint, Part end) const {
        const int parent = rig_.parents[joint];
        if (parent == kNoJoint || !rig_.children[joint].empty() || rig_.names[parent].side != Side::center)
            return false;
        const PartScores& parts = rig_.names[joint].parts;
        return rig_.names[joint].side != Side::center && parts[end] >= kTellsSurely;
    }

    // No joint that moves skin speaks of such a limb, on either side or none.
    [[nodiscard]] bool isAbsent(const std::array<Part, 3>& limb) const {
        for (int joint = 0; joint < rig_.count(); ++joint) {
            const bool isHips = rig_.names[joint].parts[Part::hips] >= kTellsTrunkEnd;  // "hip" may be a thigh's
            if (!rig_.carriesSkin(joint) || (isHips && rig_.names[joint].side == Side::center)) continue;
            if (joint == crossed_ || isEndOnTrunk(joint, limb[2])) continue;
            for (const Part part : limb) {
                if (rig_.names[joint].parts[part] > 0.0F) return false;
            }
        }
        return true;
    }

    [[nodiscard]] bool namesAnimal() const {
        return std::any_of(rig_.names.begin(), rig_.names.end(),
                           [](const NameEvidence& name) { return name.creature || name.tail; });
    }

    // The hips; else the parent of the spine, if it is called a root and moves skin of its own.
    [[nodiscard]] int lowestOfTrunk() const {
        const int hips = named(Part::hips, Side::center, kTellsTrunkEnd);
        if (hips != kNoJoint) return hips;
        for (int joint = 0; joint < rig_.count(); ++joint) {
            const NameEvidence& name = rig_.names[joint];
            const int root = rig_.parents[joint];
            if (name.helper || name.side != Side::center || root == kNoJoint) continue;
            if (name.parts[Part::trunk] < kTellsTrunkEnd || rig_.names[root].parts[Part::hips] <= 0.0F) continue;
            if (!rig_.skinned || rig_.directWeight[root] > 0.0F) return root;
        }
        return crossed_ != kNoJoint ? bodyOfCrossedArms() : lowestOfSpine();
    }

    // Where the spine is numbered from the hips on, as Blender's metarig has it: the one that all the others hang on.
    [[nodiscard]] int lowestOfSpine() const {
        constexpr int kFewest = 3;
        std::vector<int> spine;
        for (int joint = 0; joint < rig_.count(); ++joint) {
            const NameEvidence& name = rig_.names[joint];
            const bool said = name.side == Side::center && !name.helper && name.parts[Part::trunk] >= kTellsTrunkEnd;
            if (said && rig_.carriesSkin(joint)) spine.push_back(joint);
        }
        if (static_cast<int>(spine.size()) < kFewest) return kNoJoint;
        const int lowest = spine.front();
        const bool isOne = std::all_of(spine.begin(), spine.end(), [&](int joint) {
            return rig_.isAncestorOrSelf(lowest, joint) && rig_.names[joint].words == rig_.names[lowest].words;
        });
        return isOne && (!rig_.skinned || rig_.directWeight[lowest] > 0.0F) ? lowest : kNoJoint;
    }

    // The one joint that carries arms that are crossed and both legs.
    [[nodiscard]] int bodyOfCrossedArms() const {
        const int body = rig_.parents[crossed_];
        if (body == kNoJoint || (rig_.skinned && rig_.directWeight[body] <= 0.0F)) return kNoJoint;
        for (const Side side : {Side::left, Side::right}) {
            const int thigh = named(Part::upperLeg, side, kTellsPartOfLimb);
            if (thigh == kNoJoint || rig_.parents[thigh] != body) return kNoJoint;
        }
        return body;
    }

    // The head, else the neck, else the highest of at least two joints of a spine.
    [[nodiscard]] int topOfTrunk() const {
        for (const Part part : {Part::head, Part::neck}) {
            const int joint = named(part, Side::center, kTellsTrunkEnd);
            if (joint != kNoJoint) return joint;
        }
        int highest = kNoJoint;
        int count = 0;
        for (int joint = 0; joint < rig_.count(); ++joint) {
            const NameEvidence& name = rig_.names[joint];
            if (name.helper || name.side != Side::center) continue;
            if (std::max(name.parts[Part::trunk], name.parts[Part::chest]) < kTellsTrunkEnd) continue;
            ++count;
            if (highest == kNoJoint || rig_.positions[joint].y > rig_.positions[highest].y) highest = joint;
        }
        return count >= 2 ? highest : kNoJoint;
    }

    // From the right to the left, level; of the limbs that are there.
    [[nodiscard]] vec3 across(Part upper) const {
        const vec3 left = rig_.positions[named(upper, Side::left, kTellsPartOfLimb)];
        const vec3 right = rig_.positions[named(upper, Side::right, kTellsPartOfLimb)];
        const vec3 level(left.x - right.x, 0.0F, left.z - right.z);
        const float length = glm::length(level);
        return length > 0.0F ? level / length : vec3(0);
    }

    [[nodiscard]] std::optional<CompletedRig> withLegs(int hips) const {
        const vec3 shoulders = 0.5F * (rig_.positions[named(Part::upperArm, Side::left, kTellsPartOfLimb)] +
                                       rig_.positions[named(Part::upperArm, Side::right, kTellsPartOfLimb)]);
        const float length = kLegsToRise * (shoulders.y - rig_.positions[hips].y);
        const vec3 aside = 0.15F * length * across(Part::upperArm);
        if (length <= 0.0F || glm::length(aside) <= 0.0F) return std::nullopt;
        const vec3 down(0, -0.45F * length, 0);
        return add(hips, rig_.positions[hips], aside, down,
                   {"LeftUpperLeg", "LeftLowerLeg", "LeftFoot", "RightUpperLeg", "RightLowerLeg", "RightFoot"});
    }

    [[nodiscard]] std::optional<CompletedRig> withArms(int hips, int top) const {
        int chest = rig_.parents[top];
        while (chest != kNoJoint && rig_.names[chest].parts[Part::neck] >= kTellsTrunkEnd)
            chest = rig_.parents[chest];
        if (chest == kNoJoint) return std::nullopt;
        const vec3 start =
            chest == hips ? glm::mix(rig_.positions[hips], rig_.positions[top], kShoulders) : rig_.positions[chest];
        const float length = kArmsToLegs * (start.y - rig_.positions[hips].y) * kLegsToRise;
        const vec3 direction = across(Part::upperLeg);
        if (length <= 0.0F || glm::length(direction) <= 0.0F) return std::nullopt;
        return add(chest, start, 0.25F * length * direction, 0.5F * length * direction,
                   {"LeftUpperArm", "LeftLowerArm", "LeftHand", "RightUpperArm", "RightLowerArm", "RightHand"});
    }

    // Two limbs of three joints below `parent`: the left one's first `aside` from `start`, each next one `step` on, of
    // which the part along `aside` is mirrored.
    [[nodiscard]] CompletedRig add(int parent, const vec3& start, const vec3& aside, const vec3& step,
                                   const std::array<std::string_view, 6>& names) const {
        CompletedRig completed{rig_, std::vector<int>(rig_.parents.size(), kNoJoint), true};
        RigFeatures& rig = completed.rig;
        const vec3 outward = glm::normalize(aside);
        auto name = names.begin();
        for (int side = 0; side < 2; ++side) {
            const float sign = side == 0 ? 1.0F : -1.0F;
            const vec3 along = glm::dot(step, outward) * outward;
            for (int place = 0; place < 3; ++place) {
                const int joint = rig.count();
                completed.originalOf.push_back(side == 0 ? joint + 3 : joint - 3);
                const auto count = static_cast<float>(place);
                rig.positions.push_back(start + sign * (aside + count * along) + count * (step - along));
                addJoint(place == 0 ? parent : joint - 1, *name++, rig);
            }
        }
        walkTree(rig);
        return completed;
    }

    static void addJoint(int parent, std::string_view name, RigFeatures& rig) {
        const int joint = static_cast<int>(rig.parents.size());
        const float skin = rig.skinned ? kSkinOfJoint : 0.0F;
        rig.parents.push_back(parent);
        rig.children.emplace_back();
        rig.children[parent].push_back(joint);
        rig.directWeight.push_back(skin);
        rig.ownWeight.push_back(skin);
        rig.subtreeWeight.push_back(0.0F);
        for (int above = joint; above != kNoJoint; above = rig.parents[above])
            rig.subtreeWeight[above] += skin;
        rig.shadow.push_back(false);
        rig.rigidPart.push_back(false);
        rig.names.push_back(nameEvidence(name));
    }

    const RigFeatures& rig_;
    int crossed_ = kNoJoint;
};

}  // namespace

std::vector<CompletedRig> imagineLimbs(const RigFeatures& rig) {
    std::vector<CompletedRig> all;
    if (std::optional<CompletedRig> completed = Imaginer(rig).complete()) all.push_back(std::move(*completed));
    return all;
}

}  // namespace lutka::animation
