#include "scene/run/solver_defaults.hpp"

#include "scene/run/simulation.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;

namespace {

// The bodies of a doll after half a second in the scene `drop`.
std::vector<physics::BodyState> fallen(const physics::WorldSettings& world) {
    const auto asset = scene::makeRagdoll(test::makeBiped());
    REQUIRE(asset.ok());
    auto scenario = scene::makeScenario({}, *asset.value());
    REQUIRE(scenario.ok());
    scene::SimulationOptions options;
    options.world = world;
    auto simulation = scene::Simulation::create(*asset.value(), std::move(scenario).value(), options);
    REQUIRE(simulation.ok());
    for (int step = 0; step < 30; ++step)
        simulation.value()->step();
    std::vector<physics::BodyState> bodies(asset.value()->profile.bodies.size());
    simulation.value()->getBodies(0, bodies);
    return bodies;
}

}  // namespace

TEST_CASE("a solver that is told its own values falls as it does by itself") {
    for (const auto solver : {physics::SolverKind::bullet, physics::SolverKind::crowd}) {
        physics::WorldSettings plain;
        plain.solver = solver;
        physics::WorldSettings told = plain;
        const scene::SolverDefaults own = scene::solverDefaults(solver);
        told.substeps = own.substeps;
        told.iterations = own.iterations;
        told.linearDamping = own.linearDamping;
        told.angularDamping = own.angularDamping;
        const auto a = fallen(plain);
        const auto b = fallen(told);
        for (std::size_t i = 0; i < a.size(); ++i) {
            CHECK(glm::distance(a[i].worldFromBody.translation, b[i].worldFromBody.translation) < 1e-4F);
        }
    }
}
