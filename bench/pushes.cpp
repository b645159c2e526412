// pushes: what a doll that stands by itself takes: the greatest push on its chest from each of eight directions up to
// which it stays up, N s, as CSV, a row a model; or how many of so many pushes from anywhere (docs/puppets.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "puppet_simulation.hpp"

namespace {

using namespace lutka;

constexpr int kWays = 8;
constexpr float kPushAt = 3.0F;  // seconds

struct Arguments {
    std::vector<std::string> models;
    std::string solver = "crowd";
    std::string clip = "idle";
    std::vector<float> pushes{2, 5, 8, 10, 15, 20, 25, 30, 40, 50};
    float seconds = 9.0F;
    bool perMass = false;
    int random = 0;  // pushes of each strength
    std::uint64_t seed = 1;
};

// One doll, which is pushed once.
struct Trial {
    float angle = 0.0F;  // of the push from ahead to the left
    float push = 0.0F;
    bool stood = true;
    float footM = 0.0F;  // farthest that a foot was from where it stood before the push
};

std::vector<vec3> feetOf(const scene::RagdollAsset& asset, std::span<const RigidTransform> bodies) {
    std::vector<vec3> feet;
    for (const physics::Role role : {physics::Role::leftFoot, physics::Role::rightFoot})
        if (const int body = physics::bodyOf(asset.profile, role); body >= 0) feet.push_back(bodies[body].translation);
    return feet;
}

int run(const Arguments& arguments, const std::string& model) {
    const auto asset = orTell(scene::loadRagdoll(model));
    if (asset == nullptr) return 1;
    scene::Scenario scenario;
    scenario.statics.emplace_back();
    scene::PuppetPlay play;
    play.start.clip = arguments.clip;
    play.borrows = true;
    play.pinForceN = 0.0F;
    const scene::Figure figure = scene::figureOf(*asset);
    const float scale = arguments.perMass ? asset->profile.totalMassKg / 75.0F : 1.0F;
    std::vector<Trial> trials{{}};  // the first is not pushed
    Random random(arguments.seed);
    const int ways = arguments.random > 0 ? arguments.random : kWays;
    for (int way = 0; way < ways; ++way) {
        const float turn =
            arguments.random > 0 ? random.uniform(0.0F, 2.0F * kPi) : kPi / 4.0F * static_cast<float>(way);
        for (const float push : arguments.pushes)
            trials.push_back({turn, push});
    }
    for (std::size_t i = 0; i < trials.size(); ++i) {
        scene::Placement& doll = scenario.dolls.emplace_back();
        doll.worldFromModel = {figure.standardFromModel, vec3(4.0F * static_cast<float>(i % 9), -figure.bounds.low.y,
                                                              4.0F * static_cast<float>(i / 9))};
        const float angle = trials[i].angle;
        if (i > 0)
            play.hits.push_back({"upperChest", kPushAt,
                                 scale * trials[i].push * vec3(std::sin(angle), 0, std::cos(angle)),
                                 static_cast<int>(i)});
    }
    const auto made = simulatePuppets(*asset, std::move(scenario), play, arguments.solver);
    if (made == nullptr) return 1;
    scene::Simulation& simulation = *made;
    std::vector<std::vector<vec3>> feet(trials.size());
    const float standing = simulation.worldFromBody(0).front().translation.y;
    for (int step = 0; step < static_cast<int>(arguments.seconds * 60.0F); ++step) {
        simulation.step();
        for (std::size_t i = 0; i < trials.size(); ++i) {
            Trial& trial = trials[i];
            const auto bodies = simulation.worldFromBody(static_cast<int>(i));
            const auto now = feetOf(*asset, bodies);
            if (simulation.seconds() < kPushAt) feet[i] = now;
            for (std::size_t side = 0; side < now.size(); ++side)
                trial.footM = std::max(trial.footM, glm::distance(now[side], feet[i][side]));
            trial.stood = trial.stood && bodies.front().translation.y > 0.85F * standing &&
                          simulation.puppets()->puppet(static_cast<int>(i)).state() != physics::PuppetState::limp;
        }
    }
    fmt::print("{},{},{:.1f},{}", std::filesystem::path(model).filename().string(), arguments.solver,
               asset->profile.totalMassKg, trials[0].stood ? "stands" : "falls");
    float footM = 0.0F;
    const std::size_t strengths = arguments.pushes.size();
    const auto trialOf = [&](std::size_t way, std::size_t strength) -> const Trial& {
        return trials[1 + way * strengths + strength];
    };
    if (arguments.random > 0) {
        for (std::size_t strength = 0; strength < strengths; ++strength) {
            int taken = 0;
            for (int way = 0; way < ways; ++way) {
                const Trial& trial = trialOf(static_cast<std::size_t>(way), strength);
                if (!trial.stood) continue;
                ++taken;
                footM = std::max(footM, trial.footM);
            }
            fmt::print(",{}", taken);
        }
    } else {
        for (std::size_t way = 0; way < kWays; ++way) {
            float most = 0.0F;
            for (std::size_t strength = 0; strength < strengths; ++strength) {
                const Trial& trial = trialOf(way, strength);
                if (!trial.stood) break;
                most = trial.push;
                footM = std::max(footM, trial.footM);
            }
            fmt::print(",{}", most);
        }
    }
    fmt::print(",{:.1f}\n", footM * 100.0F);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app("Pushes that dolls take standing");
    app.add_option("MODEL", arguments.models)->required();
    app.add_option("--solver", arguments.solver);
    app.add_option("--clip", arguments.clip);
    app.add_option("--pushes", arguments.pushes, "N s, growing")->delimiter(',');
    app.add_option("--seconds", arguments.seconds);
    app.add_flag("--per-mass", arguments.perMass, "pushes are those of a doll of 75 kg");
    app.add_option("--random", arguments.random, "so many of each push, from anywhere: how many are taken");
    app.add_option("--seed", arguments.seed);
    CLI11_PARSE(app, argc, argv);
    fmt::print("model,solver,mass_kg,unpushed,{},foot_cm\n", arguments.random > 0
                                                                 ? fmt::format("{}", fmt::join(arguments.pushes, ","))
                                                                 : std::string("ahead,45,left,135,back,225,right,315"));
    int failed = 0;
    for (const std::string& model : arguments.models) {
        failed |= run(arguments, model);
        std::fflush(stdout);
    }
    return failed;
}
