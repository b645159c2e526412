#include "scene/run/simulation_check.hpp"

#include <fmt/format.h>

#include <cmath>

namespace lutka::scene {
namespace {

class SimulationCheck {
  public:
    explicit SimulationCheck(std::vector<std::string>& problems) : problems_(problems) {}

    void assets(std::span<const RagdollAsset* const> assets) {
        if (assets.empty()) say("there is no asset");
        for (std::size_t i = 0; i < assets.size(); ++i)
            if (assets[i] == nullptr) say(fmt::format("asset {} is null", i));
    }

    void dolls(const Scenario& scenario, std::size_t assetCount) {
        for (std::size_t i = 0; i < scenario.dolls.size(); ++i) {
            const Placement& doll = scenario.dolls[i];
            if (!isIndex(doll.asset, assetCount))
                say(fmt::format("doll {} is of asset {} of {}", i, doll.asset, assetCount));
            const float square = glm::dot(doll.worldFromModel.rotation, doll.worldFromModel.rotation);
            if (!isFinite(doll.worldFromModel) || !(std::abs(square - 1.0F) < kMostOffUnit))
                say(fmt::format("doll {} stands nowhere: its frame is not finite or no rotation", i));
            if (!isFinite(doll.linearVelocity) || !isFinite(doll.angularVelocity))
                say(fmt::format("doll {} has a velocity that is not finite", i));
            range(fmt::format("the strength of doll {}", i), doll.strength, 0.0F, physics::MuscleFactors::kMost);
        }
        for (const Pin& pin : scenario.pins)
            if (!isIndex(pin.doll, scenario.dolls.size()))
                say(fmt::format("a pin holds doll {} of {}", pin.doll, scenario.dolls.size()));
    }

    void options(const SimulationOptions& options) {
        if (!(options.dt > 0.0F) || !std::isfinite(options.dt)) say(fmt::format("a step of {} s", options.dt));
        const physics::WorldSettings& world = options.world;
        if (!isFinite(world.gravity)) say("gravity is not finite");
        if (world.substeps) range("substeps", static_cast<float>(*world.substeps), 1.0F, 64.0F);
        if (world.iterations) range("iterations", static_cast<float>(*world.iterations), 1.0F, 1000.0F);
        if (world.linearDamping) range("linear damping", *world.linearDamping, 0.0F, kMostDamping);
        if (world.angularDamping) range("angular damping", *world.angularDamping, 0.0F, kMostDamping);
        if (options.eye && !isFinite(*options.eye)) say("the eye is not finite");
        if (options.shed.any() && (options.puppet || options.play))
            say("dolls that follow a clip can't be spared: options.shed goes with neither puppet nor play");
    }

  private:
    static constexpr float kMostOffUnit = 0.01F;  // of a squared quaternion
    static constexpr float kMostDamping = 0.999F;

    void say(std::string problem) { problems_.push_back(std::move(problem)); }
    void range(const std::string& what, float value, float low, float high) {
        if (!(value >= low && value <= high))
            say(fmt::format("{} is {:g}, not in [{:g}, {:g}]", what, value, low, high));
    }
    [[nodiscard]] static bool isIndex(int index, std::size_t count) {
        return index >= 0 && static_cast<std::size_t>(index) < count;
    }

    std::vector<std::string>& problems_;
};

}  // namespace

std::vector<std::string> problemsOf(std::span<const RagdollAsset* const> assets, const Scenario& scenario,
                                    const SimulationOptions& options) {
    std::vector<std::string> problems;
    SimulationCheck check(problems);
    check.assets(assets);
    check.dolls(scenario, assets.size());
    check.options(options);
    return problems;
}

}  // namespace lutka::scene
