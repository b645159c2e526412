#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "animation/playback/inertial_blend.hpp"
#include "physics/profile/body_state.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/puppet/floor_keeper.hpp"

namespace lutka::scene {

/// What a puppet is to do, step for step. It takes a raw motion and blends into it from what was shown before. While
/// the puppet gets up, steps back or blends, the pose is kept out of the floor, within the wrists' limits and below a
/// speed of the joints. All frames are one a body of the profile, world. Asset and floor keeper must outlive this.
class ShownMotion {
  public:
    ShownMotion(const RagdollAsset& asset, const FloorKeeper& floor);

    /// Stands in a pose at once.
    void setPose(std::span<const RigidTransform> pose);
    /// Shows bodies that move freely, one step of `dt` > 0 s after the other, so that it can go on from there.
    void follow(std::span<const physics::BodyState> bodies, float dt);
    /// What it would do without the blend, at the end of the step; to be set before advance().
    [[nodiscard]] std::vector<RigidTransform>& raw() { return raw_; }
    /// From what is shown into a motion that rests in raw(). A step takes `dt` > 0 s.
    void blendIntoRaw(float dt);
    /// How much of the way into the raw motion is done, [0, 1].
    [[nodiscard]] float blended() const { return blend_.share(); }

    /// What a step depends on.
    struct Step {
        std::span<const physics::BodyState> bodies;  ///< The doll's, as they are before it.
        const GroundHeight& ground;
        bool rises = false;       ///< On its way up.
        bool mayStep = false;     ///< A foot that was pushed away from where it stands may step back.
        float dt = 1.0F / 60.0F;  ///< > 0 s
    };
    /// Shows the next moment of the raw motion.
    void advance(const Step& step);

    /// What is shown at the beginning and at the end of the last step.
    [[nodiscard]] const std::vector<RigidTransform>& from() const { return from_; }
    [[nodiscard]] const std::vector<RigidTransform>& to() const { return to_; }
    /// The farthest that a foot is from where it is to be, metres.
    [[nodiscard]] float mostFootLag(std::span<const physics::BodyState> bodies) const;

  private:
    struct Foot {
        int body = -1;
        std::optional<vec3> aim;  // where it was to be on the way up, before the floor
        float lift = 0.0F;        // over the ground, metres
    };
    void blend();
    [[nodiscard]] float lagOf(const Foot& foot, std::span<const physics::BodyState> bodies) const;
    [[nodiscard]] bool stepsBack(std::span<const physics::BodyState> bodies) const;
    void liftFeet(const Step& step, bool swings);
    void keepLimits();
    bool holdBack(float dt);

    const RagdollAsset* asset_;
    const FloorKeeper* floor_;
    std::vector<RigidTransform> from_, to_, raw_;
    animation::InertialBlend blend_;  // into what it does now
    bool isHeldBack_ = false;         // some joint could not turn as fast as it should
    std::array<Foot, 2> feet_;
    std::vector<RigidTransform> before_, relative_;  // scratch
    std::vector<float> clearance_;
};

}  // namespace lutka::scene
