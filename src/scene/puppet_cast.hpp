#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "animation/playback/clip_player.hpp"
#include "animation/playback/inertial_blend.hpp"
#include "core/result.hpp"
#include "physics/powered/puppet.hpp"
#include "scene/floor_keeper.hpp"
#include "scene/get_up_clips.hpp"
#include "scene/ragdoll_asset.hpp"
#include "scene/scenario.hpp"
#include "scene/terrain_walk.hpp"

namespace lutka::scene {

/// How the dolls of a scene follow a clip with their muscles.
struct PuppetPlay {
    ClipStart start;  ///< The clip, looped from there; without a name the start pose is held, or, with getUp, `idle`.
    physics::PuppetSettings puppet;
    std::vector<PuppetHit> hits;
    bool getUp = false;  ///< Limp dolls that have come to rest get up and go on with the clip.
    bool limp = false;   ///< They begin limp.
    float pace = 0.0F;   ///< m/s ahead, for clips that walk in place.
    /// The muscles are each profile's own where it has some; `puppet.muscles.strength` is a factor on them.
    bool ownMuscles = false;
    bool carriesGravity = false;  ///< Joints carry what hangs on them, whatever the profile says.
    /// N, of the hips' pin; unset: the profile's, else `puppet.pinForceN`.
    std::optional<float> pinForceN;
    std::vector<LedPart> led;    ///< Bodies that follow the clip themselves; the others by their muscles.
    vec3 gravity{0, -9.81F, 0};  ///< Of the world: what muscles that carry it work against.
    bool meetsGround = true;     ///< On ground that is not level the clip's feet are fitted to it (TerrainWalk).
    bool borrows = false;        ///< Clips that a character lacks are the mannequin's, retargeted; with getUp always.
    /// Whether the clip was asked for of this character: then one of its own that is only called alike goes before the
    /// mannequin's. A scene names a clip for whatever character comes.
    bool clipOfUser = false;
};

/// Where a doll is in what it follows: a cast in its place goes on from there.
struct PuppetMemory {
    RigidTransform worldFromModel;
    float clipSeconds = 0.0F;
    float ground = 0.0F;   ///< Height where it got up last, metres.
    float base = 0.0F;     ///< Of the level floor that its clip is played on.
    bool limp = false;     ///< Or on its way to its feet.
    double seconds = 0.0;  ///< Since the start, for timed hits.
};

/// Of dolls that got up.
struct GetUpFigures {
    int begun = 0;
    int stood = 0;             ///< How often one came to stand again.
    float mostSeconds = 0.0F;  ///< From coming to rest until it stood.
    float meanSeconds = 0.0F;
    float mostStepDeg = 0.0F;    ///< That a joint turned by in one step on the way.
    std::string stepJoint;       ///< The body below it.
    float mostSlideM = 0.0F;     ///< Of a foot that stood flat in the pose, from where it came to stand.
    float meanDistanceM = 0.0F;  ///< Of the pose lain in from the frame that it went on from.
};

/// How far one joint was from the pose's angle.
struct JointFigures {
    std::string name;  ///< Of the body below it.
    float rmsDeg = 0.0F;
    float maxDeg = 0.0F;
};

/// How well the dolls kept to their poses, over all of them and all steps in which they were not limp.
struct PuppetFigures {
    float rmsDeg = 0.0F;  ///< Of all joints' angles from the pose's.
    float maxDeg = 0.0F;
    std::string worstJoint;            ///< The body below the joint of `maxDeg`.
    std::vector<JointFigures> joints;  ///< Each of them, over all characters that have a body of that name.
    float clipReachDeg = 0.0F;         ///< Most that a joint of the clip was turned by, so that the doll can follow it.
    std::string clipReachJoint;        ///< The body below it.
    float rootM = 0.0F;                ///< Farthest that a pinned root body was from its pose.
    float ledM = 0.0F;                 ///< And any kinematic body.
    /// On ground that is not level, of feet that stand in the clip: the mean and the most that they were above it, and
    /// the deepest in it.
    float footGapMeanM = 0.0F;
    float footGapM = 0.0F;
    float footDepthM = 0.0F;
    float footSlideM = 0.0F;        ///< Farthest that a foot which stands flat in the pose slid while it stood.
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
    [[nodiscard]] PuppetMemory memoryOf(int doll) const;
    /// After begin(), once the doll's bodies are where they were then.
    void resume(int doll, const PuppetMemory& memory);
    /// Call before and after each step of the world by `dt` > 0 s.
    void prepare(float dt);
    void measure();

    [[nodiscard]] PuppetFigures figures() const;
    [[nodiscard]] GetUpFigures getUpFigures() const;
    /// For how long a limp doll has been at rest, seconds; 0 while it moves or is not limp.
    [[nodiscard]] float restSeconds(int doll) const { return actors_[doll].rest; }
    [[nodiscard]] physics::Puppet& puppet(int doll) { return *actors_[doll].puppet; }
    /// The pose that a doll is to have at the end of the last step, one frame a body, world.
    [[nodiscard]] std::span<const RigidTransform> pose(int doll) const { return actors_[doll].to; }
    /// The same in the course of the last step, `alpha` in [0, 1] of it. Holds until the next call.
    [[nodiscard]] std::span<const RigidTransform> pose(int doll, float alpha);
    [[nodiscard]] const PuppetPlay& settings() const { return play_; }
    /// What the first doll's puppet is made with.
    [[nodiscard]] physics::PuppetSettings settingsOfFirst() const {
        return actors_.empty() ? play_.puppet : actors_.front().puppet->settings();
    }

  private:
    struct Actor {
        const RagdollAsset* asset = nullptr;
        int assetIndex = 0;
        const animation::ClipLibrary* library = nullptr;
        RigidTransform worldFromModel;  // moves with the clip's travel
        std::unique_ptr<animation::ClipPlayer> player;
        std::unique_ptr<physics::Puppet> puppet;
        int root = 0;
        std::vector<RigidTransform> from, to;
        float sinceHit = -1.0F;  // seconds; -1: not reacting
        float lift = 0.0F;       // of the clip, so that no shape is in the ground
        float ground = 0.0F;     // height where it got up last
        float base = 0.0F;       // height of the level floor that its clip is played on
        float soles = 0.0F;      // of what it stands on in its bind pose over the model's origin
        std::optional<TerrainWalk> terrain;

        const FloorKeeper* floor = nullptr;
        float rest = 0.0F;                        // seconds that it has been limp and at rest
        std::optional<GetUpClips::Match> rising;  // the clip in which it gets up
        bool isHeldBack = false;                  // some joint could not turn as fast as it should
        float risen = 0.0F;                       // seconds into that clip
        float waited = 0.0F;                      // seconds that it has waited for its feet
        float pace = 1.0F;                        // of the clip in the last step, over its own
        float risingSeconds = 0.0F;               // since it came to rest
        animation::InertialBlend blend;           // into what it does now
        std::vector<RigidTransform> raw;          // what it would do without the blend, at the last step's end
        std::vector<quat> joints;                 // relative rotations after the last step
        struct Foot {
            int body = -1;
            bool stands = false;
            vec3 at{0, 0, 0};
            std::optional<vec3> aim;  // where it was to be on the way up, before the floor
            float lift = 0.0F;        // over the ground, metres
        };
        std::array<Foot, 2> feet;
    };
    // A joint's angles from the pose's, degrees.
    struct JointTally {
        double squares = 0.0;
        long long count = 0;
        float maxDeg = 0.0F;
        void add(const JointTally& other);
        [[nodiscard]] float rmsDeg() const;
    };
    PuppetCast(std::span<const RagdollAsset* const> assets, const Scenario& scenario, PuppetPlay play);
    [[nodiscard]] std::vector<std::pair<std::string, JointTally>> jointTallies() const;
    [[nodiscard]] physics::PuppetSettings settingsOf(const RagdollAsset& asset, int root) const;
    void startClip(Actor& actor, float seconds, physics::World& world, physics::DollId doll);
    [[nodiscard]] float clearance(const Actor& actor);
    void pose(Actor& actor, std::vector<RigidTransform>& bodies, float dt = 0.0F);
    void hitDue(float dt);
    void notice(Actor& actor, physics::PuppetState after);
    void feelContacts();
    void feelGround(Actor& actor);
    Result<void> findClips(const RagdollAsset& asset, const RagdollAsset* donor);
    void playOn(Actor& actor, float dt);
    void watchRest(Actor& actor, float dt);
    void beginRising(Actor& actor, float dt);
    void rise(Actor& actor, float dt);
    [[nodiscard]] float paceOf(Actor& actor);
    void holdFeet(Actor& actor);
    void standUp(Actor& actor, float dt);
    void blendInto(Actor& actor, std::span<const RigidTransform> rawBefore, std::span<const RigidTransform> raw,
                   float dt);
    void show(Actor& actor, float dt);
    [[nodiscard]] static float levelOf(const Actor& actor);
    [[nodiscard]] float lagOf(const Actor& actor, const Actor::Foot& foot) const;
    [[nodiscard]] bool stepsBack(const Actor& actor);
    void liftFeet(Actor& actor, float dt, bool swings);
    void keepLimits(Actor& actor);
    bool holdBack(Actor& actor, float dt);
    void measureRising(Actor& actor);
    void measureFeet(Actor& actor);
    [[nodiscard]] float groundBelow(const vec3& point) const;
    [[nodiscard]] std::optional<animation::GroundHit> groundOn(const vec3& from, const vec3& to) const;
    [[nodiscard]] std::optional<animation::GroundHit> footing(const vec3& point) const;
    void measureFooting(const Actor& actor);

    std::vector<const RagdollAsset*> assets_;
    std::vector<std::unique_ptr<animation::ClipLibrary>> libraries_;  // one an asset, of the one clip
    std::vector<float> startSeconds_;                                 // likewise
    std::vector<std::unique_ptr<GetUpClips>> getUps_;                 // likewise, with PuppetPlay::getUp
    std::vector<std::unique_ptr<FloorKeeper>> floors_;                // likewise
    std::vector<physics::StaticShape> statics_;                       // the ground
    bool isLevel_ = true;                                             // the ground is planes alone
    std::vector<Placement> placements_;
    PuppetPlay play_;
    physics::World* world_ = nullptr;
    std::vector<Actor> actors_;
    double seconds_ = 0.0;
    float dt_ = 0.0F;  // of the last step

    std::vector<RigidTransform> joints_, fitted_, mixed_;  // scratch
    std::vector<physics::BodyState> bodies_;
    std::vector<RigidTransform> frames_;
    std::vector<float> errors_, clearance_;
    std::vector<std::vector<JointTally>> tallies_;  // one an asset, of a tally a constraint
    double gapsM_ = 0.0;
    long long standing_ = 0;  // feet, in all steps
    PuppetFigures worst_;
    PuppetFigures reach_;  // its clipReachDeg and clipReachJoint, of all assets
    GetUpFigures risen_;
    double risenSeconds_ = 0.0;
    double matchedM_ = 0.0;
    std::vector<RigidTransform> before_, now_, relative_;  // scratch
};

}  // namespace lutka::scene
