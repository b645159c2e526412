// Bodies of several shapes in all three worlds.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "physics/collision/shape.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"
#include "world_table.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::AddedShape;
using physics::BodyState;
using physics::PrimitiveShape;
using physics::RagdollProfile;
using physics::SolverKind;
using physics::StaticShape;

namespace {

constexpr float kBall = 0.1F;
constexpr float kApart = 0.8F;

AddedShape ballAt(const vec3& centre) {
    AddedShape added;
    added.kind = PrimitiveShape::Kind::sphere;
    added.radius = kBall;
    added.bodyFromShape.translation = centre;
    return added;
}

// Three balls in a row along x, the main one in the middle.
RagdollProfile rowOfBalls() {
    RagdollProfile profile = rodProfile(0.0F, kBall);
    physics::BodyProfile& body = profile.bodies[0];
    body.shape.kind = PrimitiveShape::Kind::sphere;
    body.shape.more = {ballAt({kApart, 0, 0}), ballAt({-kApart, 0, 0})};
    body.inertia = physics::shapeInertia(body.shape, body.massKg);
    return profile;
}

// A ball over the middle of a crossbar: a capsule that lies along z, to the side of the body's own axes.
RagdollProfile ballWithBar() {
    RagdollProfile profile = rodProfile(0.0F, kBall);
    physics::BodyProfile& body = profile.bodies[0];
    AddedShape bar;
    bar.radius = 0.05F;
    bar.halfLength = 0.5F;
    bar.bodyFromShape = {glm::angleAxis(0.5F * kPi, vec3(1, 0, 0)), vec3(0, -0.3F, 0)};
    body.shape.more = {bar};
    body.inertia = physics::shapeInertia(body.shape, body.massKg);
    return profile;
}

StaticShape flatGround() {
    StaticShape floor;
    floor.kind = StaticShape::Kind::plane;
    return floor;
}

// Floors of every kind whose upper side is y = 0.
std::vector<StaticShape> grounds() {
    return {flatGround(), staticBoxAt({0, -0.5F, 0}, {5, 0.5F, 5}), staticMesh(gridMesh(8, 10.0F))};
}

}  // namespace

TEST_CASE("a body of several shapes rests on all of them, on every kind of floor") {
    const RagdollProfile row = rowOfBalls();
    for (const SolverKind solver : kAllSolvers) {
        for (const StaticShape& floor : grounds()) {
            INFO(physics::solverName(solver) << ", floor " << static_cast<int>(floor.kind));
            const auto world = worldOf(solver);
            world->addStatic(floor);
            // Dropped on one end.
            const quat tilted = glm::angleAxis(0.35F, vec3(0, 0, 1));
            world->addDoll(row, std::vector<BodyState>{stateAt({0, 0.6F, 0}, tilted)});
            stepSeconds(*world, 4.0F);
            const BodyState body = bodyOfDoll(*world, 0);
            for (const float x : {-kApart, 0.0F, kApart})
                CHECK((body.worldFromBody * vec3(x, 0, 0)).y == Approx(kBall).margin(0.012));
        }
    }
}

TEST_CASE("a body stands on the shape below its main one") {
    const RagdollProfile profile = ballWithBar();
    for (const SolverKind solver : kAllSolvers) {
        for (const StaticShape& floor : grounds()) {
            INFO(physics::solverName(solver) << ", floor " << static_cast<int>(floor.kind));
            const auto world = worldOf(solver);
            world->addStatic(floor);
            world->addDoll(profile, std::vector<BodyState>{stateAt({0, 0.36F, 0})});
            stepSeconds(*world, 0.3F);
            // The bar's underside lies 0.35 m below the origin; it tips over its length only slowly.
            CHECK(bodyOfDoll(*world, 0).worldFromBody.translation.y == Approx(0.35F).margin(0.03));
        }
    }
}

TEST_CASE("a ray meets each shape of a body and names the body") {
    const RagdollProfile row = rowOfBalls();
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver);
        const physics::DollId doll = world->addDoll(row, std::vector<BodyState>{stateAt({0, 1, 0})});
        for (const float x : {-kApart, 0.0F, kApart}) {
            CAPTURE(x);
            const auto hit = world->rayTest({x, 3, 0}, {x, 0, 0});
            REQUIRE(hit);
            CHECK(hit->doll == doll);
            CHECK(hit->body == 0);
            CHECK(hit->position.y == Approx(1.0F + kBall).margin(1e-3));
            CHECK(hit->normal.y == Approx(1.0F).margin(1e-3));
        }
        CHECK_FALSE(world->rayTest({0.5F * kApart, 3, 0}, {0.5F * kApart, 0, 0}));
        // Asleep or awake.
        stepSeconds(*world, 0.1F);
        const float y = bodyOfDoll(*world, 0).worldFromBody.translation.y;
        CHECK(world->rayTest({kApart, 3, 0}, {kApart, 0, 0})->position.y == Approx(y + kBall).margin(1e-3));
    }
}

TEST_CASE("shapes of two bodies push each other, whichever they are") {
    const RagdollProfile row = rowOfBalls();
    const RagdollProfile ball = rodProfile(0.0F, kBall);
    const RagdollProfile bar = ballWithBar();
    physics::WorldSettings settings;
    settings.gravity = vec3(0);
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        {  // A plain ball against the end of the row.
            const auto world = worldOf(solver, settings);
            world->addDoll(row, std::vector<BodyState>{stateAt({0, 0, 0})});
            world->addDoll(ball, std::vector<BodyState>{stateAt({kApart, 0, -1}, quat(1, 0, 0, 0), {0, 0, 2})});
            stepSeconds(*world, 1.0F);
            const BodyState pushed = bodyOfDoll(*world, 0);
            CHECK(pushed.linearVelocity.z > 0.1F);
            CHECK(pushed.angularVelocity.y < -0.1F);  // hit at +x towards +z
            CHECK(bodyOfDoll(*world, 1).linearVelocity.z < 1.8F);
        }
        {  // The row's end against the other's crossbar.
            const auto world = worldOf(solver, settings);
            world->addDoll(row, std::vector<BodyState>{stateAt({0, 0, 0})});
            world->addDoll(bar,
                           std::vector<BodyState>{stateAt({kApart, 0.3F + 0.5F, 0.1F}, quat(1, 0, 0, 0), {0, -2, 0})});
            stepSeconds(*world, 1.0F);
            CHECK(bodyOfDoll(*world, 0).linearVelocity.y < -0.1F);
            CHECK(bodyOfDoll(*world, 1).linearVelocity.y > -1.9F);
        }
    }
}

TEST_CASE("the contact reports of a body of several shapes add up to its weight") {
    const RagdollProfile row = rowOfBalls();
    physics::WorldSettings settings;
    settings.contactReports = true;
    settings.sleeping = false;
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver, settings);
        world->addStatic(flatGround());
        world->addDoll(row, std::vector<BodyState>{stateAt({0, kBall + 0.01F, 0})});
        stepSeconds(*world, 2.0F);
        float impulse = 0.0F;
        std::vector<float> places;
        for (const physics::ContactReport& report : world->contactReports()) {
            CHECK(report.position.y == Approx(0.0F).margin(0.01));
            impulse += report.impulse;
            places.push_back(report.position.x);
        }
        CHECK(impulse == Approx(row.bodies[0].massKg * 9.81F * kFrame).epsilon(0.05));
        REQUIRE_FALSE(places.empty());
        CHECK(*std::min_element(places.begin(), places.end()) < -0.7F);
        CHECK(*std::max_element(places.begin(), places.end()) > 0.7F);
    }
}

TEST_CASE("a sleeping body of several shapes wakes when one of them is hit") {
    const RagdollProfile row = rowOfBalls();
    const RagdollProfile ball = rodProfile(0.0F, kBall);
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver);
        world->addStatic(flatGround());
        world->addDoll(row, std::vector<BodyState>{stateAt({0, kBall, 0})});
        stepSeconds(*world, 5.0F);
        REQUIRE(world->isAsleep(world->dolls()[0]));
        world->addDoll(ball, std::vector<BodyState>{stateAt({kApart, kBall, -1}, quat(1, 0, 0, 0), {0, 0, 4})});
        stepSeconds(*world, 1.0F);
        CHECK(std::abs(bodyOfDoll(*world, 0).worldFromBody.rotation.y) > 0.02F);
    }
}

TEST_CASE("a doll whose trunk has several shapes falls like one and keeps its bounds") {
    RagdollProfile profile = makeDoll();
    physics::BodyProfile& chest = profile.bodies[2];
    AddedShape belly = ballAt({0, 0, 0.08F});
    chest.shape.more = {belly};
    chest.inertia = physics::shapeInertia(chest.shape, chest.massKg);
    const std::vector<StaticShape> statics{flatGround()};
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver);
        world->addStatic(statics[0]);
        for (int i = 0; i < 3; ++i)
            world->addDoll(profile, standingDoll(profile, {0.3F * static_cast<float>(i), 0.5F, 0},
                                                 glm::angleAxis(0.9F * static_cast<float>(i), vec3(0, 1, 0))));
        const physics::Quality quality = measureSeconds(*world, statics, 5.0F);
        CHECK(quality.nonFinite == 0);
        CHECK(quality.jointSeparationM.p99 < 0.005F);
        CHECK(quality.floorPenetrationM < 0.02F);
        CHECK(quality.energyGrowthJ < 0.03F * quality.initialEnergyJ);
    }
}
