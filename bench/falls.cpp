// How many falls of real models keep the bounds of a sound doll: each model, scene and seed by itself. A line a fall
// that breaks a bound, then the worst figures of each scene.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "crowd_settings.hpp"
#include "physics/bullet/bullet_world.hpp"
#include "physics/profile/constraint_state.hpp"
#include "support/falls.hpp"

namespace {

using namespace lutka;

struct Arguments {
    std::vector<std::string> models;
    std::vector<std::string> scenes{"drop", "stairs", "throw", "balls"};
    std::vector<std::string> settings;  // name=value of the crowd's tuning
    std::string solver = "crowd";
    int firstSeed = 0;
    int seeds = 100;
    int jobs = 1;
    float seconds = 8.0F;
    float limitDeg = 15.0F;
    bool all = false;
    bool holds = false;
};

std::unique_ptr<physics::World> makeWorld(const Arguments& arguments) {
    physics::WorldSettings settings;
    settings.solver = arguments.solver == "stock" ? physics::SolverKind::stock : physics::SolverKind::bullet;
    settings.contactReports = arguments.holds;
    settings.sleeping = !arguments.holds;  // what sleeps reports no contacts
    if (arguments.solver != "crowd") return physics::createBulletWorld(settings);
    physics::crowd::CrowdTuning tuning;
    for (const std::string& setting : arguments.settings)
        bench::apply(tuning, setting);
    return physics::createCrowdWorld(settings, tuning);
}

struct Trial {
    const scene::RagdollAsset* asset = nullptr;
    std::string model;
    test::FallSettings settings;
    test::Fall fall;
    std::string holds;  // what holds the figure up at the end, if asked for
};

// The name of one side of a contact of a doll.
std::string sideName(const physics::ContactReport::Side& side, const physics::RagdollProfile& profile) {
    using Kind = physics::ContactReport::Side::Kind;
    return side.kind == Kind::doll ? profile.bodies[side.body].name : side.kind == Kind::prop ? "prop" : "ground";
}

// What a doll is held by: its contacts with the share of its weight that they bear, and the joints at their stops.
std::string holdsOf(const physics::World& world, physics::DollId doll) {
    constexpr float kAtStop = radians(1.0F);
    const physics::RagdollProfile& profile = world.profileOf(doll);
    const float weight = profile.totalMassKg * 9.81F / 60.0F;
    std::string text;
    for (const physics::ContactReport& contact : world.contactReports())
        text += fmt::format(" {}-{} {:.0f}%", sideName(contact.a, profile), sideName(contact.b, profile),
                            100.0F * contact.impulse / weight);
    text += "; at stops:";
    std::vector<physics::BodyState> bodies(profile.bodies.size());
    world.getBodies(doll, bodies);
    for (const physics::ConstraintProfile& constraint : profile.constraints) {
        const RigidTransform& parent = bodies[constraint.parent].worldFromBody;
        const RigidTransform& child = bodies[constraint.child].worldFromBody;
        // A range that is narrower by a degree shows what is at its end.
        physics::ConstraintProfile inner = constraint;
        inner.hinge = {inner.hinge.lower + kAtStop, inner.hinge.upper - kAtStop};
        inner.cone.swingY -= kAtStop;
        inner.cone.swingZ -= kAtStop;
        inner.cone.twist -= kAtStop;
        const physics::ConstraintState state = physics::measureConstraint(inner, parent, child);
        if (state.violation <= 0.0F) continue;
        text += constraint.kind == physics::ConstraintProfile::Kind::hinge
                    ? fmt::format(" {} {:.0f}", profile.bodies[constraint.child].name, degrees(state.hingeAngle))
                    : fmt::format(" {} {:.0f}/{:.0f}/{:.0f}", profile.bodies[constraint.child].name,
                                  degrees(state.swing.y), degrees(state.swing.z), degrees(state.twist));
    }
    return text;
}

void runAll(std::vector<Trial>& trials, const Arguments& arguments) {
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t i = next++; i < trials.size(); i = next++) {
            if (arguments.holds) {
                trials[i].settings.atEnd = [&trial = trials[i]](const physics::World& world, physics::DollId doll) {
                    trial.holds = holdsOf(world, doll);
                };
            }
            auto done = test::fall(*trials[i].asset, makeWorld(arguments), trials[i].settings);
            if (done) trials[i].fall = std::move(done).value();
        }
    };
    std::vector<std::thread> threads;
    for (int i = 1; i < arguments.jobs; ++i)
        threads.emplace_back(work);
    work();
    for (std::thread& thread : threads)
        thread.join();
}

float energyPercent(const physics::Quality& q) {
    return 100.0F * q.energyGrowthJ / std::max(q.initialEnergyJ, 1e-3F);
}

void printFall(const Trial& trial) {
    const physics::Quality& q = trial.fall.quality;
    fmt::print("{},{},{},{:.2f},{:.2f},{},{:.2f},{:.2f},{:.2f},{:.3f},{:.2f},{:.3f},{:.1f}\n", trial.model,
               trial.settings.scene, trial.settings.seed, q.limitViolationDeg.lasting, q.limitViolationDeg.max,
               trial.fall.worstJoint, q.jointSeparationM.max * 1e3F, q.floorPenetrationM * 1e3F,
               q.selfPenetrationM * 1e3F, energyPercent(q), q.settleSeconds.value_or(-1.0F), trial.fall.hipsHeightShare,
               trial.fall.trunkLeanDeg);
    if (!trial.holds.empty()) fmt::print("#  {}\n", trial.holds);
}

// The value that a share of the falls does not exceed.
template <class Measure>
float quantile(const std::vector<const Trial*>& trials, double share, const Measure& measure) {
    std::vector<float> values;
    for (const Trial* trial : trials)
        values.push_back(measure(trial->fall));
    std::sort(values.begin(), values.end());
    const auto at = static_cast<std::size_t>(share * static_cast<double>(values.size()));
    return values.empty() ? 0.0F : values[std::min(at, values.size() - 1)];
}

void printSummary(const std::string& name, const std::vector<const Trial*>& trials, const Arguments& arguments) {
    int past = 0, restless = 0;
    std::size_t lying = 0;
    for (const Trial* trial : trials) {
        const physics::Quality& q = trial->fall.quality;
        past += q.limitViolationDeg.lasting > arguments.limitDeg ? 1 : 0;
        restless += !q.settleSeconds || *q.settleSeconds > 6.0F ? 1 : 0;
        lying += trial->fall.lies() ? 1 : 0;
    }
    const auto at = [&](double share, auto measure) { return quantile(trials, share, measure); };
    const auto lasting = [](const test::Fall& f) { return f.quality.limitViolationDeg.lasting; };
    const auto self = [](const test::Fall& f) { return f.quality.selfPenetrationM * 1e3F; };
    const auto floor = [](const test::Fall& f) { return f.quality.floorPenetrationM * 1e3F; };
    const auto separation = [](const test::Fall& f) { return f.quality.jointSeparationM.max * 1e3F; };
    const auto energy = [](const test::Fall& f) { return energyPercent(f.quality); };
    // Elsewhere a figure may rest on a step or against a wall.
    const std::string lie = name == "drop" ? fmt::format("; {} do not lie", trials.size() - lying) : "";
    fmt::print(
        "# {}: {} falls, {} past {}° for two frames, worst {:.1f}°, p99 {:.1f}°; separation {:.2f} mm; ground {:.1f} "
        "mm, "
        "p99 {:.1f}; self {:.1f} mm, p99 {:.1f}; energy {:.2f} %; {} not at rest in 6 s{}\n",
        name, trials.size(), past, arguments.limitDeg, at(1, lasting), at(0.99, lasting), at(1, separation),
        at(1, floor), at(0.99, floor), at(1, self), at(0.99, self), at(1, energy), restless, lie);
}

void printResults(const std::vector<Trial>& trials, const Arguments& arguments) {
    fmt::print(
        "model,scene,seed,lastingDeg,maxDeg,joint,separationMm,floorMm,selfMm,energyPercent,settleS,hipsShare,"
        "leanDeg\n");
    for (const Trial& trial : trials) {
        const bool upright = arguments.holds && trial.settings.scene == "drop" && !trial.fall.lies();
        const bool past = trial.fall.quality.limitViolationDeg.lasting > arguments.limitDeg;
        if (arguments.all || past || upright) printFall(trial);
    }
    std::vector<const Trial*> every;
    for (const std::string& scene : arguments.scenes) {
        std::vector<const Trial*> ofScene;
        for (const Trial& trial : trials) {
            if (trial.settings.scene == scene) ofScene.push_back(&trial);
        }
        printSummary(scene, ofScene, arguments);
        every.insert(every.end(), ofScene.begin(), ofScene.end());
    }
    if (arguments.scenes.size() > 1) printSummary("all", every, arguments);
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app("Lets characters fall in named scenes, one at a time, and tells which break the bounds");
    app.add_option("model", arguments.models, "rigged models")->required();
    app.add_option("--scene", arguments.scenes)->delimiter(',');
    app.add_option("--solver", arguments.solver, "stock, bullet or crowd");
    app.add_option("--set", arguments.settings, "name=value of CrowdTuning")->delimiter(',');
    app.add_option("--seed", arguments.firstSeed, "the first");
    app.add_option("--seeds", arguments.seeds, "how many");
    app.add_option("--jobs", arguments.jobs, "falls at a time");
    app.add_option("--seconds", arguments.seconds);
    app.add_option("--limit", arguments.limitDeg, "degrees past a limit for two frames that count as broken");
    app.add_flag("--all", arguments.all, "a line for every fall");
    app.add_flag("--holds", arguments.holds, "what holds up those that do not lie after a drop, without sleep");
    CLI11_PARSE(app, argc, argv);

    std::vector<std::unique_ptr<scene::RagdollAsset>> assets;
    std::vector<Trial> trials;
    for (const std::string& model : arguments.models) {
        auto loaded = test::loadFigure(model);
        if (!loaded) {
            fmt::print(stderr, "{}: {}\n", model, loaded.error().text());
            continue;
        }
        assets.push_back(std::move(loaded).value());
        for (const std::string& scene : arguments.scenes) {
            for (int seed = arguments.firstSeed; seed < arguments.firstSeed + arguments.seeds; ++seed) {
                trials.push_back({assets.back().get(),
                                  std::filesystem::path(model).filename().string(),
                                  {scene, static_cast<std::uint64_t>(seed), arguments.seconds},
                                  {},
                                  {}});
            }
        }
    }
    runAll(trials, arguments);
    printResults(trials, arguments);
    return assets.size() == arguments.models.size() ? 0 : 1;
}
