#pragma once

#include <optional>
#include <span>
#include <vector>

#include "animation/ik/feet_on_ground.hpp"
#include "physics/collision/shape.hpp"
#include "physics/world/world.hpp"

namespace lutka::scene {

/// What the dolls of a scene walk on: its static shapes. Rays go through dolls and props.
class PuppetGround {
  public:
    explicit PuppetGround(std::span<const physics::StaticShape> statics);

    /// Whether it is level planes alone.
    [[nodiscard]] bool isLevel() const { return isLevel_; }
    /// The ground at a world point: the highest that is no more than a tall step above it; nothing deep below it.
    [[nodiscard]] std::optional<animation::GroundHit> footing(const physics::World& world, const vec3& point) const;
    /// The height of the ground below a point, metres; far below there is some in any case.
    [[nodiscard]] float heightBelow(const physics::World& world, const vec3& point) const;
    /// Of a body's surface from the nearest shape, metres; below 0: in it. 1e9 without shapes.
    [[nodiscard]] float distanceFrom(const physics::BodyShape& shape, const RigidTransform& worldFromBody) const;

  private:
    [[nodiscard]] std::optional<animation::GroundHit> cast(const physics::World& world, const vec3& from,
                                                           const vec3& to) const;

    std::vector<physics::StaticShape> statics_;
    bool isLevel_ = true;
};

}  // namespace lutka::scene
