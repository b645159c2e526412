#include "scene/puppet/floor_keeper.hpp"

#include <algorithm>
#include <array>
#include <glm/gtc/quaternion.hpp>

#include "animation/ik/two_bone.hpp"
#include "animation/retarget/anatomical_rig.hpp"
#include "physics/collision/shape.hpp"

namespace lutka::scene {
namespace {

using physics::Role;

constexpr float kMostOverM = 0.02F;  // of a clearance, that the whole figure is lifted for

constexpr float kSwingOverM = 0.01F;
constexpr float kShortM = 0.02F;  // bodies that end no higher than this over the soles stand on them

struct LimbRoles {
    Role upper, lower, end;
    float ahead;  // where the middle joint sticks out, standard space: +1 ahead, -1 behind
};
constexpr std::array<LimbRoles, 4> kLimbs{{{Role::leftUpperArm, Role::leftLowerArm, Role::leftHand, -1.0F},
                                           {Role::rightUpperArm, Role::rightLowerArm, Role::rightHand, -1.0F},
                                           {Role::leftUpperLeg, Role::leftLowerLeg, Role::leftFoot, 1.0F},
                                           {Role::rightUpperLeg, Role::rightLowerLeg, Role::rightFoot, 1.0F}}};

}  // namespace

float standingFloorOf(const RagdollAsset& asset) {
    const vec3 down = glm::conjugate(asset.profile.standardFromModel) * vec3(0, -1, 0);
    float lowest = 1e9F;
    for (std::size_t body = 0; body < asset.profile.bodies.size(); ++body) {
        const RigidTransform& bind = asset.rig.bindModelFromBody[body];
        const vec3 inBody = glm::conjugate(bind.rotation) * down;
        lowest = std::min(lowest, glm::dot(bind.translation, -down) -
                                      physics::supportExtent(asset.profile.bodies[body].shape, inBody));
    }
    const float soles = animation::floorOf(asset.character, asset.map);
    return lowest > soles + kShortM ? lowest : soles;
}

FloorKeeper::FloorKeeper(const RagdollAsset& asset)
    : asset_(&asset), reachable_(asset.profile), swings_(asset.profile.bodies.size(), 0.0F) {
    for (const LimbRoles& roles : kLimbs) {
        Limb limb;
        limb.upper = physics::bodyOf(asset.profile, roles.upper);
        limb.lower = physics::bodyOf(asset.profile, roles.lower);
        limb.end = physics::bodyOf(asset.profile, roles.end);
        const bool isChain = limb.upper >= 0 && limb.lower >= 0 && limb.end >= 0 &&
                             asset.rig.parentBody[limb.lower] == limb.upper &&
                             asset.rig.parentBody[limb.end] == limb.lower;
        if (!isChain) continue;
        limb.bendInUpper = glm::conjugate(asset.rig.bindModelFromBody[limb.upper].rotation) *
                           (glm::conjugate(asset.profile.standardFromModel) * vec3(0, 0, roles.ahead));
        limb.isLeg = roles.ahead > 0.0F;
        limbs_.push_back(limb);
    }
    for (const LimbRoles& roles : kLimbs) {
        if (roles.ahead < 0.0F || physics::bodyOf(asset.profile, roles.end) >= 0) continue;
        const int lower = physics::bodyOf(asset.profile, roles.lower);
        const int end = lower >= 0 ? lower : physics::bodyOf(asset.profile, roles.upper);
        if (end >= 0) swings_[end] = kSwingOverM;
    }
}

float FloorKeeper::lowestOf(int body, const RigidTransform& worldFromBody) const {
    const vec3 up = glm::conjugate(worldFromBody.rotation) * vec3(0, 1, 0);
    return worldFromBody.translation.y - physics::supportExtent(asset_->profile.bodies[body].shape, -up);
}

void FloorKeeper::closeJoints(std::span<RigidTransform> worldFromBody) const {
    for (std::size_t body = 1; body < worldFromBody.size(); ++body) {
        const physics::Rig::Anchor& anchor = asset_->rig.anchors[body];
        RigidTransform& placed = worldFromBody[body];
        placed.translation =
            worldFromBody[asset_->rig.parentBody[body]] * anchor.inParent - placed.rotation * anchor.inChild;
    }
}

// Within the limits. An arm that can't be lifted out so is bent beyond them, where it will lean on the floor: it is
// no reason to lift the whole figure, which a leg is.
void FloorKeeper::liftEnd(const Limb& limb, float height, std::span<RigidTransform> worldFromBody) const {
    float depth = height - lowestOf(limb.end, worldFromBody[limb.end]);
    if (depth <= 0.0F) return;
    if (reachable_.moveEnd(limb.end, vec3(0, depth, 0), worldFromBody)) {
        if (limb.isLeg) return;
        depth = height - lowestOf(limb.end, worldFromBody[limb.end]);
        if (depth <= 0.0F) return;
    }
    const auto anchor = [&](int body) { return worldFromBody[body] * asset_->rig.anchors[body].inChild; };
    const animation::BonePoints points{anchor(limb.upper), anchor(limb.lower), anchor(limb.end)};
    animation::TwoBoneGoal goal;
    goal.target = points.end + vec3(0, depth, 0);
    const vec3 bend = worldFromBody[limb.upper].rotation * limb.bendInUpper;
    const animation::BoneTurns turns = animation::turnsToReach(points, {}, bend, goal);
    worldFromBody[limb.upper].rotation = glm::normalize(turns.upper * worldFromBody[limb.upper].rotation);
    worldFromBody[limb.lower].rotation = glm::normalize(turns.lower * worldFromBody[limb.lower].rotation);
}

void FloorKeeper::keep(const GroundHeight& ground, std::span<RigidTransform> worldFromBody,
                       std::span<const float> clearance) const {
    for (const Limb& limb : limbs_)
        liftEnd(limb, ground(worldFromBody[limb.end].translation) + (clearance.empty() ? 0.0F : clearance[limb.end]),
                worldFromBody);
    closeJoints(worldFromBody);
    float lift = 0.0F;
    for (int body = 0; body < static_cast<int>(worldFromBody.size()); ++body) {
        const RigidTransform& at = worldFromBody[body];
        const float over = clearance.empty() ? 0.0F : std::min(clearance[body], kMostOverM);
        lift = std::max(lift, ground(at.translation) + over - lowestOf(body, at));
    }
    for (RigidTransform& body : worldFromBody)
        body.translation.y += lift;
}

}  // namespace lutka::scene
