#include "scene/measure/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

#include "physics/doctor/doctor.hpp"
#include "scene/measure/puppet_report.hpp"
#include "scene/measure/quality_json.hpp"

namespace lutka::scene {
StepSummary summarise(std::span<const float> stepMs) {
    if (stepMs.empty()) return {};
    std::vector<float> sorted(stepMs.begin(), stepMs.end());
    std::sort(sorted.begin(), sorted.end());
    const auto at = [&](double share) {
        return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
    };
    const float sum = std::accumulate(sorted.begin(), sorted.end(), 0.0F);
    return {sum / static_cast<float>(sorted.size()), at(0.5), at(0.99)};
}

namespace {

std::size_t constraintCount(const Simulation& simulation) {
    std::size_t count = 0;
    for (int doll = 0; doll < simulation.dollCount(); ++doll)
        count += simulation.assetOf(doll).profile.constraints.size();
    return count;
}

// A mixed crowd's characters; "model" and "fit" are the first one's.
nlohmann::ordered_json charactersJson(const Simulation& simulation) {
    auto list = nlohmann::ordered_json::array();
    for (const RagdollAsset* asset : simulation.assets()) {
        int count = 0;
        for (int doll = 0; doll < simulation.dollCount(); ++doll)
            count += &simulation.assetOf(doll) == asset ? 1 : 0;
        list.push_back({{"model", asset->character.file.string()},
                        {"count", count},
                        {"bodies", asset->profile.bodies.size()},
                        {"constraints", asset->profile.constraints.size()},
                        {"fit", fitJson(physics::diagnose(asset->profile, asset->character, asset->map).fit)}});
    }
    return list;
}

// The dolls that were stopped because their motion made no sense, by the scenario's numbers.
nlohmann::ordered_json caughtJson(const Simulation& simulation) {
    auto list = nlohmann::ordered_json::array();
    for (const physics::CaughtDoll& caught : simulation.world().caught()) {
        list.push_back({{"doll", simulation.dollOf(caught.doll)},
                        {"why", physics::textOf(caught.why)},
                        {"seconds", caught.seconds},
                        {"times", caught.times}});
    }
    return list;
}

std::string castText(const Simulation& simulation) {
    if (simulation.assets().size() == 1) {
        return fmt::format("{} × {} bodies", simulation.dollCount(), simulation.asset().profile.bodies.size());
    }
    return fmt::format("{} dolls of {} characters, {} bodies", simulation.dollCount(), simulation.assets().size(),
                       simulation.bodyCount());
}

}  // namespace

std::string reportJson(const Simulation& simulation) {
    const SimulationOptions& options = simulation.options();
    const StepSummary times = summarise(simulation.stepMs());
    const physics::RagdollProfile& profile = simulation.asset().profile;
    nlohmann::ordered_json json;
    json["model"] = simulation.asset().character.file.string();
    json["scene"] = simulation.scenario().name;
    json["solver"] = physics::solverName(options.world.solver);
    json["seed"] = simulation.scenario().seed;
    if (const ClipCast* cast = simulation.clipCast()) {
        const ClipPlay& play = cast->settings();
        json["clip"] = {{"clip", play.start.clip},   {"start", play.start.seconds}, {"length", cast->clipSeconds(0)},
                        {"speed", play.speed},       {"loop", play.loop},           {"inPlace", play.inPlace},
                        {"travel", cast->travelM(0)}};
    } else if (options.fromClip) {
        json["fromClip"] = {{"clip", options.fromClip->clip}, {"seconds", options.fromClip->seconds}};
    } else {
        json["pose"] = options.pose == StartPose::bind ? "bind" : "node";
    }
    // What a solver alters for stability's sake, in words: the profile's own figures stay what they are.
    json["conditioning"] = options.world.solver == physics::SolverKind::stock
                               ? ""
                               : "no body has a radius of gyration below 2.9 % of the figure's height";
    json["count"] = simulation.dollCount();
    json["seconds"] = simulation.seconds();
    json["dt"] = options.dt;
    json["substeps"] = simulation.world().usualSubsteps(options.dt);
    json["threads"] = options.world.threads;
    json["steps"] = simulation.steps();
    json["stateHash"] = fmt::format("{:016x}", simulation.stateHash());
    json["wallMsPerStep"] = {{"mean", times.mean}, {"p50", times.p50}, {"p99", times.p99}};
    json["fit"] = fitJson(physics::diagnose(profile, simulation.asset().character, simulation.asset().map).fit);
    // A meter that followed dolls in and out of worlds would measure the moves.
    json["quality"] = simulation.shedder() == nullptr && simulation.clipCast() == nullptr
                          ? qualityJson(simulation.quality())
                          : nlohmann::ordered_json();
    if (simulation.puppets() != nullptr) json["puppet"] = puppetJson(*simulation.puppets(), simulation.world());
    if (const LoadShedder* shedder = simulation.shedder()) {
        const LoadShedder::Counts counts = shedder->counts();
        json["shed"] = {{"lod", counts.lod},
                        {"apart", counts.apart},
                        {"slow", counts.slow},
                        {"frozen", counts.frozen},
                        {"switches", shedder->switches()}};
    }
    json["caught"] = caughtJson(simulation);
    json["bodies"] = simulation.bodyCount();
    json["constraints"] = constraintCount(simulation);
    if (simulation.assets().size() > 1) json["characters"] = charactersJson(simulation);
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string reportText(const Simulation& simulation) {
    const physics::Quality q = simulation.quality();
    const StepSummary times = summarise(simulation.stepMs());
    std::string text =
        fmt::format("{}, scene {}: {}, {:.1f} s in {} steps\n", simulation.asset().character.name,
                    simulation.scenario().name, castText(simulation), simulation.seconds(), simulation.steps());
    if (const ClipCast* cast = simulation.clipCast()) {
        const ClipPlay& play = cast->settings();
        return text + fmt::format("  clip {} of {:.2f} s at speed {:.2g}{}, {:.2f} m of way; played without physics\n",
                                  play.start.clip, cast->clipSeconds(0), play.speed, play.loop ? ", looped" : "",
                                  cast->travelM(0));
    }
    if (const LoadShedder* shedder = simulation.shedder()) {
        const LoadShedder::Counts counts = shedder->counts();
        text += fmt::format("  spared at the end: {} merged, {} apart, {} slow, {} frozen; quality is not measured\n",
                            counts.lod, counts.apart, counts.slow, counts.frozen);
        return text +
               fmt::format("  time a step        {:7.2f} ms in the median, {:.2f} ms p99\n", times.p50, times.p99);
    }
    text += fmt::format("  joint separation   {:7.2f} mm at most, {:.2f} mm p99\n", q.jointSeparationM.max * 1e3F,
                        q.jointSeparationM.p99 * 1e3F);
    text += fmt::format("  past the limits    {:7.2f} deg at most, {:.2f} deg p99, {:.2f} deg for two frames\n",
                        q.limitViolationDeg.max, q.limitViolationDeg.p99, q.limitViolationDeg.lasting);
    text += fmt::format("  into the ground    {:7.2f} mm, into itself {:.2f} mm\n", q.floorPenetrationM * 1e3F,
                        q.selfPenetrationM * 1e3F);
    if (simulation.dollCount() > 1) {
        text += fmt::format("  into each other    {:7.2f} mm at most, {:.2f} mm p99 of those that touch\n",
                            q.dollPenetrationM.max * 1e3F, q.dollPenetrationM.p99 * 1e3F);
    }
    if (simulation.puppets() != nullptr) text += puppetText(*simulation.puppets(), simulation.world());
    text += fmt::format("  energy growth      {:7.2f} J of {:.0f} J\n", q.energyGrowthJ, q.initialEnergyJ);
    text += q.settleSeconds ? fmt::format("  at rest            {:7.2f} s after the first contact\n", *q.settleSeconds)
                            : fmt::format("  not at rest        {:8.3f} m/s at the end\n", q.residualSpeedMps);
    text += fmt::format("  time a step        {:7.2f} ms in the median, {:.2f} ms p99\n", times.p50, times.p99);
    for (const physics::CaughtDoll& caught : simulation.world().caught())
        text += fmt::format("  CAUGHT             doll {} at {:.2f} s: {}; put back and to sleep\n",
                            simulation.dollOf(caught.doll), caught.seconds, physics::textOf(caught.why));
    if (q.nonFinite > 0) text += fmt::format("  NOT FINITE         {:7} body states\n", q.nonFinite);
    return text;
}

}  // namespace lutka::scene
