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
                                               bool limp = false, int count = 1) {
    auto scenario = scene::makeScenario({.name = name, .count = count, .seed = seed}, standingMannequin());
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
        CHECK(simulation->quality().floorPenetrationM < 0.005F);
        simulation->reset();
        CHECK(simulation->worldFromModel(0).translation == first.translation);
        CHECK(simulation->worldFromModel(0).rotation == first.rotation);
    }
}

TEST_CASE("on a slope no foot begins in the ground, whatever way it heads") {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        INFO("seed " << seed);
        const auto simulation = withMuscles("ramp", seed, SolverKind::crowd);
        simulation->step();
        CHECK(simulation->quality().floorPenetrationM < 0.005F);
    }
}

TEST_CASE("dolls that are placed above each other do not begin in each other, nor after a reset") {
    const auto simulation = withMuscles("pile", 0, SolverKind::crowd, false, 32);
    std::vector<RigidTransform> first;
    for (int doll = 0; doll < simulation->dollCount(); ++doll)
        first.push_back(simulation->worldFromModel(doll));
    for (int step = 0; step < 30; ++step)
        simulation->step();
    CHECK(simulation->quality().dollPenetrationM.max < 0.01F);
    simulation->reset();
    for (int doll = 0; doll < simulation->dollCount(); ++doll)
        CHECK(simulation->worldFromModel(doll).translation == first[static_cast<std::size_t>(doll)].translation);
}

TEST_CASE("arms that only the bind pose spreads keep nobody from standing beside others") {
    auto scenario = scene::makeScenario({.name = "pile", .count = 8}, standingMannequin());
    REQUIRE(scenario);
    scene::SimulationOptions options;
    options.puppet.emplace().start.clip = "idle";
    options.puppet->borrows = true;
    const auto made = scene::Simulation::create(standingMannequin(), std::move(scenario).value(), options);
    REQUIRE(made);
    for (int doll = 0; doll < 8; ++doll) {
        INFO("doll " << doll);
        CHECK((made.value()->worldFromModel(doll).rotation * vec3(0, 1, 0)).y > 0.999F);
    }
}

TEST_CASE("who is placed on a crate, or above one, is not put into it or below") {
    const auto& asset = standingMannequin();
    for (const float crateTop : {0.4F, 0.9F}) {
        INFO("top at " << crateTop);
        auto scenario = scene::makeScenario({.name = "drop"}, asset);
        REQUIRE(scenario);
        RigidTransform& placed = scenario.value().dolls[0].worldFromModel;
        physics::DynamicProp crate;
        crate.shape.kind = physics::BodyShape::Kind::box;
        crate.shape.halfExtents = vec3(0.4F, 0.2F, 0.4F);
        crate.massKg = 40.0F;
        crate.state.worldFromBody.translation = {placed.translation.x, crateTop - 0.2F, placed.translation.z};
        scenario.value().props.push_back(crate);
        placed.translation.y = crateTop - scene::standingFloorOf(asset) + 0.05F;
        const vec3 before = placed.translation;
        scene::SimulationOptions options;
        options.puppet.emplace().start.clip = "idle";
        const auto made = scene::Simulation::create(asset, std::move(scenario).value(), options);
        REQUIRE(made);
        CHECK(made.value()->worldFromModel(0).translation == before);
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
