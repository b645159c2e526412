#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "animation/playback/clip_player.hpp"
#include "core/result.hpp"
#include "physics/powered/puppet.hpp"
#include "scene/ragdoll_asset.hpp"
#include "scene/scenario.hpp"

namespace lutka::scene {

/// A push on every doll of a scene at a moment.
struct PuppetHit {
    physics::Role role = physics::Role::chest;  ///< Dolls without that body are spared.
    float seconds = 0.0F;                       ///< Since the start, >= 0.
    vec3 impulse{0, 0, 0};                      ///< N s, as the figure faces: Y up, +Z ahead; at the body's centre.
};

/// How the dolls of a scene follow a clip with their muscles.
struct PuppetPlay {
    ClipStart start;  ///< The clip, looped from there; without a name the start pose is held.
    physics::PuppetSettings puppet;
    std::vector<PuppetHit> hits;
};

/// How well the dolls kept to their poses, over all of them and all steps in which they were not limp.
struct PuppetFigures {
    float rmsDeg = 0.0F;  ///< Of all joints' angles from the pose's.
    float maxDeg = 0.0F;
    std::string worstJoint;         ///< The body below the joint of `maxDeg`.
    float rootM = 0.0F;             ///< Farthest that a pinned root body was from its pose.
    int limp = 0;                   ///< Dolls that are limp now.
    int knockOuts = 0;              ///< How often any became so.
    float recoverySeconds = -1.0F;  ///< The longest time from a hit until its doll was animated again; -1: none was.
};

/// The dolls of a scene as puppets of a clip.
class PuppetCast {
  public:
    /// Fails with ErrorCode::usage when a doll's character has no such clip. The assets must outlive the cast.
    [[nodiscard]] static Result<std::unique_ptr<PuppetCast>> create(std::span<const RagdollAsset* const> assets,
                                                                    const Scenario& scenario, PuppetPlay play);

    /// Takes the dolls over where they are in the world.
    void begin(physics::World& world, std::span<const physics::DollId> dolls);
    /// Lets go of the dolls: call it before their world ends.
    void end() { actors_.clear(); }
    /// Call before and after each step of the world by `dt` > 0 s.
    void prepare(float dt);
    void measure();

    [[nodiscard]] PuppetFigures figures() const;
    [[nodiscard]] physics::Puppet& puppet(int doll) { return *actors_[doll].puppet; }
    /// The pose that a doll is to have at the end of the last step, one frame a body, world.
    [[nodiscard]] std::span<const RigidTransform> pose(int doll) const { return actors_[doll].to; }
    [[nodiscard]] const PuppetPlay& settings() const { return play_; }

  private:
    struct Actor {
        const RagdollAsset* asset = nullptr;
        const animation::ClipLibrary* library = nullptr;
        RigidTransform worldFromModel;  // moves with the clip's travel
        std::unique_ptr<animation::ClipPlayer> player;
        std::unique_ptr<physics::Puppet> puppet;
        int root = 0;
        std::vector<RigidTransform> from, to;
        float sinceHit = -1.0F;  // seconds; -1: not reacting
    };
    PuppetCast(std::span<const RagdollAsset* const> assets, const Scenario& scenario, PuppetPlay play);
    void startClip(Actor& actor, float seconds, physics::World& world, physics::DollId doll);
    [[nodiscard]] float clearance(const Actor& actor);
    void pose(Actor& actor, std::vector<RigidTransform>& bodies);
    void hitDue(float dt);
    void notice(Actor& actor, physics::PuppetState after);

    std::vector<const RagdollAsset*> assets_;
    std::vector<std::unique_ptr<animation::ClipLibrary>> libraries_;  // one an asset, of the one clip
    std::vector<float> startSeconds_;                                 // likewise
    std::vector<Placement> placements_;
    PuppetPlay play_;
    physics::World* world_ = nullptr;
    std::vector<Actor> actors_;
    double seconds_ = 0.0;

    std::vector<RigidTransform> joints_;  // scratch
    std::vector<physics::BodyState> bodies_;
    std::vector<RigidTransform> frames_;
    std::vector<float> errors_;
    double squares_ = 0.0;
    long long count_ = 0;
    PuppetFigures worst_;
};

}  // namespace lutka::scene
