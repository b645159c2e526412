#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "physics/profile/body_state.hpp"
#include "physics/profile/profile.hpp"
#include "scene/puppet/get_up_clips.hpp"

namespace lutka::scene {

/// A doll's way from lying limp to standing: how long it has been at rest, and how far it is in the clip in which it
/// gets up.
class Rising {
  public:
    /// Call each step of `dt` s in which the doll is limp, which ends any way up: whether it has been at rest for long
    /// enough to get up.
    [[nodiscard]] bool watch(const physics::RagdollProfile& profile, std::span<const physics::BodyState> bodies,
                             bool isAsleep, float dt);
    /// Call each step in which it is not.
    void wake() { rest_ = 0.0F; }
    /// For how long it has been limp and at rest, seconds.
    [[nodiscard]] float restSeconds() const { return rest_; }

    void begin(const GetUpClips::Match& match);
    void end() { match_.reset(); }
    [[nodiscard]] bool isOn() const { return match_.has_value(); }
    /// Of the way that is on.
    [[nodiscard]] const GetUpClips::Match& match() const { return *match_; }
    /// The moment of the clip, seconds.
    [[nodiscard]] float clipSeconds() const { return clipSeconds_; }
    /// Since the doll came to rest, seconds.
    [[nodiscard]] float seconds() const { return seconds_; }
    /// How fast the clip goes, over its own speed.
    [[nodiscard]] float pace() const { return pace_; }

    /// Goes on by `dt` s. The clip begins slowly, as it is `blended` into ([0, 1]), and waits for feet that are behind
    /// by `footLagM`: one that is caught on the floor or on the other leg would be dragged to where it is to stand.
    void advance(float dt, float footLagM, float blended);

    /// The joint that turned most since the last call, degrees and the index of its constraint, by the bodies after a
    /// step; nothing at the first call of a way.
    struct Turn {
        float degrees = 0.0F;
        int constraint = -1;
    };
    [[nodiscard]] std::optional<Turn> turnOfStep(const physics::RagdollProfile& profile,
                                                 std::span<const RigidTransform> worldFromBody);

  private:
    float rest_ = 0.0F;
    std::optional<GetUpClips::Match> match_;
    float clipSeconds_ = 0.0F;
    float waited_ = 0.0F;  // for its feet, seconds
    float pace_ = 1.0F;
    float seconds_ = 0.0F;
    std::vector<quat> joints_;  // relative rotations after the last step
};

}  // namespace lutka::scene
