#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "physics/bullet/bullet_world.hpp"
#include "physics/world/quality.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/description/scenario.hpp"

namespace lutka::bench {

/// The hand-made doll of the tests, bound to its own skeleton.
[[nodiscard]] std::unique_ptr<scene::RagdollAsset> handMadeDoll();

/// A doll of the asset in its bind pose where a scene puts it, moving as the scene says.
[[nodiscard]] std::vector<physics::BodyState> placedBodies(const scene::RagdollAsset& asset,
                                                           const scene::Placement& placement);

/// What to run.
struct TrialSettings {
    std::string scene = "drop";
    std::uint64_t seed = 0;
    int count = 1;
    float seconds = 0.0F;  ///< 0: the scene's own.
    physics::WorldSettings world;
    physics::BulletTuning tuning;
    bool measure = true;  ///< False: times only.
};

/// What came of it.
struct TrialResult {
    physics::Quality quality;
    bool settled = false;          ///< Asleep, or below 1 cm/s, within 6 s of the first contact.
    float turnBeforeSleep = 0.0F;  ///< rad/s, of any body in the second before its doll fell asleep.
    bool slept = false;
    double msPerStep = 0.0;  ///< Of the world alone, without the measuring.
};

/// A world with a scenario's contents, to be stepped by the caller.
class Trial {
  public:
    Trial(const scene::RagdollAsset& asset, const TrialSettings& settings);

    void step();
    [[nodiscard]] int steps() const { return steps_; }
    /// Steps in the whole trial.
    [[nodiscard]] int length() const { return length_; }
    [[nodiscard]] TrialResult result() const;
    [[nodiscard]] const physics::World& world() const { return *world_; }

  private:
    void watchTurning();

    TrialSettings settings_;
    scene::Scenario scenario_;
    std::unique_ptr<physics::World> world_;
    std::unique_ptr<physics::QualityMeter> meter_;
    int steps_ = 0;
    int length_ = 0;
    double seconds_ = 0;
    double ms_ = 0;
    std::vector<float> turning_;  // a step's fastest turn
    std::optional<float> turnBeforeSleep_;
};

}  // namespace lutka::bench
