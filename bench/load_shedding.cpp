// load_shedding MODEL [COUNT] [SOLVER]: what each measure of scene::LoadShedder saves, as CSV: COUNT dolls fall onto
// their own patches of a floor and the eye stands at a corner. All variants are stepped in turn, ten steps at a time,
// so that a noisy machine treats them alike; `share` is the median over the blocks of a variant's time over the time of
// the same dolls with nothing spared. Sleeping is off.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "scene/asset/ragdoll_asset.hpp"
#include "scene/description/scenario.hpp"
#include "scene/run/load_shedding.hpp"
#include "scene/run/make_world.hpp"
#include "timing.hpp"

namespace {

using namespace lutka;

constexpr float kDt = 1.0F / 60.0F;
constexpr int kSteps = 180;
constexpr int kBlock = 10;

struct Variant {
    std::string name;
    std::unique_ptr<physics::World> world;
    std::unique_ptr<scene::LoadShedder> shedder;
    std::vector<double> blockMs;
};

Variant makeVariant(const std::string& name, const scene::ShedSettings& settings, const scene::RagdollAsset& asset,
                    const scene::Scenario& scenario, physics::SolverKind solver) {
    physics::WorldSettings options;
    options.solver = solver;
    options.sleeping = false;
    Variant variant{name, nullptr, nullptr, {}};
    variant.world = scene::makeWorld(options);
    for (const physics::StaticShape& shape : scenario.statics)
        variant.world->addStatic(shape);
    std::vector<physics::BodyState> bodies(asset.profile.bodies.size());
    for (const scene::Placement& placement : scenario.dolls) {
        physics::bodiesFromPose(asset.rig, asset.character.skeleton.bindModelFromJoint, placement.worldFromModel,
                                bodies);
        variant.world->addDoll(asset.profile, bodies);
    }
    const std::vector<scene::LoadShedder::Kind> kinds(scenario.dolls.size(), {&asset.profile, &asset.rig});
    variant.shedder = std::make_unique<scene::LoadShedder>(kinds, *variant.world, scenario.statics, options, settings);
    return variant;
}

// Distances such that about half of the dolls lie beyond the eye's.
std::vector<std::pair<std::string, scene::ShedSettings>> variantsFor(float half) {
    const std::string at = fmt::format("@{:.1f}", half);
    std::vector<std::pair<std::string, scene::ShedSettings>> out;
    for (const std::string& list :
         {std::string(), "lod" + at, "lod7" + at, "apart" + at, "slow" + at, "slow4" + at, "frozen" + at,
          fmt::format("lod@{:.1f},slow@{:.1f},frozen@{:.1f}", half * 0.5F, half, half * 1.3F)})
        out.emplace_back(list.empty() ? "nothing" : list, scene::parseShedSettings(list).value());
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2 || argc > 4) {
        fmt::print(stderr, "usage: load_shedding MODEL [COUNT] [bullet|crowd]\n");
        return 2;
    }
    const int count = argc > 2 ? std::atoi(argv[2]) : 200;
    const bool bullet = argc > 3 && std::string(argv[3]) == "bullet";
    scene::LoadOptions load;
    load.import.loadTextures = false;
    const auto asset = scene::loadRagdoll(argv[1], load);
    if (!asset) {
        fmt::print(stderr, "{}\n", asset.error().text());
        return 3;
    }
    const auto scenario = scene::makeScenario({.name = "spread", .count = count, .seed = 1}, *asset.value());
    if (!scenario) {
        fmt::print(stderr, "{}\n", scenario.error().text());
        return 2;
    }
    vec3 eye = scenario.value().dolls.front().worldFromModel.translation;
    for (const scene::Placement& doll : scenario.value().dolls)
        eye = glm::min(eye, doll.worldFromModel.translation);
    std::vector<double> distances;
    for (const scene::Placement& doll : scenario.value().dolls)
        distances.push_back(static_cast<double>(glm::distance(doll.worldFromModel.translation, eye)));
    std::vector<Variant> variants;
    for (const auto& [name, settings] : variantsFor(static_cast<float>(medianOf(distances))))
        variants.push_back(makeVariant(name, settings, *asset.value(), scenario.value(),
                                       bullet ? physics::SolverKind::bullet : physics::SolverKind::crowd));
    for (int done = 0; done < kSteps; done += kBlock) {
        for (Variant& variant : variants) {
            const auto before = std::chrono::steady_clock::now();
            for (int step = 0; step < kBlock; ++step)
                variant.shedder->step(kDt, eye);
            variant.blockMs.push_back(
                std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - before).count() / kBlock);
        }
    }
    fmt::print("spared,dolls,ms_per_step,share,lod,apart,slow,frozen\n");
    for (const Variant& variant : variants) {
        std::vector<double> shares;
        for (std::size_t block = 0; block < variant.blockMs.size(); ++block)
            shares.push_back(variant.blockMs[block] / variants[0].blockMs[block]);
        const auto counts = variant.shedder->counts();
        fmt::print("\"{}\",{},{:.3f},{:.2f},{},{},{},{}\n", variant.name, count, medianOf(variant.blockMs),
                   medianOf(shares), counts.lod, counts.apart, counts.slow, counts.frozen);
    }
    return 0;
}
