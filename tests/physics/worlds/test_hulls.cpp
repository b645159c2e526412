#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "physics/collision/shape.hpp"
#include "physics/collision/static_distance.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"
#include "world_table.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::SolverKind;

namespace {

const vec3 kHalf(0.3F, 0.15F, 0.2F);

// A box by its corners.
physics::RagdollProfile hullCrate() {
    physics::RagdollProfile profile = crateProfile(kHalf);
    physics::BodyShape& shape = profile.bodies[0].shape;
    shape.hull = physics::hullWithin(shape);
    shape.kind = physics::BodyShape::Kind::hull;
    return profile;
}

// The doll of the tests with hulls within its capsules.
physics::RagdollProfile hullDoll() {
    physics::RagdollProfile profile = makeDoll();
    for (physics::BodyProfile& body : profile.bodies) {
        body.shape.hull = physics::hullWithin(body.shape);
        body.shape.kind = physics::BodyShape::Kind::hull;
    }
    return profile;
}

std::vector<physics::BodyState> alone(const physics::BodyState& state) {
    return {state};
}

physics::BodyState bodyOf(const physics::World& world, physics::DollId doll) {
    std::vector<physics::BodyState> bodies(1);
    world.getBodies(doll, bodies);
    return bodies[0];
}

}  // namespace

TEST_CASE("a hull comes to rest on planes, boxes, balls and other hulls as a box does") {
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const physics::RagdollProfile crate = hullCrate();
        const auto world = worldOf(solver, {});
        CHECK(world->addStatic({}).isSet());
        CHECK(world->addStatic(staticBoxAt({3, 0.25F, 0}, {1, 0.25F, 1})).isSet());
        const auto onPlane = world->addDoll(crate, alone(stateAt({0, 0.4F, 0})));
        const auto onBox = world->addDoll(crate, alone(stateAt({3, 0.9F, 0})));
        const auto above = world->addDoll(crate, alone(stateAt({0, 0.9F, 0}, glm::angleAxis(0.7F, vec3(0, 1, 0)))));
        stepSeconds(*world, 3.0F);
        CHECK(bodyOf(*world, onPlane).worldFromBody.translation.y == Approx(0.15F).margin(0.006));
        CHECK(bodyOf(*world, onBox).worldFromBody.translation.y == Approx(0.65F).margin(0.006));
        CHECK(bodyOf(*world, above).worldFromBody.translation.y == Approx(0.45F).margin(0.01));
    }
}

TEST_CASE("a hull that falls across a beam stays on it") {
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        const physics::RagdollProfile crate = hullCrate();
        const auto world = worldOf(solver, {});
        CHECK(world->addStatic(staticBoxAt({0, 0.5F, 0}, {0.05F, 0.5F, 2})).isSet());
        const auto doll = world->addDoll(crate, alone(stateAt({0, 1.4F, 0})));
        stepSeconds(*world, 3.0F);
        CHECK(bodyOf(*world, doll).worldFromBody.translation.y == Approx(1.15F).margin(0.006));
    }
}

TEST_CASE("rays find the sides of a hull") {
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const physics::RagdollProfile crate = hullCrate();
        const auto world = worldOf(solver, {});
        const auto doll = world->addDoll(crate, alone(stateAt({0, 5, 0})));
        const auto hit = world->rayTest({0.1F, 8, 0.1F}, {0.1F, 0, 0.1F});
        REQUIRE(hit);
        CHECK(hit->doll == doll);
        CHECK(hit->position.y == Approx(5.15F).margin(0.005));
        CHECK(hit->normal.y > 0.99F);
        CHECK_FALSE(world->rayTest({0.4F, 8, 0.1F}, {0.4F, 0, 0.1F}));
    }
}

TEST_CASE("a doll of hulls falls as gently as one of capsules") {
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        const physics::RagdollProfile profile = hullDoll();
        const auto world = worldOf(solver, {});
        std::vector<physics::StaticShape> statics{{}, staticBoxAt({0, 0.2F, 1.2F}, {1, 0.2F, 0.5F})};
        for (const physics::StaticShape& shape : statics)
            CHECK(world->addStatic(shape).isSet());
        CHECK(world->addDoll(profile, standingDoll(profile, {0, 0.6F, 0.4F}, glm::angleAxis(0.2F, vec3(1, 0, 0))))
                  .isSet());
        const physics::Quality quality = measureSeconds(*world, statics, 5.0F);
        CHECK(quality.jointSeparationM.max < 0.012F);
        CHECK(quality.floorPenetrationM < 0.03F);
        CHECK(quality.selfPenetrationM < 0.06F);
        CHECK(quality.energyGrowthJ < 0.01F * quality.initialEnergyJ);
        CHECK(quality.nonFinite == 0);
    }
}

TEST_CASE("static geometry is no hull") {
    const auto world = worldOf(SolverKind::crowd, {});
    physics::StaticShape shape;
    shape.kind = ShapeKind::hull;
    CHECK_FALSE(world->addStatic(shape).isSet());
}
