#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "animation/playback/clip_player.hpp"
#include "core/result.hpp"
#include "physics/powered/puppet.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/description/scenario.hpp"
#include "scene/puppet/puppet_clips.hpp"
#include "scene/puppet/puppet_ground.hpp"
#include "scene/puppet/puppet_play.hpp"
#include "scene/puppet/puppet_tally.hpp"
#include "scene/puppet/rising.hpp"
#include "scene/puppet/shown_motion.hpp"
#include "scene/puppet/standing_feet.hpp"
#include "scene/puppet/terrain_walk.hpp"

namespace lutka::scene {

/// Where a doll is in what it follows: a cast in its place goes on from there.
struct PuppetMemory {
    RigidTransform worldFromModel;
    float clipSeconds = 0.0F;
    float ground = 0.0F;   ///< Height where it got up last, metres.
    float base = 0.0F;     ///< Of the level floor that its clip is played on.
    bool limp = false;     ///< Or on its way to its feet.
    double seconds = 0.0;  ///< Since the start, for timed hits.
};

/// The dolls of a scene as puppets of a clip.
class PuppetCast {
  public:
    /// Fails with ErrorCode::usage when a doll's character has no such clip. The assets must outlive the cast.
    [[nodiscard]] static Result<std::unique_ptr<PuppetCast>> create(std::span<const RagdollAsset* const> assets,
                                                                    const Scenario& scenario, PuppetPlay play);

    /// Where the dolls begin, one a doll, in place of the scenario's; before begin().
    void place(std::span<const Placement> placements) { placements_.assign(placements.begin(), placements.end()); }
    /// Takes the dolls over where they are in the world.
    void begin(physics::World& world, std::span<const physics::DollId> dolls);
    /// Lets go of the dolls: call it before their world ends.
    void end() { actors_.clear(); }
    [[nodiscard]] PuppetMemory memoryOf(int doll) const;
    /// After begin(), once the doll's bodies are where they were then.
    void resume(int doll, const PuppetMemory& memory);
    /// Call before and after each step of the world by `dt` > 0 s.
    void prepare(float dt);
    void measure();

    [[nodiscard]] PuppetFigures figures() const;
    [[nodiscard]] GetUpFigures getUpFigures() const { return getUps_.figures(); }
    /// For how long a limp doll has been at rest, seconds; 0 while it moves or is not limp.
    [[nodiscard]] float restSeconds(int doll) const { return actors_[doll].rising.restSeconds(); }
    [[nodiscard]] physics::Puppet& puppet(int doll) { return *actors_[doll].puppet; }
    /// The pose that a doll is to have at the end of the last step, one frame a body, world.
    [[nodiscard]] std::span<const RigidTransform> pose(int doll) const { return actors_[doll].motion.to(); }
    /// The same in the course of the last step, `alpha` in [0, 1] of it. Holds until the next call.
    [[nodiscard]] std::span<const RigidTransform> pose(int doll, float alpha);
    [[nodiscard]] const PuppetPlay& settings() const { return play_; }
    /// What the first doll's puppet is made with.
    [[nodiscard]] physics::PuppetSettings settingsOfFirst() const {
        return actors_.empty() ? play_.puppet : actors_.front().puppet->settings();
    }

  private:
    struct Actor {
        Actor(const RagdollAsset& character, const PuppetClips& played)
            : asset(&character), clips(&played), motion(character, *played.floor), feet(character) {}

        const RagdollAsset* asset;
        const PuppetClips* clips;
        int assetIndex = 0;
        RigidTransform worldFromModel;  // moves with the clip's travel
        std::unique_ptr<animation::ClipPlayer> player;
        std::unique_ptr<physics::Puppet> puppet;
        int root = 0;
        float sinceHit = -1.0F;  // seconds; -1: not reacting
        float lift = 0.0F;       // of the clip, so that no shape is in the ground
        float ground = 0.0F;     // height where it got up last
        float base = 0.0F;       // height of the level floor that its clip is played on
        float soles = 0.0F;      // of what it stands on in its bind pose over the model's origin
        std::optional<TerrainWalk> terrain;
        ShownMotion motion;
        Rising rising;
        StandingFeet feet;
    };
    PuppetCast(std::span<const RagdollAsset* const> assets, const Scenario& scenario, PuppetPlay play);
    void startClip(Actor& actor, float seconds, physics::DollId doll);
    [[nodiscard]] float clearance(const Actor& actor);
    void pose(Actor& actor, std::vector<RigidTransform>& bodies, float dt = 0.0F);
    std::span<const physics::BodyState> readBodies(const Actor& actor);
    void hitDue(float dt);
    void notice(Actor& actor, physics::PuppetState after);
    void feelContacts();
    void feelGround(Actor& actor);
    void playOn(Actor& actor, float dt);
    void watchRest(Actor& actor, float dt);
    void beginRising(Actor& actor, float dt);
    void rise(Actor& actor, float dt);
    void standUp(Actor& actor, float dt);
    void show(Actor& actor, float dt);
    [[nodiscard]] static float levelOf(const Actor& actor);
    void measureRising(Actor& actor);
    void measureFeet(Actor& actor);
    void measureFooting(const Actor& actor);

    std::vector<const RagdollAsset*> assets_;
    std::vector<PuppetClips> clips_;  // one an asset
    PuppetGround ground_;
    std::vector<Placement> placements_;
    PuppetPlay play_;
    physics::World* world_ = nullptr;
    std::vector<Actor> actors_;
    double seconds_ = 0.0;
    float dt_ = 0.0F;          // of the last step
    bool isResuming_ = false;  // to be limp again as it was is no knock-out
    TrackingTally tally_;
    GetUpTally getUps_;

    std::vector<RigidTransform> joints_, fitted_, mixed_, now_, frames_;  // scratch
    std::vector<physics::BodyState> bodies_;
    std::vector<float> errors_;
};

}  // namespace lutka::scene
