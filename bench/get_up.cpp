// get_up: random falls of dolls onto a floor, each of which gets up when it has come to rest. A line a doll that does
// not stand again in time, then the figures of all as CSV (docs/puppets.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "puppet_simulation.hpp"

namespace {

using namespace lutka;
using physics::PuppetState;

struct Arguments {
    std::string model;
    std::string solver = "crowd";
    int falls = 100;
    int seed = 1;
    float seconds = 14.0F;
    float mostSeconds = 4.0F;
};

// What became of one fall.
struct Fall {
    float restedAt = -1.0F;  // when it came to rest for good, seconds
    float stoodAt = -1.0F;
    int tries = 0;
    scene::Lying lying = scene::Lying::prone;
    [[nodiscard]] bool stood(float mostSeconds) const { return stoodAt >= 0.0F && stoodAt - restedAt <= mostSeconds; }
};

class Watch {
  public:
    explicit Watch(scene::Simulation& simulation) : simulation_(simulation) {
        falls_.resize(static_cast<std::size_t>(simulation.dollCount()));
        for (int doll = 0; doll < simulation.dollCount(); ++doll) {
            before_.push_back(PuppetState::limp);
            const scene::RagdollAsset& asset = simulation.assetOf(doll);
            const vec3 up = glm::conjugate(asset.profile.standardFromModel) * vec3(0, 1, 0);
            standing_.push_back(glm::dot(asset.rig.bindModelFromBody.front().translation, up));
        }
    }
    void look() {
        const auto now = static_cast<float>(simulation_.seconds());
        for (int doll = 0; doll < simulation_.dollCount(); ++doll) {
            Fall& fall = falls_[doll];
            const PuppetState state = simulation_.puppets()->puppet(doll).state();
            const auto bodies = simulation_.worldFromBody(doll);
            if (state == PuppetState::gettingUp && before_[doll] == PuppetState::limp) {
                if (fall.tries == 0) fall.restedAt = now - rest_;
                ++fall.tries;
                fall.lying = scene::lyingOf(simulation_.assetOf(doll), bodies);
            }
            before_[doll] = state;
            const bool stands = state == PuppetState::animated && bodies.front().translation.y > 0.9F * standing_[doll];
            if (stands && fall.stoodAt < 0.0F) fall.stoodAt = now;
            if (!stands && state == PuppetState::limp) fall.stoodAt = -1.0F;
        }
    }
    [[nodiscard]] const std::vector<Fall>& falls() const { return falls_; }

  private:
    static constexpr float rest_ = 0.3F;  // for so long it lies before it gets up
    scene::Simulation& simulation_;
    std::vector<Fall> falls_;
    std::vector<PuppetState> before_;
    std::vector<float> standing_;
};

int run(const Arguments& arguments) {
    const auto asset = orTell(scene::loadRagdoll(arguments.model));
    if (asset == nullptr) return 1;
    auto scenario =
        scene::makeScenario({"spread", arguments.falls, static_cast<std::uint64_t>(arguments.seed)}, *asset);
    scene::PuppetPlay play;
    play.getUp = true;
    play.limp = true;
    const auto simulation = simulatePuppets(*asset, std::move(scenario).value(), play, arguments.solver);
    if (simulation == nullptr) return 1;
    Watch watch(*simulation);
    const int steps = static_cast<int>(arguments.seconds * 60.0F);
    for (int step = 0; step < steps; ++step) {
        simulation->step();
        watch.look();
    }
    int stood = 0;
    for (std::size_t i = 0; i < watch.falls().size(); ++i) {
        const Fall& fall = watch.falls()[i];
        if (fall.stood(arguments.mostSeconds)) {
            ++stood;
            continue;
        }
        fmt::print("# doll {} lay on its {}: {} tries, rest at {:.2f} s, stood at {:.2f} s\n", i, lyingName(fall.lying),
                   fall.tries, fall.restedAt, fall.stoodAt);
    }
    const scene::GetUpFigures up = simulation->puppets()->getUpFigures();
    fmt::print("model,solver,falls,stood,begun,mean_s,most_s,step_deg,step_joint,slide_cm,distance_m\n");
    fmt::print("{},{},{},{},{},{:.2f},{:.2f},{:.2f},{},{:.2f},{:.3f}\n", arguments.model, arguments.solver,
               arguments.falls, stood, up.begun, up.meanSeconds, up.mostSeconds, up.mostStepDeg, up.stepJoint,
               up.mostSlideM * 100.0F, up.meanDistanceM);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app("Falls that dolls get up from");
    app.add_option("MODEL", arguments.model)->required();
    app.add_option("--solver", arguments.solver);
    app.add_option("--falls", arguments.falls)->check(CLI::Range(1, 10000));
    app.add_option("--seed", arguments.seed)->check(CLI::Range(1, 1 << 30));
    app.add_option("--seconds", arguments.seconds);
    app.add_option("--most-seconds", arguments.mostSeconds);
    CLI11_PARSE(app, argc, argv);
    return run(arguments);
}
