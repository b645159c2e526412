#include <glm/geometric.hpp>

#include "support/catch.hpp"
#include "support/dolls.hpp"
#include "world_table.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::BodyState;
using physics::CollisionFilter;
using physics::SolverKind;
using physics::StaticShape;

namespace {

StaticShape round(StaticShape::Kind kind, float radius, float halfLength, const vec3& centre,
                  const quat& turn = quat(1, 0, 0, 0)) {
    StaticShape shape;
    shape.kind = kind;
    shape.radius = radius;
    shape.halfLength = halfLength;
    shape.worldFromShape = {turn, centre};
    return shape;
}

float hills(float x, float z) {
    return 0.25F * std::sin(1.3F * x) * std::cos(1.1F * z);
}

// A pit of a mesh that faces up, with a rim: what is thrown in stays in.
float bowl(float x, float z) {
    return 0.15F * (x * x + z * z);
}

const quat kCapsuleAlongX = glm::angleAxis(0.5F * kPi, vec3(0, 0, 1));  // the capsule's axis along x

}  // namespace

TEST_CASE("a rod comes to rest on every kind of static geometry, in every world") {
    const auto rod = rodProfile(0.2F, 0.08F);
    struct Case {
        const char* name;
        StaticShape shape;
        float height;  // of the rod's centre at rest
    };
    const Case cases[] = {
        {"plane", StaticShape{}, 0.08F},
        {"box", staticBoxAt({0, -0.5F, 0}, {2, 0.5F, 2}), 0.08F},
        {"capsule",
         round(StaticShape::Kind::capsule, 0.4F, 3.0F, {0, -0.4F, 0}, glm::angleAxis(0.5F * kPi, vec3(1, 0, 0))),
         0.08F},
        {"sphere", round(StaticShape::Kind::sphere, 50.0F, 0, {0, -50.0F, 0}), 0.08F},
        {"flat mesh", staticMesh(gridMesh(16, 6.0F)), 0.08F},
        {"box mesh", staticMesh(boxMesh({2, 0.5F, 2}), {0, -0.5F, 0}), 0.08F},
    };
    for (const SolverKind solver : kAllSolvers) {
        for (const Case& c : cases) {
            INFO(physics::solverName(solver) << " on " << c.name);
            const auto world = worldOf(solver);
            world->addStatic(c.shape);
            world->addDoll(rod, std::vector<BodyState>{stateAt({0, 0.25F, 0}, kCapsuleAlongX)});
            stepSeconds(*world, 3.0F);
            const BodyState rest = bodyOfDoll(*world, 0);
            CHECK(rest.worldFromBody.translation.y == Approx(c.height).margin(0.003));
            // Stock's own contacts on meshes make it creep.
            CHECK(std::abs(rest.worldFromBody.translation.z) < (solver == SolverKind::stock ? 0.05F : 0.01F));
            CHECK(glm::length(rest.linearVelocity) < (solver == SolverKind::stock ? 0.05F : 0.01F));
        }
    }
}

TEST_CASE("a doll that falls on a mesh keeps the bounds of one that falls on a plane") {
    const physics::RagdollProfile profile = makeDoll();
    for (const SolverKind solver : kOurSolvers) {
        const std::pair<const char*, StaticShape> floors[] = {
            {"flat", staticMesh(gridMesh(24, 8.0F))},
            {"hills", staticMesh(gridMesh(32, 8.0F, hills))},
            {"bowl", staticMesh(gridMesh(32, 8.0F, bowl))},
            {"closed box", staticMesh(boxMesh({4, 0.5F, 4}), {0, -0.5F, 0})}};
        for (const auto& [name, floor] : floors) {
            INFO(physics::solverName(solver) << " on " << name);
            const std::vector<StaticShape> statics{floor};
            const auto world = worldOf(solver);
            world->addStatic(floor);
            world->addDoll(profile, standingDoll(profile, {0.1F, 0.8F, 0.2F}, glm::angleAxis(0.4F, vec3(1, 0, 0))));
            const physics::Quality quality = measureSeconds(*world, statics, 5.0F);
            CHECK(quality.nonFinite == 0);
            CHECK(quality.jointSeparationM.max < 0.010F);
            CHECK(quality.floorPenetrationM < 0.012F);
            CHECK(quality.energyGrowthJ < 0.03F * quality.initialEnergyJ);
            CHECK(quality.residualSpeedMps < 0.05F);
        }
    }
}

TEST_CASE("a capsule slides over a flat mesh as over a plane, without bumps at the edges") {
    const auto rod = rodProfile(0.2F, 0.08F);
    for (const SolverKind solver : kOurSolvers) {
        vec3 ends[2];
        for (const bool mesh : {false, true}) {
            INFO(physics::solverName(solver) << (mesh ? " mesh" : " plane"));
            const auto world = worldOf(solver);
            StaticShape floor = mesh ? staticMesh(gridMesh(60, 12.0F)) : StaticShape{};
            floor.friction = 0.1F;
            world->addStatic(floor);
            const vec3 start(-4.0F, 0.08F, 0.013F);
            world->addDoll(rod, std::vector<BodyState>{stateAt(start, kCapsuleAlongX, {3, 0, 0.7F})});
            float lift = 0;
            float highest = 0;
            for (int i = 0; i < 60; ++i) {
                world->step(kFrame);
                const BodyState now = bodyOfDoll(*world, 0);
                lift = std::max(lift, std::abs(now.linearVelocity.y));
                highest = std::max(highest, std::abs(now.worldFromBody.translation.y - 0.08F));
            }
            CHECK(lift < 0.05F);
            CHECK(highest < 0.003F);
            ends[mesh ? 1 : 0] = bodyOfDoll(*world, 0).worldFromBody.translation;
        }
        CHECK(ends[0].x > -2.5F);
        CHECK(glm::distance(ends[0], ends[1]) < 0.15F);
    }
}

TEST_CASE("a wall of a mesh stops a doll at eight metres a second") {
    const physics::RagdollProfile profile = makeDoll();
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        const std::vector<StaticShape> statics{StaticShape{}, staticMesh(boxMesh({3, 1.5F, 0.025F}), {0, 1.5F, 2})};
        const auto world = worldOf(solver);
        for (const StaticShape& shape : statics)
            world->addStatic(shape);
        world->addDoll(profile,
                       standingDoll(profile, {0, 0.3F, -0.3F}, glm::angleAxis(1.2F, vec3(1, 0, 0)), {0, 0, 8}));
        const physics::Quality quality = measureSeconds(*world, statics, 2.0F);
        CHECK(quality.floorPenetrationM < 0.014F);
        for (const BodyState& body : bodiesOfDoll(*world, 0))
            CHECK(body.worldFromBody.translation.z < 2.0F);
    }
}

TEST_CASE("crates rest on meshes and on round geometry") {
    const auto crate = crateProfile({0.2F, 0.1F, 0.15F});
    for (const SolverKind solver : kAllSolvers) {
        const StaticShape floors[] = {staticMesh(gridMesh(10, 6.0F)), staticMesh(boxMesh({2, 0.5F, 2}), {0, -0.5F, 0}),
                                      round(StaticShape::Kind::sphere, 80.0F, 0, {0, -80, 0})};
        for (const StaticShape& floor : floors) {
            INFO(physics::solverName(solver) << ", kind " << static_cast<int>(floor.kind));
            const auto world = worldOf(solver);
            world->addStatic(floor);
            world->addDoll(crate, std::vector<BodyState>{stateAt({0.03F, 0.2F, 0.07F})});
            stepSeconds(*world, 2.0F);
            // A contact of Bullet's on a mesh keeps the mesh's margin of 4 cm.
            CHECK(bodyOfDoll(*world, 0).worldFromBody.translation.y == Approx(0.1F).margin(0.045));
            CHECK(glm::length(bodyOfDoll(*world, 0).linearVelocity) < 0.02F);
        }
    }
}

TEST_CASE("crates tip over edges of meshes without sinking into them") {
    const auto crate = crateProfile({0.2F, 0.1F, 0.6F});
    const StaticShape table = staticMesh(boxMesh({1, 0.5F, 1}), {0, -0.5F, 0});
    StaticShape roof = staticMesh(boxMesh({3, 0.7F, 0.7F}), {0, -0.99F, 0});
    roof.worldFromShape.rotation = glm::angleAxis(0.25F * kPi, vec3(1, 0, 0));
    StaticShape floor;
    floor.worldFromShape.translation.y = -1.0F;
    const std::pair<StaticShape, vec3> cases[] = {
        {table, {0, 0.12F, 1.15F}}, {table, {1.05F, 0.12F, 0.6F}}, {roof, {0, 0.12F, 0.02F}}};
    for (const SolverKind solver : kOurSolvers) {
        for (const auto& [geometry, start] : cases) {
            INFO(physics::solverName(solver) << " at z = " << start.z);
            const std::vector<StaticShape> statics{floor, geometry};
            const auto world = worldOf(solver);
            for (const StaticShape& shape : statics)
                world->addStatic(shape);
            world->addDoll(crate, std::vector<BodyState>{stateAt(start)});
            const physics::Quality quality = measureSeconds(*world, statics, 3.0F);
            CHECK(quality.floorPenetrationM < 0.008F);
            // It is off, and lies on the ground or leans there.
            CHECK(bodyOfDoll(*world, 0).worldFromBody.translation.y < -0.4F);
        }
    }
}

TEST_CASE("rays meet every kind of static geometry, and meshes only from the front") {
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver);
        world->addStatic(round(StaticShape::Kind::sphere, 0.5F, 0, {0, 1, 0}));
        world->addStatic(round(StaticShape::Kind::capsule, 0.25F, 1.0F, {4, 1, 0}, kCapsuleAlongX));
        world->addStatic(staticMesh(gridMesh(8, 4.0F, hills), {10, 0, 0}));
        const auto sphere = world->rayTest({0, 1, 5}, {0, 1, -5});
        REQUIRE(sphere);
        CHECK_FALSE(sphere->doll.isSet());
        CHECK(sphere->position.z == Approx(0.5F).margin(0.01));
        const auto capsule = world->rayTest({4.9F, 3, 0}, {4.9F, -1, 0});
        REQUIRE(capsule);
        CHECK(capsule->position.y == Approx(1.25F).margin(0.01));
        CHECK(capsule->normal.y == Approx(1.0F).margin(0.01));
        const auto mesh = world->rayTest({10, 3, 0}, {10, -1, 0});
        REQUIRE(mesh);
        CHECK(mesh->position.y == Approx(0.0F).margin(0.01));
        CHECK(mesh->normal.y > 0.9F);
        CHECK_FALSE(world->rayTest({10, -1, 0}, {10, 3, 0}));
    }
}

TEST_CASE("layers and masks decide who collides and what a ray meets") {
    const auto ball = rodProfile(0.0F, 0.1F);
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver);
        StaticShape floor;
        world->addStatic(floor);
        StaticShape table = staticBoxAt({0, 0.95F, 0}, {4, 0.05F, 1});
        table.filter.layers = 4;
        world->addStatic(table);
        const auto drop = [&](float x, const CollisionFilter& filter) {
            const physics::DollId doll = world->addDoll(ball, std::vector<BodyState>{stateAt({x, 1.5F, 0})});
            world->setDollFilter(doll, filter);
            CHECK(world->dollFilter(doll) == filter);
            return doll;
        };
        const physics::DollId plain = drop(-2, {});
        drop(0, {1, ~4U});
        drop(2, {0, CollisionFilter::kAll});
        physics::DynamicProp prop;
        prop.shape.kind = physics::BodyShape::Kind::sphere;
        prop.shape.radius = 0.1F;
        prop.state = stateAt({3, 1.5F, 0});
        prop.filter = {8, ~4U};
        world->addProp(prop);
        stepSeconds(*world, 1.5F);
        CHECK(bodyOfDoll(*world, 0).worldFromBody.translation.y == Approx(1.1F).margin(0.02));
        CHECK(bodyOfDoll(*world, 1).worldFromBody.translation.y == Approx(0.1F).margin(0.02));
        CHECK(bodyOfDoll(*world, 2).worldFromBody.translation.y < -3.0F);
        CHECK(world->propState(world->props()[0]).worldFromBody.translation.y == Approx(0.1F).margin(0.02));

        CHECK(world->rayTest({-2, 3, 0}, {-2, -1, 0})->doll == plain);
        const auto through = world->rayTest({-2, 3, 0}, {-2, -1, 0}, 4U);
        REQUIRE(through);
        CHECK_FALSE(through->doll.isSet());
        CHECK(through->position.y == Approx(1.0F).margin(0.01));
        CHECK_FALSE(world->rayTest({-2, 3, 0}, {-2, -1, 0}, 2U));

        // What lies on the table falls through it once it no longer collides, though it may have slept.
        world->setDollFilter(plain, {1, ~4U});
        world->setPropFilter(world->props()[0], {8, 0});
        stepSeconds(*world, 1.5F);
        CHECK(bodyOfDoll(*world, 0).worldFromBody.translation.y == Approx(0.1F).margin(0.02));
        CHECK(world->propState(world->props()[0]).worldFromBody.translation.y < -3.0F);
    }
}

TEST_CASE("dolls of layers that don't meet pass through each other") {
    const auto ball = rodProfile(0.0F, 0.2F);
    physics::WorldSettings settings;
    settings.gravity = vec3(0);
    for (const SolverKind solver : kAllSolvers) {
        for (const bool meet : {true, false}) {
            INFO(physics::solverName(solver) << ' ' << meet);
            const auto world = worldOf(solver, settings);
            world->addDoll(ball, std::vector<BodyState>{stateAt({-1, 0, 0}, quat(1, 0, 0, 0), {2, 0, 0})});
            world->addDoll(ball, std::vector<BodyState>{stateAt({1, 0, 0}, quat(1, 0, 0, 0), {-2, 0, 0})});
            world->setDollFilter(world->dolls()[0], {2, meet ? 4U : 2U});
            world->setDollFilter(world->dolls()[1], {4, 2U | 4U});
            stepSeconds(*world, 1.0F);
            CHECK((bodyOfDoll(*world, 0).worldFromBody.translation.x < 0.5F) == meet);
        }
    }
}
