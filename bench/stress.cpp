// Falls under conditions that no scene has: other frame times, sizes, masses and gravities, limits of no width, starts
// inside of things, pulls that no body follows, minutes of rest. A line a condition with the worst of its falls, as
// CSV.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <map>
#include <memory>

#include "crowd_settings.hpp"
#include "physics/bullet/bullet_world.hpp"
#include "physics/crowd/crowd_world.hpp"
#include "scene/description/scenario.hpp"
#include "stress_conditions.hpp"
#include "support/falls.hpp"

namespace {

using namespace lutka;
using bench::StressCondition;
using physics::BodyState;

struct Arguments {
    std::vector<std::string> models;
    std::vector<std::string> only;      // names of conditions, or parts of them
    std::vector<std::string> settings;  // name=value of the crowd's tuning
    std::string solver = "crowd";
    int firstSeed = 0;
    int seeds = 3;
    bool all = false;
};

// What came of one fall, or the worst of several.
struct Outcome {
    physics::Quality quality;
    float energyPercent = 0.0F;
    float creepMm = 0.0F;    // that a body moved in the time in which nothing should
    float creepMmps = 0.0F;  // and its greatest speed in it
    int through = 0;         // bodies beyond the wall at the end
    int caught = 0;
    int restless = 0;
    double msPerStep = 0.0;

    void take(const Outcome& other) {
        const physics::Quality& q = other.quality;
        const auto raise = [](auto& to, auto by) { to = std::max(to, by); };
        raise(quality.limitViolationDeg.lasting, q.limitViolationDeg.lasting);
        raise(quality.limitViolationDeg.max, q.limitViolationDeg.max);
        raise(quality.jointSeparationM.max, q.jointSeparationM.max);
        raise(quality.floorPenetrationM, q.floorPenetrationM);
        raise(quality.selfPenetrationM, q.selfPenetrationM);
        raise(quality.dollPenetrationM.max, q.dollPenetrationM.max);
        raise(quality.residualSpeedMps, q.residualSpeedMps);
        quality.nonFinite += q.nonFinite;
        raise(energyPercent, other.energyPercent);
        raise(creepMm, other.creepMm);
        raise(creepMmps, other.creepMmps);
        through += other.through;
        caught += other.caught;
        restless += other.restless;
        raise(msPerStep, other.msPerStep);
    }
};

void print(const std::string& name, const std::string& model, int seed, const Outcome& o) {
    const physics::Quality& q = o.quality;
    fmt::print("{},{},{},{:.1f},{:.1f},{:.2f},{:.1f},{:.1f},{:.1f},{:.2f},{},{:.2f},{:.1f},{:.1f},{},{},{},{:.3f}\n",
               name, model, seed, q.limitViolationDeg.lasting, q.limitViolationDeg.max, q.jointSeparationM.max * 1e3F,
               q.floorPenetrationM * 1e3F, q.selfPenetrationM * 1e3F, q.dollPenetrationM.max * 1e3F, o.energyPercent,
               o.restless, q.residualSpeedMps * 1e3F, o.creepMm, o.creepMmps, o.through, o.caught, q.nonFinite,
               o.msPerStep);
    std::fflush(stdout);
}

std::unique_ptr<physics::World> makeWorld(const Arguments& arguments, const StressCondition& condition) {
    physics::WorldSettings settings;
    settings.gravity = condition.gravity;
    settings.sleeping = condition.sleeping;
    settings.solver = arguments.solver == "stock" ? physics::SolverKind::stock : physics::SolverKind::bullet;
    if (arguments.solver != "crowd") return physics::createBulletWorld(settings);
    physics::crowd::CrowdTuning tuning;
    for (const std::string& setting : arguments.settings)
        bench::apply(tuning, setting);
    return physics::createCrowdWorld(settings, tuning);
}

std::vector<BodyState> placedBodies(const scene::RagdollAsset& asset, const physics::RagdollProfile& profile,
                                    const scene::Placement& placement) {
    std::vector<BodyState> bodies(profile.bodies.size());
    physics::bodiesFromPose(asset.rig, asset.character.skeleton.bindModelFromJoint, placement.worldFromModel, bodies);
    vec3 centre(0);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        centre += bodies[i].worldFromBody.translation * (profile.bodies[i].massKg / profile.totalMassKg);
    for (BodyState& body : bodies) {
        body.linearVelocity =
            placement.linearVelocity + glm::cross(placement.angularVelocity, body.worldFromBody.translation - centre);
        body.angularVelocity = placement.angularVelocity;
    }
    return bodies;
}

Outcome run(const scene::RagdollAsset& asset, const StressCondition& condition, const Arguments& arguments, int seed) {
    physics::RagdollProfile profile = asset.profile;
    if (condition.change) condition.change(profile);
    auto made = scene::makeScenario({.name = condition.scene, .seed = static_cast<std::uint64_t>(seed)}, asset);
    if (!made) {
        fmt::print(stderr, "{}\n", made.error().text());
        return {};
    }
    scene::Scenario scenario = std::move(made).value();
    if (condition.build) condition.build(scenario.statics);
    for (physics::StaticShape& shape : scenario.statics)
        if (condition.friction >= 0.0F) shape.friction = condition.friction;
    const auto world = makeWorld(arguments, condition);
    for (const physics::StaticShape& shape : scenario.statics)
        world->addStatic(shape);
    for (const physics::DynamicProp& prop : scenario.props)
        world->addProp(prop);
    bench::StressRun run{*world, profile, {}, Random(static_cast<std::uint64_t>(seed) + 1), {}};
    for (int i = 0; i < condition.dolls; ++i) {
        std::vector<BodyState> bodies = placedBodies(asset, profile, scenario.dolls.front());
        if (condition.place) condition.place(bodies, profile, run.random);
        for (BodyState& body : bodies)  // several start in each other
            body.worldFromBody.translation += static_cast<float>(i) * vec3(0.02F, 0.03F, 0.01F);
        if (i == 0) run.start = bodies;
        world->addDoll(profile, bodies);
    }
    std::unique_ptr<physics::QualityMeter> meter;
    std::vector<BodyState> bodies(profile.bodies.size()), before;
    Outcome outcome;
    double seconds = 0.0;
    const double end = static_cast<double>(condition.seconds);
    std::chrono::duration<double, std::milli> taken{0};
    int step = 0;
    for (; seconds < end; ++step) {
        const float dt = condition.frames[static_cast<std::size_t>(step) % condition.frames.size()];
        if (meter == nullptr && seconds >= static_cast<double>(condition.measuredFrom))
            meter = std::make_unique<physics::QualityMeter>(*world, scenario.statics, condition.gravity);
        if (condition.act) condition.act(run, step, seconds);
        // A world that rests for minutes is looked at once a step.
        const bool fine = meter != nullptr && (condition.creepFrom == 0.0F || seconds < 10.0);
        const auto start = std::chrono::steady_clock::now();
        if (fine) {
            const double substep = static_cast<double>(dt) / world->substepsPerStep();
            double time = seconds;
            world->step(dt, [&] { meter->sample(time += substep); });
        } else {
            world->step(dt);
            if (meter != nullptr) meter->sample(seconds + static_cast<double>(dt));
        }
        taken += std::chrono::steady_clock::now() - start;
        seconds += static_cast<double>(dt);
        if (condition.creepFrom > 0.0F && seconds >= static_cast<double>(condition.creepFrom)) {
            world->getBodies(world->dolls()[0], bodies);
            if (before.empty()) before = bodies;
            for (std::size_t i = 0; i < bodies.size(); ++i) {
                outcome.creepMm = std::max(outcome.creepMm, 1e3F * glm::distance(bodies[i].worldFromBody.translation,
                                                                                 before[i].worldFromBody.translation));
                outcome.creepMmps = std::max(outcome.creepMmps, 1e3F * glm::length(bodies[i].linearVelocity));
            }
        }
    }
    outcome.quality = meter->result();
    if (!condition.addsEnergy)
        outcome.energyPercent =
            100.0F * outcome.quality.energyGrowthJ / std::max(outcome.quality.initialEnergyJ, 1e-3F);
    outcome.restless = outcome.quality.settleSeconds ? 0 : 1;
    world->getBodies(world->dolls()[0], bodies);
    for (const BodyState& body : bodies)
        outcome.through +=
            !physics::isFinite(body) || (condition.wall > 0.0F && body.worldFromBody.translation.z > condition.wall)
                ? 1
                : 0;
    outcome.caught = static_cast<int>(world->caught().size());
    outcome.msPerStep = taken.count() / std::max(step, 1);
    return outcome;
}

// The figure of a model as a condition wants it. Unset where it can't be had, which is told.
std::unique_ptr<scene::RagdollAsset> load(const std::string& model, const StressCondition& condition) {
    scene::LoadOptions options;
    options.import.loadTextures = false;
    options.fit = condition.fit;
    const auto read = [&]() -> std::unique_ptr<scene::RagdollAsset> {
        auto loaded = scene::loadRagdoll(model, options);
        if (!loaded && scene::wantsAnyRig(loaded.error())) {
            options.fit.rig = physics::RigKind::any;
            loaded = scene::loadRagdoll(model, options);
        }
        if (!loaded) fmt::print(stderr, "{}: {}\n", model, loaded.error().text());
        return loaded ? std::move(loaded).value() : nullptr;
    };
    auto asset = read();
    if (asset == nullptr || condition.heightM == 0.0F) return asset;
    options.import.metresPerFileUnit =
        asset->character.units.metresPerFileUnit * condition.heightM / asset->profile.heightM;
    return read();
}

bool isWanted(const Arguments& arguments, const std::string& name) {
    const auto isPart = [&](const std::string& part) { return name.find(part) != std::string::npos; };
    return arguments.only.empty() || std::any_of(arguments.only.begin(), arguments.only.end(), isPart);
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app("Lets characters fall under conditions that no scene has, and prints the worst of each");
    app.add_option("model", arguments.models, "rigged models")->required();
    app.add_option("--only", arguments.only, "conditions with one of these in their names")->delimiter(',');
    app.add_option("--solver", arguments.solver, "stock, bullet or crowd");
    app.add_option("--set", arguments.settings, "name=value of CrowdTuning")->delimiter(',');
    app.add_option("--seed", arguments.firstSeed, "the first");
    app.add_option("--seeds", arguments.seeds, "how many");
    app.add_flag("--all", arguments.all, "a line for every fall");
    CLI11_PARSE(app, argc, argv);

    fmt::print(
        "condition,model,seed,lastingDeg,maxDeg,separationMm,floorMm,selfMm,dollsMm,energyPercent,restless,"
        "residualMmps,creepMm,creepMmps,through,caught,nonFinite,ms\n");
    for (const StressCondition& condition : bench::stressConditions()) {
        if (!isWanted(arguments, condition.name)) continue;
        Outcome worst;
        for (const std::string& model : arguments.models) {
            const auto asset = load(model, condition);
            if (asset == nullptr) continue;
            for (int seed = arguments.firstSeed; seed < arguments.firstSeed + arguments.seeds; ++seed) {
                const Outcome outcome = run(*asset, condition, arguments, seed);
                if (arguments.all)
                    print(condition.name, std::filesystem::path(model).filename().string(), seed, outcome);
                worst.take(outcome);
            }
        }
        print(condition.name, "-", arguments.seeds, worst);
    }
    return 0;
}
