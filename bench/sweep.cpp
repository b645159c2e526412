// Runs every scene with every seed for every combination of the settings given and prints one CSV row a combination
// and scene: worst figures over the seeds, medians where said so.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>

#include "trial.hpp"

namespace {

using namespace lutka;
using bench::Trial;
using bench::TrialResult;
using bench::TrialSettings;
using physics::BulletTuning;

// A setting that can be varied, with its values to try (its default where none are given).
struct Knob {
    const char* option;
    const char* column;
    float (*get)(const BulletTuning&);
    void (*set)(BulletTuning&, float);
    std::vector<float> values;
};

std::vector<Knob> knobs() {
    const auto knob = [](const char* option, const char* column, auto get, auto set) {
        return Knob{option, column, get, set, {get(BulletTuning{})}};
    };
#define LUTKA_KNOB(option, member)                                                           \
    knob(                                                                                    \
        option, #member, [](const BulletTuning& t) { return static_cast<float>(t.member); }, \
        [](BulletTuning& t, float value) { t.member = static_cast<decltype(t.member)>(value); })
    return {LUTKA_KNOB("--substeps", substeps),        LUTKA_KNOB("--sweeps", sweeps),
            LUTKA_KNOB("--least-sweeps", leastSweeps), LUTKA_KNOB("--tolerance", tolerance),
            LUTKA_KNOB("--mend-sweeps", mendSweeps),   LUTKA_KNOB("--joint-erp", jointErp),
            LUTKA_KNOB("--limit-erp", limitErp),       LUTKA_KNOB("--contact-erp", contactErp),
            LUTKA_KNOB("--margin", contactMargin),     LUTKA_KNOB("--gyration", leastGyration),
            LUTKA_KNOB("--warm-start", warmStart),     LUTKA_KNOB("--angular-damping", angularDamping),
            LUTKA_KNOB("--rest-damping", restDamping), LUTKA_KNOB("--rest-speed", restSpeed),
            LUTKA_KNOB("--rest-turn", restTurn),       LUTKA_KNOB("--rolling", rollingArm),
            LUTKA_KNOB("--quiet", quietSpeed),         LUTKA_KNOB("--rest-tolerance", restTolerance)};
#undef LUTKA_KNOB
}

struct Arguments {
    std::string model;
    std::vector<std::string> scenes{"drop", "stairs", "throw", "hang", "balls"};
    std::vector<std::string> solvers{"bullet"};
    std::vector<Knob> knobs = ::knobs();
    int seeds = 5;
    int count = 1;
    bool perSeed = false;
    bool restless = false;
};

// What keeps a doll from its rest: how its bodies move in the sixth second, the last one before it should have settled.
class Restlessness {
  public:
    void sample(const Trial& trial) {
        constexpr int kSecond = 60;
        if (trial.steps() <= 5 * kSecond || trial.steps() > 6 * kSecond) return;
        std::vector<physics::BodyState> bodies(trial.world().profileOf(trial.world().dolls()[0]).bodies.size());
        trial.world().getBodies(trial.world().dolls()[0], bodies);
        if (watched_.empty()) {
            for (const physics::BodyState& body : bodies)
                watched_.push_back({body.worldFromBody.translation});
        }
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            Watched& watched = watched_[i];
            watched.moved = glm::distance(bodies[i].worldFromBody.translation, watched.start);
            watched.fastest = std::max(watched.fastest, glm::length(bodies[i].linearVelocity));
            watched.fastestTurn = std::max(watched.fastestTurn, glm::length(bodies[i].angularVelocity));
            watched.path += glm::length(bodies[i].linearVelocity) / static_cast<float>(kSecond);
        }
    }
    // A way much longer than what was moved is rocking or swinging, an equal one creeping.
    void print(const Trial& trial, const TrialSettings& settings) const {
        for (std::size_t i = 0; i < watched_.size(); ++i) {
            const Watched& watched = watched_[i];
            fmt::print(stderr, "{} seed {} {}: {:.1f} mm/s and {:.2f} rad/s at most, way {:.1f} mm, moved {:.1f} mm\n",
                       settings.scene, settings.seed, trial.world().profileOf(trial.world().dolls()[0]).bodies[i].joint,
                       1e3F * watched.fastest, watched.fastestTurn, 1e3F * watched.path, 1e3F * watched.moved);
        }
    }

  private:
    struct Watched {
        vec3 start;
        float moved = 0;
        float path = 0;
        float fastest = 0;
        float fastestTurn = 0;
    };
    std::vector<Watched> watched_;
};

void printHeader(const Arguments& arguments) {
    fmt::print("solver,");
    for (const Knob& knob : arguments.knobs)
        fmt::print("{},", knob.column);
    fmt::print(
        "scene,sepMaxMm,sepP99Mm,sepMeanMm,limitMaxDeg,limitP99Deg,staticPenMm,selfPenMm,energyMedianPct,"
        "energyWorstPct,settledPct,settleMedianS,residualMmps,turnBeforeSleep,nonFinite,msPerStep\n");
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

void printRow(const Arguments& arguments, const TrialSettings& s, const std::vector<TrialResult>& results) {
    const auto worst = [&](auto&& figure) {
        double value = 0;
        for (const TrialResult& r : results)
            value = std::max(value, static_cast<double>(figure(r)));
        return value;
    };
    std::vector<double> growth;
    std::vector<double> settle;
    std::vector<double> ms;
    double mean = 0;
    int settled = 0;
    for (const TrialResult& r : results) {
        growth.push_back(100.0 * static_cast<double>(r.quality.energyGrowthJ / r.quality.initialEnergyJ));
        settle.push_back(static_cast<double>(r.quality.settleSeconds.value_or(99.0F)));
        ms.push_back(r.msPerStep);
        mean += static_cast<double>(r.quality.jointSeparationM.mean) / static_cast<double>(results.size());
        settled += r.settled ? 1 : 0;
    }
    fmt::print("{},", s.world.solver == physics::SolverKind::stock ? "stock" : "bullet");
    for (const Knob& knob : arguments.knobs)
        fmt::print("{},", knob.get(s.tuning));
    fmt::print("{},", s.scene);
    fmt::print("{:.2f},{:.2f},{:.3f},{:.1f},{:.2f},{:.2f},{:.2f},",
               1e3 * worst([](const TrialResult& r) { return r.quality.jointSeparationM.max; }),
               1e3 * worst([](const TrialResult& r) { return r.quality.jointSeparationM.p99; }), 1e3 * mean,
               worst([](const TrialResult& r) { return r.quality.limitViolationDeg.max; }),
               worst([](const TrialResult& r) { return r.quality.limitViolationDeg.p99; }),
               1e3 * worst([](const TrialResult& r) { return r.quality.floorPenetrationM; }),
               1e3 * worst([](const TrialResult& r) { return r.quality.selfPenetrationM; }));
    fmt::print("{:.3f},{:.3f},{:.0f},{:.2f},{:.2f},{:.4f},{},{:.4f}\n", median(growth),
               *std::max_element(growth.begin(), growth.end()), 100.0 * settled / static_cast<double>(results.size()),
               median(settle), 1e3 * worst([](const TrialResult& r) { return r.quality.residualSpeedMps; }),
               worst([](const TrialResult& r) { return r.turnBeforeSleep; }),
               worst([](const TrialResult& r) { return r.quality.nonFinite; }), median(ms));
    std::fflush(stdout);
}

void runScenes(const scene::RagdollAsset& asset, const Arguments& arguments, TrialSettings settings) {
    for (const std::string& scene : arguments.scenes) {
        settings.scene = scene;
        std::vector<TrialResult> results;
        for (int seed = 0; seed < arguments.seeds; ++seed) {
            settings.seed = static_cast<std::uint64_t>(seed);
            Trial trial(asset, settings);
            Restlessness restless;
            while (trial.steps() < trial.length()) {
                trial.step();
                restless.sample(trial);
            }
            results.push_back(trial.result());
            if (arguments.restless && !results.back().settled) restless.print(trial, settings);
            if (arguments.perSeed) printRow(arguments, settings, {results.back()});
        }
        if (!arguments.perSeed) printRow(arguments, settings, results);
    }
}

// Every combination of the knobs from `first` on.
void runKnobs(const scene::RagdollAsset& asset, const Arguments& arguments, TrialSettings settings, std::size_t first) {
    if (first == arguments.knobs.size()) {
        runScenes(asset, arguments, settings);
        return;
    }
    for (const float value : arguments.knobs[first].values) {
        arguments.knobs[first].set(settings.tuning, value);
        runKnobs(asset, arguments, settings, first + 1);
    }
}

void runAll(const scene::RagdollAsset& asset, const Arguments& arguments) {
    printHeader(arguments);
    for (const std::string& solver : arguments.solvers) {
        TrialSettings settings;
        settings.count = arguments.count;
        if (solver == "stock") {
            settings.world.solver = physics::SolverKind::stock;
            runScenes(asset, arguments, settings);
        } else {
            runKnobs(asset, arguments, settings, 0);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app{"Quality and time of the physics over scenes, seeds and settings, as CSV"};
    app.add_option("--model", arguments.model, "a rigged model instead of the hand-made doll");
    app.add_option("--scenes", arguments.scenes)->delimiter(',');
    app.add_option("--solvers", arguments.solvers)->delimiter(',');
    for (Knob& knob : arguments.knobs)
        app.add_option(knob.option, knob.values)->delimiter(',');
    app.add_option("--seeds", arguments.seeds, "how many, from 0")->check(CLI::Range(1, 10000));
    app.add_option("--count", arguments.count, "dolls in a scene")->check(CLI::Range(1, 10000));
    app.add_flag("--restless", arguments.restless, "tell on stderr how the first doll moved where it did not settle");
    app.add_flag("--per-seed", arguments.perSeed, "a row for every seed");
    CLI11_PARSE(app, argc, argv);

    std::unique_ptr<scene::RagdollAsset> asset;
    if (arguments.model.empty()) {
        asset = bench::handMadeDoll();
    } else {
        auto loaded = scene::loadRagdoll(arguments.model);
        if (!loaded) {
            std::fprintf(stderr, "%s\n", loaded.error().text().c_str());
            return static_cast<int>(loaded.error().code);
        }
        asset = std::move(loaded).value();
    }
    runAll(*asset, arguments);
    return 0;
}
