#include "scene/puppet/stand_on_ground.hpp"

#include <algorithm>

#include "scene/puppet/floor_keeper.hpp"
#include "scene/run/simulation.hpp"
#include "support/catch.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using physics::Role;
using physics::SolverKind;

namespace {

const scene::RagdollAsset& standingMannequin() {
    static const auto asset = scene::loadRagdoll(std::filesystem::path(LUTKA_ASSETS_DIR) / "models/mannequin.glb");
    REQUIRE(asset);
    return *asset.value();
}

std::unique_ptr<scene::Simulation> withMuscles(std::string_view name, std::uint64_t seed, SolverKind solver,
                                               bool limp = false) {
    auto scenario = scene::makeScenario({.name = name, .seed = seed}, standingMannequin());
    REQUIRE(scenario);
    scene::SimulationOptions options;
    options.world.solver = solver;
    options.puppet.emplace().start.clip = "idle";
    options.puppet->limp = limp;
    auto made = scene::Simulation::create(standingMannequin(), std::move(scenario).value(), options);
    REQUIRE(made);
    return std::move(made).value();
}

float lowestFoot(scene::Simulation& simulation) {
    const auto bodies = simulation.worldFromBody(0);
    const physics::RagdollProfile& profile = standingMannequin().profile;
    return std::min(bodies[static_cast<std::size_t>(physics::bodyOf(profile, Role::leftFoot))].translation.y,
                    bodies[static_cast<std::size_t>(physics::bodyOf(profile, Role::rightFoot))].translation.y);
}

}  // namespace

TEST_CASE("who has muscles from the start stands on the floor, whatever the scene would drop or throw it from") {
    for (const SolverKind solver : {SolverKind::crowd, SolverKind::bullet}) {
        for (const char* name : {"drop", "spread", "pile", "throw", "balls"}) {
            for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{5}}) {
                INFO(name << ", seed " << seed << ", " << physics::solverName(solver));
                const auto simulation = withMuscles(name, seed, solver);
                CHECK(lowestFoot(*simulation) < 0.12F);
                for (int step = 0; step < 30; ++step)
                    simulation->step();
                CHECK(simulation->puppets()->puppet(0).state() != physics::PuppetState::limp);
                CHECK(lowestFoot(*simulation) < 0.12F);
                CHECK(lowestFoot(*simulation) > 0.02F);
            }
        }
    }
}

TEST_CASE("on stairs and ramps it stands where it was above, and again after a reset") {
    for (const char* name : {"stairs", "ramp"}) {
        INFO(name);
        const auto simulation = withMuscles(name, 3, SolverKind::crowd);
        const RigidTransform first = simulation->worldFromModel(0);
        CHECK((first.rotation * vec3(0, 1, 0)).y > 0.999F);
        CHECK(lowestFoot(*simulation) > 1.0F);  // up there
        simulation->step();
        simulation->reset();
        CHECK(simulation->worldFromModel(0).translation == first.translation);
        CHECK(simulation->worldFromModel(0).rotation == first.rotation);
    }
}

TEST_CASE("who begins limp falls, who is held hangs, and who stands or has no ground below stays as it is") {
    const auto& asset = standingMannequin();
    const float dropped = scene::makeScenario({.name = "drop"}, asset).value().dolls[0].worldFromModel.translation.y;
    CHECK(withMuscles("drop", 0, SolverKind::crowd, true)->worldFromModel(0).translation.y == dropped);
    for (const char* name : {"hang", "walk", "push", "march"}) {
        INFO(name);
        const auto scenario = scene::makeScenario({.name = name}, asset);
        const RigidTransform placed = scenario.value().dolls[0].worldFromModel;
        const auto simulation = withMuscles(name, 0, SolverKind::crowd);
        CHECK(simulation->worldFromModel(0).translation == placed.translation);
        CHECK(simulation->worldFromModel(0).rotation == placed.rotation);
    }
    scene::Scenario space;
    space.dolls.emplace_back().worldFromModel.translation = {0, 4, 0};
    scene::SimulationOptions options;
    options.puppet.emplace();
    const auto floating = scene::Simulation::create(asset, space, options);
    REQUIRE(floating);
    CHECK(floating.value()->worldFromModel(0).translation.y == 4.0F);
}
