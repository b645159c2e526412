#include "scene/puppet/terrain_walk.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "animation/pose.hpp"
#include "physics/collision/shape.hpp"

namespace lutka::scene {
namespace {

using animation::kNoJoint;
using physics::Role;

constexpr float kAheadSeconds = 0.15F;  // that a foot looks ahead of where it goes
constexpr float kMostAheadM = 0.3F;
constexpr float kHighestStepM = 0.45F;  // over what it stands on: more is no step but a wall
constexpr float kRise = 2.5F;           // m/s at which a foot's ground comes up at most,
constexpr float kFall = 1.5F;           // and goes down
constexpr float kFloorSeconds = 0.15F;  // time constants of the figure's floor and of slopes
constexpr float kSlopeSeconds = 0.05F;
constexpr float kLowM = 0.02F;     // a foot of the clip that is nearer to its height in standing, and
constexpr float kSlowMps = 0.25F;  // slower, stands

struct LegRoles {
    Role upper, lower, foot, toes;
};
constexpr std::array<LegRoles, 2> kLegs{{{Role::leftUpperLeg, Role::leftLowerLeg, Role::leftFoot, Role::leftToes},
                                         {Role::rightUpperLeg, Role::rightLowerLeg, Role::rightFoot, Role::rightToes}}};

float towards(float from, float to, float seconds, float dt) {
    return from + (to - from) * (1.0F - std::exp(-dt / seconds));
}

}  // namespace

std::optional<TerrainWalk> TerrainWalk::of(const RagdollAsset& asset) {
    TerrainWalk walk(asset);
    walk.hips_ = asset.map.jointOf(Role::hips);
    if (walk.hips_ == kNoJoint) return std::nullopt;
    const quat modelFromStandard = glm::conjugate(asset.map.standardFromModel);
    const vec3 up = modelFromStandard * vec3(0, 1, 0);
    const auto& bind = asset.character.skeleton.bindModelFromJoint;
    for (std::size_t i = 0; i < kLegs.size(); ++i) {
        animation::GroundLeg& leg = walk.legs_[i].bones;
        leg.bones.upper = asset.map.jointOf(kLegs[i].upper);
        leg.bones.middle = asset.map.jointOf(kLegs[i].lower);
        leg.bones.end = asset.map.jointOf(kLegs[i].foot);
        leg.toes = asset.map.jointOf(kLegs[i].toes);
        const int foot = physics::bodyOf(asset.profile, kLegs[i].foot);
        if (leg.bones.upper == kNoJoint || leg.bones.middle == kNoJoint || leg.bones.end == kNoJoint || foot < 0)
            return std::nullopt;
        leg.bones.bendInUpper = glm::conjugate(bind[leg.bones.upper].rotation) * (modelFromStandard * vec3(0, 0, 1));
        const RigidTransform& body = asset.rig.bindModelFromBody[foot];
        const float sole = glm::dot(body.translation, up) - physics::supportExtent(asset.profile.bodies[foot].shape,
                                                                                   glm::conjugate(body.rotation) * -up);
        leg.ankleHeight = glm::dot(bind[leg.bones.end].translation, up) - sole;
    }
    return walk;
}

// What a foot is over, and about to be over.
void TerrainWalk::look(Leg& leg, const animation::GroundQuery& ground, float dt, float floor) {
    const float before = leg.isKnown ? leg.height : floor;
    const auto at = [&](const vec3& point) { return ground(vec3(point.x, before, point.z)); };
    const auto below = at(leg.ankle);
    const vec3 normal = below ? below->normal : vec3(0, 1, 0);
    float height = below && below->height < before + kHighestStepM ? below->height : before;
    leg.hasGround = below || at(leg.ball);
    for (const vec3& point : {leg.ball, leg.ball + 0.5F * leg.ahead, leg.ball + leg.ahead}) {
        const auto hit = at(point);
        if (!hit) continue;
        // What lies along the slope below the ankle is the same ground.
        const vec3 step = point - leg.ankle;
        const float slope = -(normal.x * step.x + normal.z * step.z) / std::max(normal.y, 0.2F);
        if (hit->height - slope < before + kHighestStepM) height = std::max(height, hit->height - slope);
    }
    if (!leg.isKnown || dt <= 0.0F) {
        leg.height = height;
        leg.normal = normal;
    } else {
        leg.height = std::clamp(height, leg.height - kFall * dt, leg.height + kRise * dt);
        const float share = 1.0F - std::exp(-dt / kSlopeSeconds);
        leg.normal = glm::normalize(leg.normal + (normal - leg.normal) * share);
    }
    leg.isKnown = true;
}

RigidTransform TerrainWalk::fit(const animation::GroundQuery& ground, float dt, float floor,
                                const RigidTransform& worldFromModel, std::span<RigidTransform> parentFromJoint) {
    const animation::Skeleton& skeleton = asset_->character.skeleton;
    if (dt <= 0.0F) {
        // At another place what was known of the ground says nothing.
        isKnown_ = false;
        hadGround_ = false;
        for (Leg& leg : legs_)
            leg.isKnown = false;
    }
    float mean = 0.0F;
    for (Leg& leg : legs_) {
        const vec3 ankle =
            (worldFromModel * animation::modelFrameOf(skeleton, parentFromJoint, leg.bones.bones.end)).translation;
        const vec3 ball =
            leg.bones.toes == kNoJoint
                ? ankle
                : (worldFromModel * animation::modelFrameOf(skeleton, parentFromJoint, leg.bones.toes)).translation;
        const vec3 way = leg.isKnown && dt > 0.0F ? (ankle - leg.ankle) / dt : vec3(0);
        const vec3 level(way.x, 0.0F, way.z);
        const float speed = glm::length(level);
        leg.stands = ankle.y - floor < leg.bones.ankleHeight + kLowM && speed < kSlowMps && std::abs(way.y) < kSlowMps;
        leg.ahead = leg.stands ? vec3(0) : level * std::min(kAheadSeconds, kMostAheadM / std::max(speed, 1e-3F));
        leg.ankle = ankle;
        leg.ball = ball;
        look(leg, ground, dt, floor);
        hadGround_ = hadGround_ || leg.hasGround;
        mean += 0.5F * leg.height;
    }
    height_ = isKnown_ && dt > 0.0F ? towards(height_, mean, kFloorSeconds, dt) : mean;
    isKnown_ = true;
    RigidTransform lifted = worldFromModel;
    lifted.translation.y += height_ - floor;
    animation::GroundSettings settings;
    settings.hips = hips_;
    settings.floor = height_;
    const std::array<animation::GroundLeg, 2> bones{legs_[0].bones, legs_[1].bones};
    // Each leg is told of its own smoothed ground, as a plane.
    const auto smoothed = [&](const vec3& point) -> std::optional<animation::GroundHit> {
        const auto apart = [&](const Leg& leg) {
            const vec3 toAnkle = point - leg.ankle;
            const vec3 toBall = point - leg.ball;
            return std::min(std::hypot(toAnkle.x, toAnkle.z), std::hypot(toBall.x, toBall.z));
        };
        const Leg& leg = apart(legs_[0]) <= apart(legs_[1]) ? legs_[0] : legs_[1];
        const vec3 step = point - leg.ankle;
        const float slope = -(leg.normal.x * step.x + leg.normal.z * step.z) / std::max(leg.normal.y, 0.2F);
        return animation::GroundHit{leg.height + slope, leg.normal};
    };
    animation::placeFeet(skeleton, bones, settings, lifted, smoothed, parentFromJoint);
    return lifted;
}

}  // namespace lutka::scene
