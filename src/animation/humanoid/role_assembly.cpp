#include "animation/humanoid/role_assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "animation/humanoid/role_hierarchy.hpp"
#include "animation/humanoid/segment_pivots.hpp"
#include "animation/humanoid/stray_joints.hpp"

namespace lutka::animation {
namespace {

constexpr float kCertain = 0.99F;
constexpr float kLeastWholeLeg = 0.3F;  // of the way from the floor to the shoulders, and …
constexpr float kLeastWholeArm = 0.6F;  // … of the trunk: what a foot or hand alone does not reach
constexpr float kLoneMargin = 2.0F;     // log-odds of a joint that is found on one side alone

float probability(float logOdds) {
    return 1.0F / (1.0F + std::exp(-logOdds));
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : " ") + word;
    return text;
}

class RoleAssembler {
  public:
    RoleAssembler(const Figure& figure, const RigFeatures& rig)
        : figure_(figure), rig_(rig), sideTrust_(probability(std::abs(figure.facing.total()))) {}

    HumanoidMap assemble() {
        map_.humanoid = true;
        map_.confidence = std::min(probability((figure_.shapeScore() - kLeastShapeScore + 4.0F) / 4.0F), kCertain);
        bindTrunk();
        constexpr std::array<Role, 4> kLegs{Role::leftUpperLeg, Role::leftLowerLeg, Role::leftFoot, Role::leftToes};
        constexpr std::array<Role, 4> kArms{Role::leftUpperArm, Role::leftLowerArm, Role::leftHand, Role::leftShoulder};
        std::array<float, 4> legMargins = figure_.margins.legs;
        std::array<float, 4> armMargins = figure_.margins.arms;
        const LimbCandidate legs = asWhole(figure_.legs, reachesFromHip(), legMargins);
        const LimbCandidate arms = asWhole(figure_.arms, reachesFromShoulder(), armMargins);
        bindLimb(legs, kLegs, legMargins, "leg");
        bindLimb(arms, kArms, armMargins, "arm");
        bindStrayJoints(rig_, probability(kLoneMargin) * sideTrust_, map_);
        bindSegmentPivots(rig_, map_);
        distrustAstray();
        map_.standardFromModel = standardStance();
        return map_;
    }

  private:
    // A limb of one joint that is called foot or hand, and goes all the way from the hip or the shoulder, is the limb.
    [[nodiscard]] LimbCandidate asWhole(LimbCandidate limb, bool isLong, std::array<float, 4>& margins) const {
        const auto startsAbove = [&](int joint) {
            const int parent = rig_.parents[joint];
            if (parent == kNoJoint) return false;
            const PartScores& names = rig_.names[parent].parts;
            const std::array<Part, 4> parts = partsOf(limb.kind);
            const float least = limb.kind == LimbKind::arm ? names[Part::clavicle] : 0.0F;
            return std::max(names[parts[0]], names[parts[1]]) > std::max(least, 0.0F);
        };
        if (limb.jointCount() != 1 || limb.pairs[2] == kNoPair || !isLong) return limb;
        if (startsAbove(figure_.framed.pairs[limb.first].joints[0])) return limb;
        std::swap(limb.pairs[0], limb.pairs[2]);
        std::swap(margins[0], margins[2]);
        return limb;
    }

    [[nodiscard]] bool reachesFromShoulder() const {
        const LimbCandidate& arms = figure_.arms;
        return arms.length > kLeastWholeArm * (arms.root.y - figure_.legs.root.y) && arms.length > arms.root.x;
    }

    // Its joints lie well above the floor, where the legs start.
    [[nodiscard]] bool reachesFromHip() const {
        const float floor = figure_.framed.floor;
        return figure_.legs.root.y - floor > kLeastWholeLeg * (figure_.arms.root.y - floor);
    }

    [[nodiscard]] std::string evidence(int joint, Part part) const {
        std::string text;
        const NameEvidence& name = rig_.names[joint];
        if (name.meaningful && name.parts[part] > 0.0F) text += fmt::format("name \"{}\"; ", joined(name.words));
        if (name.meaningful && name.parts[part] < 0.0F) {
            text += fmt::format("in spite of its name (\"{}\"); ", joined(name.words));
        }
        return text;
    }

    [[nodiscard]] std::string skin(int joint) const {
        if (!rig_.skinned) return {};
        return fmt::format("; moves {:.1f} % of the skin", 100.0F * rig_.ownWeight[joint]);
    }

    void bind(Role role, int joint, Part part, float margin, const std::string& place) {
        const bool isImage = joint >= rig_.count();
        if (joint == kNoJoint || isImage) return;
        const float trust = sideOf(role) == Side::center ? 1.0F : sideTrust_;
        RoleBinding binding;
        binding.joint = joint;
        binding.confidence = std::min(probability(margin) * trust, kCertain);
        binding.reason = evidence(joint, part) + place + skin(joint);
        map_.roles[indexOf(role)] = binding;
    }

    void bindTrunk() {
        const TrunkCandidate& trunk = figure_.trunk;
        bind(Role::hips, trunk.hips, Part::hips, figure_.margins.hips, "central joint at the height of the thighs");
        bind(Role::neck, trunk.neck, Part::neck, figure_.margins.head, "first joint between chest and head");
        bind(Role::head, trunk.head, Part::head, figure_.margins.head, "top of the central chain above the arms");
        std::vector<int> spine;
        if (trunk.chest != trunk.hips) spine = spineBetween(figure_.framed, trunk, figure_.legs, figure_.arms);
        spine.push_back(trunk.chest);
        const std::size_t count = spine.size();
        const auto place = [&](std::size_t index) {
            if (trunk.chest == trunk.hips) return std::string("the whole trunk is this one joint");
            return fmt::format("joint {} of {} of the spine, counted from the hips", index + 1, count);
        };
        const float margin = figure_.margins.chest;
        bind(Role::spine, spine.front(), Part::trunk, margin, place(0));
        if (count >= 2)
            bind(Role::chest, spine[count == 2 ? 1 : (count - 1) / 2], Part::chest, margin,
                 place(count == 2 ? 1 : (count - 1) / 2));
        if (count >= 3) bind(Role::upperChest, spine.back(), Part::chest, margin, place(count - 1));
    }

    void bindLimb(const LimbCandidate& limb, const std::array<Role, 4>& leftRoles, const std::array<float, 4>& margins,
                  const char* what) {
        constexpr std::array<const char*, 3> kOrder{"first", "second", "third"};
        const std::array<Part, 4> parts = partsOf(limb.kind);
        const bool plusIsLeft = figure_.facing.total() >= 0.0F;
        std::size_t order = 0;
        for (std::size_t slot = 0; slot < leftRoles.size(); ++slot) {
            if (limb.pairs[slot] == kNoPair) {
                bindLone(limb, slot, leftRoles[slot], what);
                continue;
            }
            const char* count = slot < 3 ? kOrder[order++] : nullptr;
            for (const bool left : {true, false}) {
                const int joint = figure_.framed.pairs[limb.pairs[slot]].joints[left == plusIsLeft ? 0 : 1];
                const char* side = left ? "left" : "right";
                const std::string place = count != nullptr ? fmt::format("{} joint of the {} {}", count, side, what)
                                          : limb.kind == LimbKind::arm
                                              ? fmt::format("lies between the spine and the {} arm", side)
                                              : fmt::format("lies in front of the {} foot's joint", side);
                bind(left ? leftRoles[slot] : mirrored(leftRoles[slot]), joint, parts[slot], margins[slot], place);
            }
        }
    }

    [[nodiscard]] bool isAstray(int index) const {
        const std::optional<Role> above = parentRole(roleAt(index));
        if (!map_.roles[index] || !above || !map_.roles[indexOf(*above)]) return false;
        return hangingOf(map_, rig_.parents, roleAt(index), *above) != Hanging::below;
    }

    // In a flat hierarchy, where joints hang on the root side by side, that says nothing about single ones.
    void distrustAstray() {
        constexpr float kAstray = 0.9F;
        constexpr float kFlat = 0.8F;
        std::vector<int> astray;
        for (int index = 0; index < kRoleCount; ++index) {
            if (isAstray(index)) astray.push_back(index);
        }
        if (hangsFlat(map_, rig_.parents)) {
            map_.confidence *= kFlat;
            return;
        }
        for (const int index : astray) {
            map_.roles[index]->confidence *= kAstray;
            map_.confidence *= kAstray;
        }
    }

    // A joint that only one side has.
    void bindLone(const LimbCandidate& limb, std::size_t slot, Role leftRole, const char* what) {
        const bool plusIsLeft = figure_.facing.total() >= 0.0F;
        for (std::size_t side = 0; side < limb.lone.size(); ++side) {
            const bool left = (side == 0) == plusIsLeft;
            bind(left ? leftRole : mirrored(leftRole), limb.lone[side][slot], partsOf(limb.kind)[slot], kLoneMargin,
                 fmt::format("goes on with the {} {}, which the other side does not", left ? "left" : "right", what));
        }
    }

    [[nodiscard]] quat standardStance() const {
        const Stance& stance = figure_.framed.stance;
        vec3 left = figure_.facing.total() >= 0.0F ? stance.across() : -stance.across();
        const vec3 up = standsOnStraightLegs() ? vec3(0, 1, 0) : stance.up;
        left -= glm::dot(left, up) * up;
        return glm::conjugate(rotationFromXY(glm::normalize(left), up));
    }

    // Who bows stands, though the names' stance is the trunk's: his legs go straight down in the model.
    [[nodiscard]] bool standsOnStraightLegs() const {
        constexpr float kStraightDown = 0.85F;  // of the legs' length
        constexpr float kMostAcross = 0.5F;     // of the axis across, along the vertical
        const Stance& stance = figure_.framed.stance;
        if (!figure_.posed || std::abs(stance.across().y) > kMostAcross) return false;
        const vec3 legs = figure_.legs.tip - figure_.legs.root;
        const vec3 inModel = legs.x * stance.across() + legs.y * stance.up + legs.z * stance.through();
        return inModel.y < -kStraightDown * figure_.legs.length;
    }

    const Figure& figure_;
    const RigFeatures& rig_;
    float sideTrust_;
    HumanoidMap map_;
};

}  // namespace

HumanoidMap assembleRoles(const Figure& figure, const RigFeatures& rig) {
    return RoleAssembler(figure, rig).assemble();
}

}  // namespace lutka::animation
