#include "support/catch.hpp"
#include "support/counting_new.hpp"
#include "support/dolls.hpp"
#include "world_table.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::SolverKind;

namespace {

// Dolls in a heap with crates, one held by the hand: contacts of every kind, motors, drags, reports.
std::unique_ptr<physics::World> heap(SolverKind solver, const physics::RagdollProfile& profile) {
    physics::WorldSettings settings;
    settings.sleeping = false;
    settings.contactReports = true;
    auto world = worldOf(solver, settings);
    world->addStatic({});
    world->addStatic(staticBoxAt({0, 0.1F, 0}, {0.6F, 0.1F, 0.6F}));
    for (int i = 0; i < 12; ++i)
        world->addDoll(profile, standingDoll(profile, {0.2F * static_cast<float>(i % 3), 0.4F * static_cast<float>(i),
                                                       0.2F * static_cast<float>(i % 2)}));
    physics::DynamicProp crate;
    crate.shape.kind = physics::BodyShape::Kind::box;
    crate.shape.halfExtents = vec3(0.1F);
    crate.state = stateAt({0, 6, 0});
    world->addProp(crate);
    const int hand = physics::bodyOf(profile, physics::Role::leftHand);
    world->addDrag({world->dolls()[0], hand, vec3(0), {0, 1, 0}, 500.0F});
    physics::JointMotor motor;
    motor.stiffness = 20.0F;
    motor.damping = 2.0F;
    world->setMotor(world->dolls()[1], 0, motor);
    return world;
}

}  // namespace

TEST_CASE("a step allocates nothing once the world has been at work for a while") {
    const physics::RagdollProfile profile = makeDoll();
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const auto world = heap(solver, profile);
        stepSeconds(*world, 8.0F);
        REQUIRE_FALSE(world->contactReports().empty());
        // Growth beyond what the heap has needed so far is room for more contacts, not an allocation a step.
        std::size_t quietSteps = 0;
        std::size_t allocations = 0;
        for (int i = 0; i < 120; ++i) {
            const std::size_t before = allocationCount();
            world->step(kFrame);
            const std::size_t made = allocationCount() - before;
            allocations += made;
            quietSteps += made == 0 ? 1 : 0;
        }
        INFO(allocations << " allocations");
        CHECK(quietSteps >= 118);
    }
}
