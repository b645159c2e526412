#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "animation/playback/clip_player.hpp"
#include "core/result.hpp"
#include "physics/profile/body_state.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/description/scenario.hpp"

namespace lutka::scene {

/// A clip that the dolls play instead of falling.
struct ClipPlay {
    ClipStart start;
    float speed = 1.0F;    ///< Clip seconds a second; negative: backwards.
    bool loop = true;      ///< False: stays at its end.
    bool inPlace = false;  ///< True: the figure's way over the ground is left out.
};

/// A clip's moment, found in a character.
struct ClipMoment {
    const animation::Clip* clip = nullptr;  ///< Of the character.
    float seconds = 0.0F;                   ///< Within the clip.
};

/// Fails with ErrorCode::usage when there is no such clip (the known ones are listed; see animation::clipMeant) or it
/// has no such moment. A clip whose own name ends in "@1" is found by it.
[[nodiscard]] Result<ClipMoment> findClipMoment(const animation::Character& character, const ClipStart& start);

/// The poses of all characters that play one clip, the same for all dolls of a character. A loop's way over the ground
/// goes on across its seam.
class ClipCast {
  public:
    /// Fails with ErrorCode::usage where a character doesn't have the clip. `assets` must outlive the cast.
    [[nodiscard]] static Result<std::unique_ptr<ClipCast>> create(std::span<const RagdollAsset* const> assets,
                                                                  const ClipPlay& play);

    void reset();
    /// Goes on by `dt` seconds. Allocates nothing.
    void advance(float dt);

    /// The pose `alpha` of the way from before the last advance() to after it, in model space; jointCount() frames.
    void pose(int asset, float alpha, std::span<RigidTransform> modelFromJoint) const;
    /// The bodies now, in model space, with the velocities of the last advance(): the differences over the step. As
    /// many as the profile has.
    void bodies(int asset, std::span<physics::BodyState> bodies) const;

    [[nodiscard]] const ClipPlay& settings() const { return settings_; }
    [[nodiscard]] float clipSeconds(int asset) const { return actors_[asset].library.seconds(0); }
    /// How far the figure has travelled in a straight line, metres; 0 in place.
    [[nodiscard]] float travelM(int asset) const;

  private:
    // A character.
    struct Actor {
        const RagdollAsset* asset;
        animation::ClipLibrary library;
        std::unique_ptr<animation::ClipPlayer> player;  // of the library, which stays where it is
        float start = 0.0F;
        RigidTransform startGround;  // model from ground at the start
        RigidTransform ground;       // and now
        std::vector<RigidTransform> before;
        std::vector<RigidTransform> now;
        std::vector<physics::BodyState> bodies;
        std::vector<physics::BodyState> bodiesBefore;
    };
    explicit ClipCast(const ClipPlay& settings) : settings_(settings) {}
    void take(Actor& actor) const;

    ClipPlay settings_;
    std::vector<Actor> actors_;
};

}  // namespace lutka::scene
