#include "animation/retarget/limb_ends.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

namespace lutka::animation {
namespace {

struct LimbRoles {
    Role upper, lower, end;
    bool leg;
};
constexpr std::array kWholeLimbs{LimbRoles{Role::leftUpperArm, Role::leftLowerArm, Role::leftHand, false},
                                 LimbRoles{Role::rightUpperArm, Role::rightLowerArm, Role::rightHand, false},
                                 LimbRoles{Role::leftUpperLeg, Role::leftLowerLeg, Role::leftFoot, true},
                                 LimbRoles{Role::rightUpperLeg, Role::rightLowerLeg, Role::rightFoot, true}};

// Where the wrist is on the way from the elbow to the fingertips, and the ankle from the knee to the sole (Drillis and
// Contini 1966: forearm 0.146, hand 0.108; lower leg 0.246, foot 0.039 of the height). Of a limb of one joint the way
// begins at its shoulder or hip.
constexpr float kWristOfForearm = 0.146F / (0.146F + 0.108F);
constexpr float kWristOfArm = (0.186F + 0.146F) / (0.186F + 0.146F + 0.108F);
constexpr float kAnkleOfShin = 0.246F / (0.246F + 0.039F);
constexpr float kAnkleOfLeg = (0.245F + 0.246F) / (0.245F + 0.246F + 0.039F);

// The chin above the shoulders, of the way up to them from the hips (ibid.: 0.870, 0.818 and 0.530 of the height).
constexpr float kHeadOfTrunk = (0.870F - 0.818F) / (0.818F - 0.530F);

// Of the way from the hips up to the shoulders (ibid.).
constexpr float kThighOfTrunk = 0.245F / (0.818F - 0.530F);
constexpr float kShinOfTrunk = 0.246F / (0.818F - 0.530F);
constexpr float kAnkleHeightOfTrunk = 0.039F / (0.818F - 0.530F);
constexpr float kHipsOfShoulders = 0.5F;  // ours: how far apart the hip joints are, against the shoulders

// What a joint with all below it has of the figure: points of the skin that it moves most, else the joints below.
std::vector<vec3> pointsOf(const Character& character, int joint) {
    std::vector<vec3> points;
    for (const SkinnedMesh& mesh : character.meshes) {
        for (std::size_t vertex = 0; vertex < mesh.joints.size(); ++vertex) {
            if (isAncestorOrSelf(character.skeleton, joint, mesh.joints[vertex][0]))
                points.push_back(mesh.positions[vertex]);
        }
    }
    if (!points.empty()) return points;
    for (int below = joint + 1; below < character.skeleton.jointCount(); ++below) {
        if (isAncestorOrSelf(character.skeleton, joint, below))
            points.push_back(character.skeleton.bindModelFromJoint[below].translation);
    }
    return points;
}

// From the joint to the tip of what it moves; nothing where it moves nothing. `along`: the way of the bone above, which
// is kept to unless the limb is bent there.
std::optional<vec3> reachOf(const Character& character, int joint, const std::optional<vec3>& along) {
    constexpr float kBent = 0.7F;  // cosine
    const vec3 start = character.skeleton.bindModelFromJoint[joint].translation;
    const std::vector<vec3> points = pointsOf(character, joint);
    vec3 middle(0);
    for (const vec3& point : points)
        middle += (point - start) / static_cast<float>(points.size());
    if (!(glm::length(middle) > 0.0F)) return std::nullopt;
    vec3 way = glm::normalize(middle);
    if (along && glm::dot(*along, way) > kBent) way = *along;
    float farthest = 0.0F;
    for (const vec3& point : points)
        farthest = std::max(farthest, glm::dot(point - start, way));
    return way * farthest;
}

class LimbCompleter {
  public:
    LimbCompleter(const Character& character, const HumanoidMap& map) : character_(character), map_(map) {
        for (int role = 0; role < kRoleCount; ++role)
            out_.joint[role] = map.jointOf(roleAt(role));
        out_.missing = map.missing;
    }

    LimbEnds complete() {
        for (const LimbRoles& limb : kWholeLimbs)
            addTo(limb);
        if (map_.jointOf(Role::head) == kNoJoint) addHead();
        addLegs();
        out_.skeleton = longer_ ? std::move(longer_)
                                : std::shared_ptr<const Skeleton>(std::shared_ptr<void>(), &character_.skeleton);
        return std::move(out_);
    }

  private:
    [[nodiscard]] const vec3& placeOf(int joint) const {
        return character_.skeleton.bindModelFromJoint[joint].translation;
    }

    // On the topmost joint of the trunk, above the shoulders.
    void addHead() {
        int top = kNoJoint;
        for (const Role role : {Role::hips, Role::spine, Role::chest, Role::upperChest, Role::neck})
            top = map_.jointOf(role) != kNoJoint ? map_.jointOf(role) : top;
        const int left = map_.jointOf(Role::leftUpperArm);
        const int right = map_.jointOf(Role::rightUpperArm);
        const int hips = map_.jointOf(Role::hips);
        if (top == kNoJoint || hips == kNoJoint || left == kNoJoint || right == kNoJoint) return;
        const vec3 shoulders = 0.5F * (placeOf(left) + placeOf(right));
        add(Role::head, top, shoulders + kHeadOfTrunk * (shoulders - placeOf(hips)));
    }

    // Straight down from the hips, to where a human's would reach.
    void addLegs() {
        const int left = map_.jointOf(Role::leftUpperArm);
        const int right = map_.jointOf(Role::rightUpperArm);
        const int hips = map_.jointOf(Role::hips);
        for (const LimbRoles& limb : kWholeLimbs) {
            if (!limb.leg) continue;
            const std::array roles{limb.upper, limb.lower, limb.end};
            if (std::any_of(roles.begin(), roles.end(), [&](Role role) { return map_.jointOf(role) != kNoJoint; }))
                return;
        }
        if (hips == kNoJoint || left == kNoJoint || right == kNoJoint) return;
        const vec3 shoulders = 0.5F * (placeOf(left) + placeOf(right));
        const float trunk = glm::distance(shoulders, placeOf(hips));
        if (!(trunk > 0.0F)) return;
        const quat modelFromStandard = glm::conjugate(map_.standardFromModel);
        const vec3 down = modelFromStandard * vec3(0, -trunk, 0);
        for (const LimbRoles& limb : kWholeLimbs) {
            if (!limb.leg) continue;
            const vec3& arm = placeOf(sideOf(limb.upper) == Side::left ? left : right);
            const float aside = (map_.standardFromModel * (arm - shoulders)).x;
            const vec3 hip = placeOf(hips) + modelFromStandard * vec3(kHipsOfShoulders * aside, 0, 0);
            const vec3 knee = hip + kThighOfTrunk * down;
            add(limb.end, add(limb.lower, add(limb.upper, hips, hip), knee), knee + kShinOfTrunk * down);
        }
        out_.ankleHeight = kAnkleHeightOfTrunk * trunk;
    }

    void addTo(const LimbRoles& limb) {
        const int upper = map_.jointOf(limb.upper);
        const int lower = map_.jointOf(limb.lower);
        const int end = map_.jointOf(limb.end);
        if (upper == kNoJoint || (end != kNoJoint && lower != kNoJoint)) return;
        if (end != kNoJoint) {
            if (!isAncestorOrSelf(character_.skeleton, upper, end)) return;
            const int middle = add(limb.lower, upper, 0.5F * (placeOf(upper) + placeOf(end)));
            out_.stiff.push_back({upper, middle, end, limb.leg});
            return;
        }
        if (lower == kNoJoint) {
            const auto reach = reachOf(character_, upper, std::nullopt);
            if (!reach) return;
            const vec3 way = *reach * (limb.leg ? kAnkleOfLeg : kWristOfArm);
            const int middle = add(limb.lower, upper, placeOf(upper) + 0.5F * way);
            out_.stiff.push_back({upper, middle, add(limb.end, middle, placeOf(upper) + way), limb.leg});
            return;
        }
        const vec3 bone = placeOf(lower) - placeOf(upper);
        if (!(glm::length(bone) > 0.0F)) return;
        // A joint that moves nothing is taken to carry a bone as long as the one above.
        const vec3 reach = reachOf(character_, lower, glm::normalize(bone)).value_or(bone);
        add(limb.end, lower, placeOf(lower) + reach * (limb.leg ? kAnkleOfShin : kWristOfForearm));
    }

    // A joint at a place in model space, turned as the one that it hangs on.
    int add(Role role, int parent, const vec3& place) {
        if (!longer_) longer_ = std::make_shared<Skeleton>(character_.skeleton);
        const RigidTransform bind{longer_->bindModelFromJoint[parent].rotation, place};
        longer_->names.emplace_back();
        longer_->parents.push_back(parent);
        longer_->nodeParentFromJoint.push_back(inverse(longer_->bindModelFromJoint[parent]) * bind);
        longer_->bindModelFromJoint.push_back(bind);
        longer_->skinWeight.push_back(0.0F);
        out_.missing.erase(std::remove(out_.missing.begin(), out_.missing.end(), role), out_.missing.end());
        return out_.joint[indexOf(role)] = longer_->jointCount() - 1;
    }

    const Character& character_;
    const HumanoidMap& map_;
    LimbEnds out_;
    std::shared_ptr<Skeleton> longer_;
};

}  // namespace

LimbEnds addLimbEnds(const Character& character, const HumanoidMap& map) {
    return LimbCompleter(character, map).complete();
}

}  // namespace lutka::animation
