#include "scene/puppet/puppet_ground.hpp"

#include <algorithm>
#include <cmath>

#include "physics/collision/static_distance.hpp"

namespace lutka::scene {

PuppetGround::PuppetGround(std::span<const physics::StaticShape> statics) : statics_(statics.begin(), statics.end()) {
    isLevel_ = std::all_of(statics_.begin(), statics_.end(), [](const physics::StaticShape& shape) {
        const vec3 up = shape.worldFromShape.rotation * vec3(0, 1, 0);
        return shape.kind == physics::StaticShape::Kind::plane && up.y > 1.0F - 1e-4F;
    });
}

std::optional<animation::GroundHit> PuppetGround::cast(const physics::World& world, const vec3& from,
                                                       const vec3& to) const {
    constexpr int kMostAbove = 64;  // shapes of its own legs, and of those who lie there
    constexpr float kOnM = 2e-3F;
    physics::BodyShape point;
    point.kind = physics::BodyShape::Kind::sphere;
    point.radius = 0.0F;
    vec3 start = from;
    for (int i = 0; i < kMostAbove && start.y > to.y; ++i) {
        const auto hit = world.rayTest(start, to);
        if (!hit) return std::nullopt;
        const bool isStatic = std::any_of(statics_.begin(), statics_.end(), [&](const physics::StaticShape& shape) {
            return std::abs(physics::distanceToStatic(point, {quat(1, 0, 0, 0), hit->position}, shape)) < kOnM;
        });
        if (!hit->doll.isSet() && isStatic && hit->normal.y > 0.1F)
            return animation::GroundHit{hit->position.y, hit->normal};
        start = hit->position - vec3(0, 1e-3F, 0);
    }
    return std::nullopt;
}

std::optional<animation::GroundHit> PuppetGround::footing(const physics::World& world, const vec3& point) const {
    constexpr float kAboveM = 0.8F;
    constexpr float kBelowM = 2.0F;
    return cast(world, point + vec3(0, kAboveM, 0), point - vec3(0, kBelowM, 0));
}

float PuppetGround::heightBelow(const physics::World& world, const vec3& point) const {
    constexpr float kFarM = 10.0F;
    const vec3 lowest = point - vec3(0, kFarM, 0);
    const auto hit = cast(world, point, lowest);
    return hit ? hit->height : lowest.y;
}

float PuppetGround::distanceFrom(const physics::BodyShape& shape, const RigidTransform& worldFromBody) const {
    float nearest = 1e9F;
    for (const physics::StaticShape& ground : statics_)
        nearest = std::min(nearest, physics::distanceToStatic(shape, worldFromBody, ground));
    return nearest;
}

}  // namespace lutka::scene
