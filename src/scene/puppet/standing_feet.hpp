#pragma once

#include <array>
#include <functional>
#include <span>

#include "animation/ik/feet_on_ground.hpp"
#include "physics/powered/puppet.hpp"
#include "physics/profile/body_state.hpp"
#include "scene/asset/ragdoll_asset.hpp"

namespace lutka::scene {

/// Which feet of a puppet stand flat and still in its pose, and where they came to stand. The asset must outlive this.
class StandingFeet {
  public:
    explicit StandingFeet(const RagdollAsset& asset);

    /// None stands any more.
    void release();

    /// A step of the pose and what the doll made of it, one frame a body, world.
    struct Step {
        std::span<const RigidTransform> from, to;
        std::span<const RigidTransform> bodies;
        std::function<animation::GroundHit(const vec3& worldPoint)> ground;
        float dt = 1.0F / 60.0F;  ///< Seconds, > 0.
        float pace = 1.0F;        ///< Of the clip, over its own.
    };
    /// How far the standing feet have slid over the ground since they came to stand, metres: the most of any; -1 where
    /// none stands.
    float slideAfter(const Step& step);

    /// Holds the feet that stand where they do, turned as they are now, by `forceN` each.
    void hold(physics::Puppet& puppet, std::span<const physics::BodyState> bodies, float forceN) const;

  private:
    struct Foot {
        int body = -1;
        bool stands = false;
        vec3 at{0, 0, 0};
    };
    [[nodiscard]] bool standsInPose(int body, const Step& step) const;

    const RagdollAsset* asset_;
    std::array<Foot, 2> feet_;
};

}  // namespace lutka::scene
