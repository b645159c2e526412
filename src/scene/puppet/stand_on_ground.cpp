#include "scene/puppet/stand_on_ground.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/puppet/floor_keeper.hpp"
#include "scene/puppet/puppet_ground.hpp"

namespace lutka::scene {
namespace {

constexpr float kStandsM = 0.03F;
constexpr float kUprightDeg = 1.0F;
constexpr float kNoGround = 9.9F;  // metres below the hips: PuppetGround::heightBelow() gives 10 where it finds none

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

// The turn about the vertical that is in a rotation.
quat yawOf(const quat& turn) {
    const float length = std::hypot(turn.w, turn.y);
    return length > 1e-4F ? quat(turn.w / length, 0, turn.y / length, 0) : quat(1, 0, 0, 0);
}

// Unset where it stays as it is.
std::optional<RigidTransform> placeOnGround(const physics::World& world, const PuppetGround& ground,
                                            const RagdollAsset& asset, const RigidTransform& worldFromModel) {
    const quat& standard = asset.map.standardFromModel;
    const quat turn = glm::normalize(worldFromModel.rotation * glm::conjugate(standard));
    const bool isUpright = (turn * vec3(0, 1, 0)).y > std::cos(radians(kUprightDeg));
    const int root = std::max(physics::bodyOf(asset.profile, physics::Role::hips), 0);
    const vec3 hips = asset.rig.bindModelFromBody[static_cast<std::size_t>(root)].translation;
    const vec3 worldHips = worldFromModel * hips;
    const std::optional<float> height = groundBelow(world, ground, worldHips);
    if (!height) return std::nullopt;
    const float soles = standingFloorOf(asset);
    const quat rotation = isUpright ? worldFromModel.rotation : glm::normalize(yawOf(turn) * standard);
    const vec3 place = worldHips - rotation * hips;
    if (isUpright && place.y + soles - *height <= kStandsM) return std::nullopt;
    return RigidTransform{rotation, {place.x, *height - soles, place.z}};
}

}  // namespace

void standOnGround(const physics::World& world, std::span<const RagdollAsset* const> assets, Scenario& scenario) {
    const PuppetGround ground(scenario.statics);
    for (int doll = 0; doll < static_cast<int>(scenario.dolls.size()); ++doll) {
        const bool isHeld = std::any_of(scenario.pins.begin(), scenario.pins.end(),
                                        [doll](const Pin& pin) { return pin.doll == doll; });
        Placement& placement = scenario.dolls[static_cast<std::size_t>(doll)];
        if (isHeld) continue;
        const RagdollAsset& asset = *assets[static_cast<std::size_t>(placement.asset)];
        const auto stands = placeOnGround(world, ground, asset, placement.worldFromModel);
        if (!stands) continue;
        placement.worldFromModel = *stands;
        placement.linearVelocity = vec3(0);
        placement.angularVelocity = vec3(0);
    }
}

RigidTransform standingPlace(const physics::World& world, const RagdollAsset& asset, const Scenario& scenario,
                             const RigidTransform& worldFromModel) {
    return placeOnGround(world, PuppetGround(scenario.statics), asset, worldFromModel).value_or(worldFromModel);
}

}  // namespace lutka::scene
