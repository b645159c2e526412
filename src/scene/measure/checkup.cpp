#include "scene/measure/checkup.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/run/simulation.hpp"

namespace lutka::scene {
namespace {

using physics::Finding;
using physics::Quality;
using physics::Severity;

constexpr int kDrops = 3;
constexpr int kSteps = 360;             // 6 s: what a drop may take to come to rest
constexpr float kNeverSettled = 99.0F;  // seconds, stands for "never" in a bound
constexpr float kStaticShare = 0.8F;

float energySharePercent(const Quality& q) {
    return q.initialEnergyJ > 0.0F ? 100.0F * q.energyGrowthJ / q.initialEnergyJ : 0.0F;
}

struct Measure {
    const char* name;
    const char* unit;
    float bound;
    float (*of)(const Quality&);
    const char* mend;
};

// The bounds of a sound doll (docs/physics.md): what the default fit keeps on every model that it is tested on.
constexpr Measure kMeasures[] = {
    {"joint separation", "mm", 10.0F, [](const Quality& q) { return q.jointSeparationM.max * 1e3F; },
     "draw the masses of linked bodies together (--masses balanced)"},
    {"limit violation, p99", "deg", 5.0F, [](const Quality& q) { return q.limitViolationDeg.p99; },
     "widen limits that the body's own weight presses on"},
    {"limit violation, lasting", "deg", 20.0F, [](const Quality& q) { return q.limitViolationDeg.lasting; },
     "widen the limits of light bodies that lie under the others: hands and feet"},
    {"penetration of the ground", "mm", 10.0F, [](const Quality& q) { return q.floorPenetrationM * 1e3F; },
     "make thin bodies thicker"},
    {"energy growth", "% of the energy", 3.0F, &energySharePercent,
     "look for overlapping bodies and limits that exclude the bind pose"},
    {"settle time", "s", 6.0F, [](const Quality& q) { return q.settleSeconds.value_or(kNeverSettled); },
     "more friction in the joints settles a doll sooner"},
    {"residual speed", "m/s", 0.01F, [](const Quality& q) { return q.residualSpeedMps; },
     "look for bodies that press on each other at rest: filter the pair or shrink them"},
};

std::vector<Quality> dropThrice(const RagdollAsset& asset, const DropObserver& observe) {
    std::vector<Quality> drops;
    for (std::uint64_t seed = 0; seed < kDrops; ++seed) {
        auto scenario = makeScenario({.name = "drop", .seed = seed}, asset);
        if (!scenario) return drops;
        auto simulation = Simulation::create(asset, std::move(scenario).value(), {});
        if (!simulation) return drops;
        const int drop = static_cast<int>(seed);
        if (observe) observe(drop, *simulation.value());
        for (int step = 0; step < kSteps; ++step) {
            simulation.value()->step();
            if (observe) observe(drop, *simulation.value());
        }
        drops.push_back(simulation.value()->quality());
    }
    return drops;
}

constexpr int kWalkSteps = 180;
constexpr float kHitSeconds = 1.0F;

Result<std::unique_ptr<Simulation>> walking(const RagdollAsset& asset, std::vector<PuppetHit> hits) {
    const Figure figure = figureOf(asset);
    Scenario ground;
    ground.statics.emplace_back();
    ground.dolls.emplace_back().worldFromModel = {figure.standardFromModel, vec3(0, -figure.bounds.low.y, 0)};
    SimulationOptions options;
    PuppetPlay& play = options.puppet.emplace();
    play.start.clip = "walk";
    play.borrows = true;
    play.ownMuscles = true;
    play.hits = std::move(hits);
    auto simulation = Simulation::create(asset, std::move(ground), options);
    if (!simulation) return simulation.error();
    for (int step = 0; step < kWalkSteps; ++step)
        simulation.value()->step();
    return std::move(simulation).value();
}

void walk(const RagdollAsset& asset, Checkup& checkup) {
    if (!asset.map.humanoid) return;
    const auto simulation = walking(asset, {});
    if (!simulation) {
        checkup.noWalk = simulation.error().message;
        return;
    }
    const physics::World& world = simulation.value()->world();
    WalkCheck& check = checkup.walk.emplace();
    check.figures = simulation.value()->puppets()->figures();
    check.motorWorkJ = world.motorWork();
    check.pinWorkJ = world.dragWork();
    check.pinImpulseNs = world.dragImpulse();
    const vec3 impulse(0, 0, -10.0F * asset.profile.totalMassKg / 75.0F);
    const auto hit = walking(asset, {{"upperChest", kHitSeconds, impulse}});
    if (hit) check.recoverySeconds = hit.value()->puppets()->figures().recoverySeconds;
}

void judgeDrops(Checkup& checkup) {
    int kept = 0;
    for (const Measure& measure : kMeasures) {
        float worst = 0;
        for (const Quality& drop : checkup.drops)
            worst = std::max(worst, measure.of(drop));
        checkup.bounds.push_back({measure.name, measure.unit, worst, measure.bound});
        if (worst <= measure.bound) {
            ++kept;
            continue;
        }
        Finding finding;
        finding.severity = Severity::warning;
        finding.code = "measured";
        finding.place = measure.name;
        finding.measure = worst >= kNeverSettled
                              ? fmt::format("a drop never came to rest; {} {} are allowed", measure.bound, measure.unit)
                              : fmt::format("{:.2f} {} in the worst of {} drops; {} are allowed", worst, measure.unit,
                                            checkup.drops.size(), measure.bound);
        finding.mend = measure.mend;
        checkup.diagnosis.findings.push_back(finding);
    }
    const bool finite = std::all_of(checkup.drops.begin(), checkup.drops.end(),
                                    [](const Quality& drop) { return drop.nonFinite == 0; });
    if (!finite) {
        checkup.diagnosis.findings.insert(checkup.diagnosis.findings.begin(),
                                          {Severity::error,
                                           "measured",
                                           "simulation",
                                           "body states that are not finite",
                                           "mend the other findings first, then report the model",
                                           false,
                                           {}});
    }
    const float share = finite ? static_cast<float>(kept) / static_cast<float>(std::size(kMeasures)) : 0.0F;
    checkup.score = kStaticShare * checkup.diagnosis.score + (1.0F - kStaticShare) * 100.0F * share;
}

}  // namespace

Checkup examineFalls(const RagdollAsset& asset, const DropObserver& observe) {
    Checkup checkup;
    checkup.diagnosis = physics::diagnose(asset.profile, asset.character, asset.map);
    checkup.score = kStaticShare * checkup.diagnosis.score;
    if (checkup.diagnosis.hasErrors()) return checkup;
    checkup.drops = dropThrice(asset, observe);
    judgeDrops(checkup);
    return checkup;
}

Checkup examine(const RagdollAsset& asset, const DropObserver& observe) {
    Checkup checkup = examineFalls(asset, observe);
    if (!checkup.bounds.empty()) walk(asset, checkup);  // it has fallen
    return checkup;
}

}  // namespace lutka::scene
