#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "physics/world/quality.hpp"
#include "physics/world/world.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/description/scenario.hpp"
#include "scene/puppet/clip_cast.hpp"
#include "scene/puppet/puppet_cast.hpp"
#include "scene/run/load_shedding.hpp"
#include "scene/run/posed_skins.hpp"

namespace lutka::scene {

struct SimulationOptions {
    physics::WorldSettings world;
    float dt = 1.0F / 60.0F;  ///< Seconds a step, > 0.
    StartPose pose = StartPose::bind;
    std::optional<ClipStart> fromClip;  ///< Wins over `pose`.
    /// Set: the dolls follow a clip with their muscles, from its start. Not with `shed`.
    std::optional<PuppetPlay> puppet;
    /// Set: the dolls play this clip, without physics; nothing is measured. Not with `shed`.
    std::optional<ClipPlay> play;
    bool measure = true;      ///< Takes the quality figures after every substep; not with `shed`.
    ShedSettings shed;        ///< What is spared on dolls far from the eye.
    std::optional<vec3> eye;  ///< Unset: the scenario's focus. See setEye().
};

/// How a scene wants to be simulated; what it says nothing of keeps its default.
[[nodiscard]] SimulationOptions simulationOptionsOf(const EntityScene& scene);

/// A scenario at work: the world, its dolls and what is measured of them. Same assets, scenario and options give the
/// same bits at every step. The assets must outlive it.
class Simulation {
  public:
    /// `assets`: one or more, that the placements' `asset` count. Fails with ErrorCode::usage, all problems at once,
    /// when an index names nothing, a number is not finite or out of its range, or options do not go together
    /// (simulation_check.hpp); and when a clip doesn't exist (the known ones are listed).
    [[nodiscard]] static Result<std::unique_ptr<Simulation>> create(std::vector<const RagdollAsset*> assets,
                                                                    Scenario scenario,
                                                                    const SimulationOptions& options);
    /// All dolls of one asset.
    [[nodiscard]] static Result<std::unique_ptr<Simulation>> create(const RagdollAsset& asset, Scenario scenario,
                                                                    const SimulationOptions& options);

    /// One step of options().dt.
    void step();
    /// Shows a recorded frame (bodies of every doll, then the props; world space) as the next step's state, without
    /// physics: world() stays where it was.
    void show(std::span<const RigidTransform> frame);
    /// Shows a frame (as for show()) in place of the present state until refresh() or the next step; nothing moves.
    void preview(std::span<const RigidTransform> frame);
    /// Back to the start: the same bits again.
    void reset();
    /// Call after placing bodies in world() by hand: what is shown is where they are now, not on the way there.
    void refresh();

    [[nodiscard]] int steps() const { return steps_; }
    [[nodiscard]] double seconds() const { return static_cast<double>(steps()) * static_cast<double>(options_.dt); }
    [[nodiscard]] int dollCount() const { return static_cast<int>(scenario_.dolls.size()); }
    /// Its dolls, when none are spared, are the scenario's; see dollId().
    [[nodiscard]] physics::World& world() { return *world_; }
    [[nodiscard]] const physics::World& world() const { return *world_; }
    [[nodiscard]] const Scenario& scenario() const { return scenario_; }
    [[nodiscard]] const SimulationOptions& options() const { return options_; }
    /// What world() calls a doll of the scenario now. With SimulationOptions::shed it changes from step to step, and is
    /// unset while the doll is slow or frozen and thus not in world().
    [[nodiscard]] physics::DollId dollId(int doll) const;
    /// The scenario's doll that world() calls so; -1: none.
    [[nodiscard]] int dollOf(physics::DollId id) const;
    /// The first one, or a doll's.
    [[nodiscard]] const RagdollAsset& asset() const { return *assets_.front(); }
    [[nodiscard]] const RagdollAsset& assetOf(int doll) const { return *assets_[scenario_.dolls[doll].asset]; }
    [[nodiscard]] std::span<const RagdollAsset* const> assets() const { return assets_; }
    /// Bodies of all dolls together.
    [[nodiscard]] std::size_t bodyCount() const { return firstBody_.back(); }
    static constexpr std::size_t kKeptSteps = 36000;  ///< Of stepMs(): ten minutes at 60 Hz.
    /// Wall time of the steps so far, of the last kKeptSteps at least, milliseconds, without the measuring.
    [[nodiscard]] std::span<const float> stepMs() const { return stepMs_; }

    /// The bodies of a doll `alpha` of the way from the state before the last step to the present one. With `alpha` 1
    /// they stay in their place for the simulation's life, those of all dolls one after the other.
    [[nodiscard]] std::span<const RigidTransform> worldFromBody(int doll, float alpha = 1.0F);
    /// Where a doll's skin reaches beyond its bodies: skinReach() of its asset, found when it is asked for first.
    [[nodiscard]] std::span<const std::vector<vec3>> skinReachOf(int doll);
    /// A prop's frame, likewise.
    [[nodiscard]] RigidTransform worldFromProp(int prop, float alpha = 1.0F) const;
    /// The frame that the doll's model-space pose is relative to; constant.
    [[nodiscard]] const RigidTransform& worldFromModel(int doll) const { return scenario_.dolls[doll].worldFromModel; }
    /// The skin's pose in model space; `modelFromJoint` holds a frame a joint of its asset.
    void pose(int doll, float alpha, std::span<RigidTransform> modelFromJoint);
    /// The poses and palettes of all dolls, on as many threads as the world has: for drawing. They differ from pose()
    /// by rounding; see PosedSkins. What is given lives as long as the simulation and changes with the next call.
    [[nodiscard]] const PosedSkins& poseSkins(float alpha);

    /// Which dolls and props pictures leave out for now: a replay shows what was not there yet. Both as long as there
    /// are such, or empty: all are shown.
    void leaveOut(std::vector<bool> dolls, std::vector<bool> props) {
        leftOutDolls_ = std::move(dolls);
        leftOutProps_ = std::move(props);
    }
    [[nodiscard]] bool showsDoll(int doll) const { return leftOutDolls_.empty() || !leftOutDolls_[doll]; }
    [[nodiscard]] bool showsProp(int prop) const { return leftOutProps_.empty() || !leftOutProps_[prop]; }

    /// A doll's bodies of the whole profile with velocities, and whether it sleeps, wherever it is simulated.
    void getBodies(int doll, std::span<physics::BodyState> bodies) const;
    [[nodiscard]] bool isAsleep(int doll) const;
    /// Where SimulationOptions::shed measures its distances from.
    void setEye(const vec3& eye) { eye_ = eye; }
    /// Null without SimulationOptions::puppet.
    [[nodiscard]] const PuppetCast* puppets() const { return puppets_.get(); }
    [[nodiscard]] PuppetCast* puppets() { return puppets_.get(); }
    /// Null without SimulationOptions::play.
    [[nodiscard]] const ClipCast* clipCast() const { return clipCast_.get(); }
    /// Null without SimulationOptions::shed.
    [[nodiscard]] const LoadShedder* shedder() const { return shedder_.get(); }

    [[nodiscard]] physics::Quality quality() const;
    /// Of all body positions, orientations and velocities, bit for bit.
    [[nodiscard]] std::uint64_t stateHash() const;

  private:
    Simulation(std::vector<const RagdollAsset*> assets, Scenario scenario, const SimulationOptions& options);
    Result<void> findStarts();
    Result<void> findPuppets();
    Result<void> findClips();
    void build();
    void addPins();
    void watch();
    void noteTime(float milliseconds);
    void placeActors();
    void placeAtStart(int doll);
    void remember();
    void noteMotion();
    void noteJump();

    std::vector<const RagdollAsset*> assets_;
    Scenario scenario_;
    SimulationOptions options_;
    // Dolls of one asset that start alike share their bodies, in model space with their velocities.
    std::vector<std::vector<physics::BodyState>> starts_;
    std::vector<std::size_t> startOfDoll_;
    std::vector<std::size_t> firstBody_;  // of each doll in previous_ and present_; then the number of all
    std::unique_ptr<physics::World> world_;
    std::unique_ptr<physics::QualityMeter> meter_;
    std::unique_ptr<LoadShedder> shedder_;
    std::unique_ptr<PuppetCast> puppets_;  // after the world that it pulls in
    std::unique_ptr<ClipCast> clipCast_;
    std::vector<RigidTransform> actorPose_;
    vec3 eye_{0, 0, 0};
    int steps_ = 0;
    std::vector<float> stepMs_;
    std::vector<physics::DollId> dollIds_;  // in world_, while nothing is spared
    double secondsMeasured_ = 0;

    std::vector<RigidTransform> previous_;  // the bodies of each doll, then the props
    std::vector<RigidTransform> present_;
    std::vector<bool> leftOutDolls_;
    std::vector<bool> leftOutProps_;
    std::vector<PosedSkins::Motion> motions_;                // one a doll, of previous_ and present_
    std::unique_ptr<PosedSkins> skins_;                      // once something is drawn
    std::vector<RigidTransform> mixed_;                      // one doll's bodies between the two
    std::vector<std::vector<std::vector<vec3>>> skinReach_;  // one an asset, by body; empty: not asked for yet
    mutable std::vector<physics::BodyState> scratch_;
};

}  // namespace lutka::scene
