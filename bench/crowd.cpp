// Quality and cost of the crowd solver beside the Bullet worlds: the same dolls and scene in every world, stepped in
// turn within one process, so that what else the machine does hits all alike. One CSV row a solver and scene.

#include <fmt/format.h>
#include <malloc.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "crowd_settings.hpp"
#include "physics/bullet/bullet_world.hpp"
#include "physics/crowd/crowd_world.hpp"
#include "physics/world/doll_overlap.hpp"
#include "physics/world/quality.hpp"
#include "scene/description/scenario.hpp"
#include "trial.hpp"

namespace {

using namespace lutka;
using physics::crowd::CrowdTuning;

constexpr float kDt = 1.0F / 60.0F;

struct Arguments {
    std::string model;
    std::vector<std::string> scenes{"spread", "pile"};
    std::vector<std::string> solvers{"crowd"};
    std::vector<std::string> settings;  // name=value of the crowd's tuning
    int count = 1;
    int firstSeed = 0;
    int seeds = 1;
    int steps = 300;
    int threads = 1;
    int trace = 0;  // steps between two lines of how dolls overlap at that moment; 0: none
    bool sleeping = false;
    bool measure = true;
};

double msOf(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

double cpuMs() {
    return msOf(CLOCK_PROCESS_CPUTIME_ID);
}

// Bytes that the process has asked the heap for and not given back.
std::ptrdiff_t heapInUse() {
    const auto info = ::mallinfo2();
    return static_cast<std::ptrdiff_t>(info.uordblks + info.hblkhd);
}

// One world with the scene's contents, and what is known of its run.
struct Run {
    std::string solver;
    int stepsPerFrame = 1;
    std::unique_ptr<physics::World> world;
    std::unique_ptr<physics::QualityMeter> meter;
    double seconds = 0;
    std::vector<double> ms;
    double steppingMs = 0;         // of the processor, by the thread that steps the world; measuring counts
    double wallMs = 0;             // likewise
    std::ptrdiff_t heldBytes = 0;  // by the world, without the meter
    std::ptrdiff_t peakBytes = 0;  // after any step
    std::size_t contacts = 0;
};

std::unique_ptr<physics::World> makeWorld(const std::string& solver, const Arguments& arguments) {
    physics::WorldSettings settings;
    settings.sleeping = arguments.sleeping;
    settings.threads = arguments.threads;
    settings.solver = solver.starts_with("stock") ? physics::SolverKind::stock : physics::SolverKind::bullet;
    if (solver != "crowd") return physics::createBulletWorld(settings);
    CrowdTuning tuning;
    for (const std::string& setting : arguments.settings)
        bench::apply(tuning, setting);
    return physics::createCrowdWorld(settings, tuning);
}

void fill(physics::World& world, const scene::RagdollAsset& figure, const scene::Scenario& scenario) {
    for (const physics::StaticShape& shape : scenario.statics)
        world.addStatic(shape);
    for (const physics::DynamicProp& prop : scenario.props)
        world.addProp(prop);
    for (const scene::Placement& placement : scenario.dolls)
        world.addDoll(figure.profile, bench::placedBodies(figure, placement));
    std::vector<physics::BodyState> bodies(figure.profile.bodies.size());
    for (const scene::Pin& pin : scenario.pins) {
        const int body = physics::bodyNamed(figure.profile, pin.body);
        if (body < 0) continue;
        const physics::DollId doll = world.dolls()[pin.doll];
        world.getBodies(doll, bodies);
        world.addDrag({doll, body, vec3(0), bodies[body].worldFromBody.translation, 5000.0F});
    }
}

// How deep bodies of different dolls lie in each other now, in millimetres; shares over those that nearly touch.
struct Overlaps {
    float max = 0.0F, p99 = 0.0F, p50 = 0.0F;
    std::size_t pairs = 0;
};
Overlaps overlapsOf(const physics::World& world) {
    physics::DollOverlap overlap;
    std::vector<physics::BodyState> bodies;
    int index = 0;
    for (const physics::DollId doll : world.dolls()) {
        const physics::RagdollProfile& profile = world.profileOf(doll);
        bodies.resize(profile.bodies.size());
        world.getBodies(doll, bodies);
        overlap.add(index++, profile, bodies);
    }
    const std::span<const float> found = overlap.depths();
    std::vector<float> depths(found.begin(), found.end());
    std::sort(depths.begin(), depths.end());
    const auto at = [&](double share) {
        const auto i = static_cast<std::size_t>(share * static_cast<double>(depths.size()));
        return depths.empty() ? 0.0F : 1e3F * depths[std::min(i, depths.size() - 1)];
    };
    return {at(1.0), at(0.99), at(0.5), depths.size()};
}

void printTrace(const Run& run, int step) {
    const Overlaps now = overlapsOf(*run.world);
    fmt::print("# {} {:.2f} s: {} near pairs, p50 {:.1f} p99 {:.1f} max {:.1f} mm, {:.2f} ms\n", run.solver,
               static_cast<float>(step) * kDt, now.pairs, now.p50, now.p99, now.max, run.ms.back());
    std::fflush(stdout);
}

void step(Run& run, bool measure) {
    double measuring = 0;
    std::ptrdiff_t metersBytes = 0;
    const std::ptrdiff_t bytesBefore = heapInUse();
    const double before = cpuMs();
    const double steppingBefore = msOf(CLOCK_THREAD_CPUTIME_ID);
    const double wallBefore = msOf(CLOCK_MONOTONIC);
    const float dt = kDt / static_cast<float>(run.stepsPerFrame);
    const double substep = static_cast<double>(dt) / run.world->substepsPerStep();
    for (int i = 0; i < run.stepsPerFrame; ++i) {
        if (!measure) {
            run.world->step(dt);
            continue;
        }
        run.world->step(dt, [&] {
            const double start = cpuMs();
            const std::ptrdiff_t bytes = heapInUse();
            run.meter->sample(run.seconds += substep);
            metersBytes += heapInUse() - bytes;
            measuring += cpuMs() - start;
        });
    }
    run.wallMs += msOf(CLOCK_MONOTONIC) - wallBefore;
    run.steppingMs += msOf(CLOCK_THREAD_CPUTIME_ID) - steppingBefore;
    run.ms.push_back(cpuMs() - before - measuring);
    run.heldBytes += heapInUse() - bytesBefore - metersBytes;
    run.peakBytes = std::max(run.peakBytes, run.heldBytes);
    std::vector<physics::ContactPoint> contacts;
    if (measure) run.world->getContacts(contacts);
    run.contacts += contacts.size();
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values)
        sum += value;
    return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

void print(const Run& run, const Run& first, const std::string& scene, int seed, const Arguments& arguments) {
    const physics::Quality quality = run.meter->result();
    std::vector<double> ratios;
    for (std::size_t i = 0; i < run.ms.size(); ++i)
        ratios.push_back(first.ms[i] / run.ms[i]);
    std::sort(ratios.begin(), ratios.end());
    const Overlaps atEnd = overlapsOf(*run.world);
    int asleep = 0;
    for (const physics::DollId doll : run.world->dolls())
        asleep += run.world->isAsleep(doll) ? 1 : 0;
    fmt::print(
        "{},{},{},{},{:.4f},{:.2f},{:.2f},{:.2f},{:.2f},{:.3f},{:.2f},{:.2f},{:.1f},{:.1f},{:.2f},{:.2f},{:.2f},{},{},{"
        "},"
        "{:.2f},{:.1f},{:.1f},{:.1f},{:.1f},{:.4f},{:.4f},{:.1f}\n",
        run.solver, scene, arguments.count, seed, mean(run.ms), mean(first.ms) / mean(run.ms),
        ratios[ratios.size() / 2], quality.jointSeparationM.max * 1e3F, quality.jointSeparationM.p99 * 1e3F,
        quality.jointSeparationM.mean * 1e3F, quality.limitViolationDeg.max, quality.limitViolationDeg.p99,
        quality.floorPenetrationM * 1e3F, quality.selfPenetrationM * 1e3F,
        100.0F * quality.energyGrowthJ / std::max(quality.initialEnergyJ, 1e-3F), quality.settleSeconds.value_or(-1.0F),
        quality.residualSpeedMps * 1e3F, quality.nonFinite, asleep,
        run.contacts / std::max<std::size_t>(run.ms.size(), 1), quality.limitViolationDeg.lasting,
        quality.dollPenetrationM.max * 1e3F, quality.dollPenetrationM.p99 * 1e3F, atEnd.max, atEnd.p99,
        run.steppingMs / static_cast<double>(run.ms.size()), run.wallMs / static_cast<double>(run.ms.size()),
        static_cast<double>(run.peakBytes) / 1024.0 / arguments.count);
    std::fflush(stdout);
}

void runScene(const scene::RagdollAsset& figure, const std::string& scene, int seed, const Arguments& arguments) {
    auto scenario = scene::makeScenario(
        {.name = scene, .count = arguments.count, .seed = static_cast<std::uint64_t>(seed)}, figure);
    if (!scenario) {
        fmt::print(stderr, "{}\n", scenario.error().text());
        return;
    }
    std::vector<Run> runs;
    for (const std::string& solver : arguments.solvers) {
        Run run;
        run.solver = solver;
        if (solver.starts_with("stock") && solver.size() > 5)
            run.stepsPerFrame = std::max(std::stoi(solver.substr(5)), 1);
        const std::ptrdiff_t bytesBefore = heapInUse();
        run.world = makeWorld(solver, arguments);
        fill(*run.world, figure, scenario.value());
        run.heldBytes = heapInUse() - bytesBefore;
        run.meter = std::make_unique<physics::QualityMeter>(*run.world, scenario.value().statics, vec3(0, -9.81F, 0));
        runs.push_back(std::move(run));
    }
    for (int i = 0; i < arguments.steps; ++i) {
        for (Run& run : runs) {
            step(run, arguments.measure);
            if (arguments.trace > 0 && (i + 1) % arguments.trace == 0) printTrace(run, i + 1);
        }
    }
    for (const Run& run : runs)
        print(run, runs.front(), scene, seed, arguments);
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app("Quality and cost of the crowd solver; the ratio is the first solver's time over each one's");
    app.add_option("--model", arguments.model, "a rigged model instead of the hand-made doll");
    app.add_option("--scene", arguments.scenes)->delimiter(',');
    app.add_option("--solver", arguments.solvers, "stock, bullet, crowd; stock8: stock with 8 steps a frame, and so on")
        ->delimiter(',');
    app.add_option("--set", arguments.settings, "name=value of CrowdTuning")->delimiter(',');
    app.add_option("--count", arguments.count);
    app.add_option("--seed", arguments.firstSeed);
    app.add_option("--seeds", arguments.seeds);
    app.add_option("--steps", arguments.steps);
    app.add_option("--threads", arguments.threads);
    app.add_option("--trace", arguments.trace, "a line every so many steps: how dolls overlap then");
    app.add_flag("--sleeping", arguments.sleeping);
    app.add_flag("!--no-measure", arguments.measure);
    CLI11_PARSE(app, argc, argv);

    std::unique_ptr<scene::RagdollAsset> figure;
    if (arguments.model.empty()) {
        figure = bench::handMadeDoll();
    } else {
        auto loaded = scene::loadRagdoll(arguments.model);
        if (!loaded) {
            fmt::print(stderr, "{}\n", loaded.error().text());
            return static_cast<int>(loaded.error().code);
        }
        figure = std::move(loaded).value();
    }
    fmt::print(
        "solver,scene,count,seed,ms,meanRatio,medianRatio,sepMaxMm,sepP99Mm,sepMeanMm,limitMaxDeg,limitP99Deg,floorMm,"
        "selfMm,energyPercent,settleS,residualMmps,nonFinite,asleep,contacts,limitLastingDeg,dollMaxMm,dollP99Mm,"
        "endMaxMm,endP99Mm,steppingMs,wallMs,peakKiB\n");
    for (const std::string& scene : arguments.scenes) {
        for (int seed = arguments.firstSeed; seed < arguments.firstSeed + arguments.seeds; ++seed)
            runScene(*figure, scene, seed, arguments);
    }
    return 0;
}
