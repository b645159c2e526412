#include "scene/puppet/stand_on_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "physics/collision/shape.hpp"
#include "scene/puppet/floor_keeper.hpp"
#include "scene/puppet/puppet_ground.hpp"

namespace lutka::scene {
namespace {

constexpr float kStandsM = 0.03F;
constexpr float kUprightDeg = 1.0F;
constexpr float kNoGround = 9.9F;  // metres below the hips: PuppetGround::heightBelow() gives 10 where it finds none
constexpr float kTouchM = 1e-3F;   // what is no deeper in another only touches it

// A doll as it begins, in model space.
struct Standing {
    const RagdollAsset* asset;
    std::vector<RigidTransform> bodies;
    std::vector<std::size_t> solid;  // which of them can be in the way
    vec3 hips;
    float reach = 0.0F;  // of these about the hips, metres

    [[nodiscard]] const physics::BodyShape& shape(std::size_t body) const { return asset->profile.bodies[body].shape; }
};

Standing standingOf(const RagdollAsset& asset, std::span<const physics::BodyState> start) {
    using physics::Role;
    Standing doll{&asset, asset.rig.bindModelFromBody, {}, vec3(0)};
    for (std::size_t body = 0; body < start.size(); ++body)
        doll.bodies[body] = start[body].worldFromBody;
    const int root = std::max(physics::bodyOf(asset.profile, physics::Role::hips), 0);
    doll.hips = doll.bodies[static_cast<std::size_t>(root)].translation;
    constexpr std::array<Role, 6> kArms{Role::leftUpperArm,  Role::leftLowerArm,  Role::leftHand,
                                        Role::rightUpperArm, Role::rightLowerArm, Role::rightHand};
    for (std::size_t body = 0; body < doll.bodies.size(); ++body) {
        const bool isArm = std::any_of(kArms.begin(), kArms.end(), [&](Role role) {
            return physics::bodyOf(asset.profile, role) == static_cast<int>(body);
        });
        if (isArm && start.empty()) continue;
        doll.solid.push_back(body);
        doll.reach = std::max(doll.reach, glm::distance(doll.hips, doll.bodies[body].translation) +
                                              physics::boundingRadius(doll.shape(body)));
    }
    return doll;
}

bool isHeld(const Scenario& scenario, int doll) {
    return std::any_of(scenario.pins.begin(), scenario.pins.end(), [doll](const Pin& pin) { return pin.doll == doll; });
}

// Whether a placed shape is in a placed doll.
bool isIn(const physics::BodyShape& shape, const RigidTransform& worldFromShape, const Standing& doll,
          const RigidTransform& worldFromModel) {
    const float radius = physics::boundingRadius(shape);
    if (glm::distance(worldFromShape.translation, worldFromModel * doll.hips) > radius + doll.reach) return false;
    for (const std::size_t body : doll.solid) {
        const RigidTransform placed = worldFromModel * doll.bodies[body];
        const float far = radius + physics::boundingRadius(doll.shape(body));
        if (glm::distance(worldFromShape.translation, placed.translation) > far) continue;
        if (physics::distanceBetween(shape, worldFromShape, doll.shape(body), placed) < -kTouchM) return true;
    }
    return false;
}

bool areInEachOther(const Standing& a, const RigidTransform& worldFromA, const Standing& b,
                    const RigidTransform& worldFromB) {
    if (glm::distance(worldFromA * a.hips, worldFromB * b.hips) > a.reach + b.reach) return false;
    for (const std::size_t body : a.solid)
        if (isIn(a.shape(body), worldFromA * a.bodies[body], b, worldFromB)) return true;
    return false;
}

// A prop that the doll would be in, or that lies between it and the ground.
bool isPropInTheWay(const Scenario& scenario, const Standing& doll, const vec3& hips, const RigidTransform& stands) {
    const float below = (stands * doll.hips).y;
    physics::BodyShape way;
    way.kind = physics::BodyShape::Kind::capsule;
    way.radius = 1e-3F;
    way.halfLength = std::max(hips.y - below, 0.0F) * 0.5F;
    const RigidTransform worldFromWay{quat(1, 0, 0, 0), {hips.x, (hips.y + below) * 0.5F, hips.z}};
    return std::any_of(scenario.props.begin(), scenario.props.end(), [&](const physics::DynamicProp& prop) {
        const RigidTransform& placed = prop.state.worldFromBody;
        return isIn(prop.shape, placed, doll, stands) ||
               physics::distanceBetween(prop.shape, placed, way, worldFromWay) < 0.0F;
    });
}

std::optional<float> groundBelow(const physics::World& world, const PuppetGround& ground, const vec3& point) {
    float height = 0.0F;
    if (ground.isLevel()) {
        physics::BodyShape probe;
        probe.kind = physics::BodyShape::Kind::sphere;
        probe.radius = 0.0F;
        height = point.y - ground.distanceFrom(probe, {quat(1, 0, 0, 0), point});
    } else {
        height = ground.heightBelow(world, point);
    }
    return point.y - height < kNoGround ? std::optional(height) : std::nullopt;
}

// How far it is to be lifted for its lowest bodies to be out of the ground, which the hips' place knows nothing of: the
// foot up a slope. Nothing where a lift is no help, as in walls.
float liftOutOf(const PuppetGround& ground, const Standing& doll, const RigidTransform& stands, float height) {
    constexpr float kSoleM = 0.05F;
    constexpr float kMostM = 0.4F;
    constexpr float kDeepM = 5e-4F;
    constexpr int kMostTimes = 20;  // each comes nearer by the slope's cosine
    std::vector<std::size_t> soles;
    for (std::size_t body = 0; body < doll.bodies.size(); ++body) {
        const RigidTransform placed = stands * doll.bodies[body];
        const vec3 down = glm::conjugate(placed.rotation) * vec3(0, -1, 0);
        if (placed.translation.y - physics::supportExtent(doll.shape(body), down) < height + kSoleM)
            soles.push_back(body);
    }
    float lift = 0.0F;
    for (int i = 0; i < kMostTimes && lift < kMostM; ++i) {
        float deep = 0.0F;
        for (const std::size_t body : soles) {
            RigidTransform placed = stands * doll.bodies[body];
            placed.translation.y += lift;
            deep = std::max(deep, -ground.distanceFrom(doll.shape(body), placed));
        }
        if (deep < kDeepM) return lift;
        lift += deep;
    }
    return 0.0F;
}

// The turn about the vertical that is in a rotation.
quat yawOf(const quat& turn) {
    const float length = std::hypot(turn.w, turn.y);
    return length > 1e-4F ? quat(turn.w / length, 0, turn.y / length, 0) : quat(1, 0, 0, 0);
}

// Unset where it stays as it is.
std::optional<RigidTransform> placeOnGround(const physics::World& world, const PuppetGround& ground,
                                            const Scenario& scenario, const Standing& doll,
                                            const RigidTransform& worldFromModel) {
    const quat& standard = doll.asset->map.standardFromModel;
    const quat turn = glm::normalize(worldFromModel.rotation * glm::conjugate(standard));
    const bool isUpright = (turn * vec3(0, 1, 0)).y > std::cos(radians(kUprightDeg));
    const vec3 hips = worldFromModel * doll.hips;
    const std::optional<float> height = groundBelow(world, ground, hips);
    if (!height) return std::nullopt;
    const float soles = standingFloorOf(*doll.asset);
    const quat rotation = isUpright ? worldFromModel.rotation : glm::normalize(yawOf(turn) * standard);
    const vec3 place = hips - rotation * doll.hips;
    RigidTransform stands{rotation, {place.x, *height - soles, place.z}};
    if (!ground.isLevel()) stands.translation.y += liftOutOf(ground, doll, stands, *height);
    if (isUpright && place.y - stands.translation.y <= kStandsM) return std::nullopt;
    if (isPropInTheWay(scenario, doll, hips, stands)) return std::nullopt;
    return stands;
}

}  // namespace

void standOnGround(const physics::World& world, std::span<const RagdollAsset* const> assets, const StartOfDoll& startOf,
                   Scenario& scenario) {
    const PuppetGround ground(scenario.statics);
    std::vector<Standing> dolls;
    dolls.reserve(scenario.dolls.size());
    for (int doll = 0; doll < static_cast<int>(scenario.dolls.size()); ++doll)
        dolls.push_back(standingOf(*assets[static_cast<std::size_t>(scenario.dolls[doll].asset)], startOf(doll)));
    // Together, as neighbours who lie askew in the air are in each other's way but stand side by side.
    std::vector<Placement> placed = scenario.dolls;
    std::vector<bool> moves(dolls.size(), false);
    for (std::size_t doll = 0; doll < dolls.size(); ++doll) {
        if (isHeld(scenario, static_cast<int>(doll))) continue;
        Placement& placement = placed[doll];
        const auto stands = placeOnGround(world, ground, scenario, dolls[doll], placement.worldFromModel);
        if (!stands) continue;
        moves[doll] = true;
        placement.worldFromModel = *stands;
        placement.linearVelocity = vec3(0);
        placement.angularVelocity = vec3(0);
    }
    // Of two who would be in each other the later one goes back, which may be in the way of a third.
    const auto isInTheWayOf = [&](std::size_t doll, std::size_t other) {
        return other != doll && (other < doll || !moves[other]) &&
               areInEachOther(dolls[doll], placed[doll].worldFromModel, dolls[other], placed[other].worldFromModel);
    };
    for (bool again = true; again;) {
        again = false;
        for (std::size_t doll = 0; doll < dolls.size(); ++doll) {
            bool isFree = true;
            for (std::size_t other = 0; moves[doll] && isFree && other < dolls.size(); ++other)
                isFree = !isInTheWayOf(doll, other);
            if (isFree) continue;
            moves[doll] = false;
            placed[doll] = scenario.dolls[doll];
            again = true;
        }
    }
    scenario.dolls = std::move(placed);
}

RigidTransform standingPlace(const physics::World& world, const RagdollAsset& asset, const Scenario& scenario, int doll,
                             std::span<const physics::BodyState> start) {
    const RigidTransform& worldFromModel = scenario.dolls[static_cast<std::size_t>(doll)].worldFromModel;
    if (isHeld(scenario, doll)) return worldFromModel;
    return placeOnGround(world, PuppetGround(scenario.statics), scenario, standingOf(asset, start), worldFromModel)
        .value_or(worldFromModel);
}

}  // namespace lutka::scene
