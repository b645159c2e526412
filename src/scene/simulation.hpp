#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "physics/quality.hpp"
#include "physics/world.hpp"
#include "scene/ragdoll_asset.hpp"
#include "scene/scenario.hpp"

namespace lutka::scene {

/// The pose that the dolls start in.
enum class StartPose { bind, node };

/// Starts the fall from a clip's pose with the velocities that the clip has there.
struct ClipStart {
    std::string clip;
    float seconds = 0.0F;  ///< Clamped to the clip's length.
};

struct SimulationOptions {
    physics::WorldSettings world;
    float dt = 1.0F / 60.0F;  ///< Seconds a step, > 0.
    StartPose pose = StartPose::bind;
    std::optional<ClipStart> fromClip;  ///< Wins over `pose`.
    bool measure = true;                ///< Takes the quality figures after every substep.
};

/// A scenario at work: the world, its dolls and what is measured of them. Same asset, scenario and options give the
/// same bits at every step. The asset must outlive it.
class Simulation {
  public:
    /// Fails with ErrorCode::usage when the clip doesn't exist (the known ones are listed).
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

    [[nodiscard]] int steps() const { return static_cast<int>(stepMs_.size()); }
    [[nodiscard]] double seconds() const { return static_cast<double>(steps()) * static_cast<double>(options_.dt); }
    [[nodiscard]] int dollCount() const { return static_cast<int>(scenario_.dolls.size()); }
    [[nodiscard]] physics::World& world() { return *world_; }
    [[nodiscard]] const physics::World& world() const { return *world_; }
    [[nodiscard]] const Scenario& scenario() const { return scenario_; }
    [[nodiscard]] const SimulationOptions& options() const { return options_; }
    [[nodiscard]] const RagdollAsset& asset() const { return asset_; }
    /// Wall time of every step so far, milliseconds, without the measuring.
    [[nodiscard]] std::span<const float> stepMs() const { return stepMs_; }

    /// The bodies of a doll `alpha` of the way from the state before the last step to the present one.
    [[nodiscard]] std::span<const RigidTransform> worldFromBody(int doll, float alpha = 1.0F);
    /// A prop's frame, likewise.
    [[nodiscard]] RigidTransform worldFromProp(int prop, float alpha = 1.0F) const;
    /// The frame that the doll's model-space pose is relative to; constant.
    [[nodiscard]] const RigidTransform& worldFromModel(int doll) const { return scenario_.dolls[doll].worldFromModel; }
    /// The skin's pose in model space; `modelFromJoint` holds jointCount() frames.
    void pose(int doll, float alpha, std::span<RigidTransform> modelFromJoint);

    [[nodiscard]] physics::Quality quality() const;
    /// Of all body positions, orientations and velocities, bit for bit.
    [[nodiscard]] std::uint64_t stateHash() const;

  private:
    Simulation(const RagdollAsset& asset, Scenario scenario, const SimulationOptions& options);
    void build();
    void remember();

    const RagdollAsset& asset_;
    Scenario scenario_;
    SimulationOptions options_;
    std::vector<physics::BodyState> startInModel_;  // of one doll, its velocities included, in model space
    std::unique_ptr<physics::World> world_;
    std::unique_ptr<physics::QualityMeter> meter_;
    std::vector<float> stepMs_;
    double secondsMeasured_ = 0;

    std::vector<RigidTransform> previous_;  // dolls × bodies, then the props
    std::vector<RigidTransform> present_;
    std::vector<RigidTransform> mixed_;  // one doll's bodies between the two
    mutable std::vector<physics::BodyState> scratch_;
};

}  // namespace lutka::scene
