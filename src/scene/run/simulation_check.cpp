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
            place(fmt::format("doll {}", i), doll.worldFromModel);
            if (!isFinite(doll.linearVelocity) || !isFinite(doll.angularVelocity))
                say(fmt::format("doll {} has a velocity that is not finite", i));
            range(fmt::format("the strength of doll {}", i), doll.strength, 0.0F, physics::MuscleFactors::kMost);
        }
        for (const Pin& pin : scenario.pins)
            if (!isIndex(pin.doll, scenario.dolls.size()))
                say(fmt::format("a pin holds doll {} of {}", pin.doll, scenario.dolls.size()));
        hits(scenario.hits, scenario.dolls.size());
    }

    void surroundings(const Scenario& scenario) {
        for (std::size_t i = 0; i < scenario.statics.size(); ++i)
            thing(fmt::format("static shape {}", i), scenario.statics[i].worldFromShape, scenario.statics[i]);
        for (std::size_t i = 0; i < scenario.props.size(); ++i)
            thing(fmt::format("prop {}", i), scenario.props[i].state.worldFromBody, scenario.props[i]);
    }

    void options(const SimulationOptions& options, std::size_t dolls) {
        if (options.puppet) hits(options.puppet->hits, dolls);
        if (!(options.dt > 0.0F) || !std::isfinite(options.dt)) say(fmt::format("a step of {} s", options.dt));
        const physics::WorldSettings& world = options.world;
        if (!isFinite(world.gravity)) say("gravity is not finite");
        if (world.threads < 0) say(fmt::format("{} threads", world.threads));
        if (world.substeps) range("substeps", static_cast<float>(*world.substeps), 1.0F, 64.0F);
        if (world.iterations) range("iterations", static_cast<float>(*world.iterations), 1.0F, 1000.0F);
        if (world.linearDamping) share("linear damping", *world.linearDamping);
        if (world.angularDamping) share("angular damping", *world.angularDamping);
        if (options.eye && !isFinite(*options.eye)) say("the eye is not finite");
        if (options.shed.any() && (options.puppet || options.play))
            say("dolls that follow a clip can't be spared: options.shed goes with neither puppet nor play");
    }

  private:
    static constexpr float kMostOffUnit = 0.01F;  // of a squared quaternion

    void say(std::string problem) { problems_.push_back(std::move(problem)); }
    void hits(const std::vector<PuppetHit>& hits, std::size_t dolls) {
        for (const PuppetHit& hit : hits) {
            if (hit.doll != -1 && !isIndex(hit.doll, dolls))
                say(fmt::format("a hit is on doll {} of {}", hit.doll, dolls));
            if (!isFinite(hit.impulse) || !(hit.seconds >= 0.0F) || !std::isfinite(hit.seconds))
                say("a hit's time or impulse is not finite or below 0 s");
        }
    }
    bool place(const std::string& what, const RigidTransform& world) {
        const float square = glm::dot(world.rotation, world.rotation);
        const bool isPlace = isFinite(world) && std::abs(square - 1.0F) < kMostOffUnit;
        if (!isPlace) say(fmt::format("{} stands nowhere: its frame is not finite or no rotation", what));
        return isPlace;
    }
    // What a world would refuse.
    template <class Thing>
    void thing(const std::string& what, const RigidTransform& world, const Thing& thing) {
        if (!place(what, world)) return;
        if (const std::string_view fault = physics::faultOf(thing); !fault.empty())
            say(fmt::format("{}: {}", what, fault));
    }
    void share(const std::string& what, float value) {
        if (!(value >= 0.0F && value < 1.0F)) say(fmt::format("{} is {:g}, not in [0, 1)", what, value));
    }
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
    check.surroundings(scenario);
    check.options(options, scenario.dolls.size());
    return problems;
}

}  // namespace lutka::scene
