#include <algorithm>
#include <glm/geometric.hpp>

#include "crowd_scene.hpp"
#include "physics/profile/constraint_state.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::BodyState;
using physics::createCrowdWorld;
using physics::WorldSettings;

namespace {

std::uint64_t pitHash(int threads, std::optional<physics::crowd::InstructionSet> set, bool watched,
                      bool dense = false) {
    const int dolls = dense ? 200 : 30;
    const int steps = dense ? 40 : 100;
    const physics::RagdollProfile profile = makeDoll();
    WorldSettings settings;
    settings.threads = threads;
    physics::crowd::CrowdTuning tuning;
    tuning.instructionSet = set;
    const auto world = createCrowdWorld(settings, tuning);
    std::vector<physics::StaticShape> statics;
    fillPit(*world, profile, dolls, statics, dense ? 0.6F : 2.1F);
    int substeps = 0;
    for (int i = 0; i < steps; ++i) {
        if (watched)
            world->step(kStep, [&] { ++substeps; });
        else
            world->step(kStep);
    }
    if (dense) CHECK(world->stepTimes().islands == 1);
    if (watched) CHECK(substeps == steps * world->substepsPerStep());
    return stateHash(*world);
}

}  // namespace

TEST_CASE("the same bits come out at every thread count and with every set that fuses") {
    using physics::crowd::InstructionSet;
    const std::uint64_t hash = pitHash(1, std::nullopt, false);
    for (int threads = 1; threads <= 5; ++threads) {
        CAPTURE(threads);
        CHECK(pitHash(threads, std::nullopt, false) == hash);
    }
    CHECK(pitHash(2, std::nullopt, true) == hash);
    for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
        CAPTURE(static_cast<int>(set));
        if (physics::crowd::hasInstructionSet(set)) CHECK(pitHash(1, set, false) == hash);
    }
    CHECK(pitHash(1, InstructionSet::baseline, false) == pitHash(3, InstructionSet::baseline, true));
}

TEST_CASE("a heap so large that its contacts are cut into parts has the same bits at every thread count") {
    using physics::crowd::InstructionSet;
    const std::uint64_t hash = pitHash(1, std::nullopt, false, true);
    for (const int threads : {2, 3, 5, 8}) {
        CAPTURE(threads);
        CHECK(pitHash(threads, std::nullopt, threads == 3, true) == hash);
    }
    for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
        CAPTURE(static_cast<int>(set));
        if (physics::crowd::hasInstructionSet(set)) CHECK(pitHash(2, set, false, true) == hash);
    }
}

TEST_CASE("one step with each instruction set differs by rounding alone") {
    using physics::crowd::InstructionSet;
    const physics::RagdollProfile profile = makeDoll();
    std::vector<physics::BodyState> expected;
    for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
        if (!physics::crowd::hasInstructionSet(set)) continue;
        CAPTURE(static_cast<int>(set));
        physics::crowd::CrowdTuning tuning;
        tuning.instructionSet = set;
        const auto world = createCrowdWorld(WorldSettings{}, tuning);
        world->addStatic(floorPlane());
        std::vector<physics::BodyState> start = placedDoll(profile, {0, 0.1F, 0}, glm::angleAxis(0.3F, vec3(1, 0, 0)));
        for (std::size_t i = 0; i < start.size(); ++i)
            start[i].angularVelocity = {1, static_cast<float>(i % 3), -2};
        world->addDoll(profile, start);
        world->step(kStep);
        const std::vector<physics::BodyState> bodies = bodiesOf(*world, 0);
        if (expected.empty()) expected = bodies;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const vec3 apart = bodies[i].worldFromBody.translation - expected[i].worldFromBody.translation;
            CHECK(glm::length(apart) < 1e-5F);
        }
    }
}

TEST_CASE("a fallen doll sleeps without moving and an impulse wakes it") {
    const physics::RagdollProfile profile = makeDoll();
    const auto world = createCrowdWorld(WorldSettings{});
    world->addStatic(floorPlane());
    world->addDoll(profile, placedDoll(profile, {0, 0.5F, 0}, glm::angleAxis(1.0F, vec3(1, 0, 0))));
    int steps = 0;
    for (; steps < 600 && !world->isAsleep(world->dolls()[0]); ++steps)
        world->step(kStep);
    REQUIRE(world->isAsleep(world->dolls()[0]));
    const std::uint64_t asleep = stateHash(*world);
    for (int i = 0; i < 30; ++i)
        world->step(kStep);
    CHECK(stateHash(*world) == asleep);
    world->applyImpulse(world->dolls()[0], 0, {0, 60, 0}, bodiesOf(*world, 0)[0].worldFromBody.translation);
    CHECK_FALSE(world->isAsleep(world->dolls()[0]));
    for (int i = 0; i < 10; ++i)
        world->step(kStep);
    CHECK(stateHash(*world) != asleep);
}

TEST_CASE("a sleeping doll wakes when another falls on it and one far away sleeps on") {
    const physics::RagdollProfile profile = makeDoll();
    const auto world = createCrowdWorld(WorldSettings{});
    world->addStatic(floorPlane());
    const quat lying = glm::angleAxis(1.4F, vec3(1, 0, 0));
    world->addDoll(profile, placedDoll(profile, {0, -0.5F, 0}, lying));
    world->addDoll(profile, placedDoll(profile, {6, -0.5F, 0}, lying));
    for (int i = 0; i < 600 && !(world->isAsleep(world->dolls()[0]) && world->isAsleep(world->dolls()[1])); ++i)
        world->step(kStep);
    REQUIRE(world->isAsleep(world->dolls()[0]));
    REQUIRE(world->isAsleep(world->dolls()[1]));
    world->addDoll(profile, placedDoll(profile, {0, 1.2F, 0}));
    CHECK(world->isAsleep(world->dolls()[0]));
    bool woken = false;
    for (int i = 0; i < 90; ++i) {
        world->step(kStep);
        woken = woken || !world->isAsleep(world->dolls()[0]);
    }
    CHECK(woken);
    CHECK(world->isAsleep(world->dolls()[1]));
}

TEST_CASE("a doll dragged by the hand at 50 m/s holds together") {
    const physics::RagdollProfile profile = makeDoll();
    const auto world = createCrowdWorld(WorldSettings{});
    world->addStatic(floorPlane());
    world->addDoll(profile, placedDoll(profile, {0, 0.3F, 0}));
    const int hand = physics::bodyOf(profile, physics::Role::leftHand);
    const physics::DollId held = world->dolls()[0];
    const physics::DragId pull = world->addDrag({held, hand, vec3(0), vec3(2, 1.5F, 0), 1500.0F});
    float separation = 0.0F;
    for (int i = 0; i < 600; ++i) {
        // Round and round on a circle of 2 m.
        const float angle = 25.0F * kStep * static_cast<float>(i);
        world->setDrag(pull, {held, hand, vec3(0), vec3(2 * std::cos(angle), 1.5F, 2 * std::sin(angle)), 1500.0F});
        world->step(kStep, [&] {
            const std::vector<BodyState> bodies = bodiesOf(*world, 0);
            for (const physics::ConstraintProfile& constraint : profile.constraints) {
                const auto state = physics::measureConstraint(constraint, bodies[constraint.parent].worldFromBody,
                                                              bodies[constraint.child].worldFromBody);
                separation = std::max(separation, state.separationM);
            }
        });
    }
    CHECK(separation < 0.05F);
    for (const BodyState& body : bodiesOf(*world, 0))
        CHECK(isFinite(body.worldFromBody));
    CHECK(std::isfinite(world->dragWork()));
}

TEST_CASE("a hand that is pinned in the air carries the doll") {
    const physics::RagdollProfile profile = makeDoll();
    const auto world = createCrowdWorld(WorldSettings{});
    const std::vector<BodyState> start = placedDoll(profile, {0, 2.0F, 0});
    world->addDoll(profile, start);
    const int hand = physics::bodyOf(profile, physics::Role::leftHand);
    const vec3 pin = start[hand].worldFromBody.translation;
    const physics::DollId held = world->dolls()[0];
    const physics::DragId pull = world->addDrag({held, hand, vec3(0), pin, 5000.0F});
    float sag = 0.0F;
    for (int i = 0; i < 300; ++i) {
        world->step(kStep);
        sag = std::max(sag, glm::distance(bodiesOf(*world, 0)[hand].worldFromBody.translation, pin));
    }
    CHECK(sag < 0.02F);
    // A pull that may not carry the weight lets it fall, no faster than gravity has it.
    world->setDrag(pull, {held, hand, vec3(0), pin, 200.0F});
    for (int i = 0; i < 30; ++i)
        world->step(kStep);
    const float fallen = pin.y - bodiesOf(*world, 0)[hand].worldFromBody.translation.y;
    CHECK(fallen > 0.1F);
    CHECK(fallen < 0.5F * 9.81F * 0.25F);
}

TEST_CASE("the work of a drag is the energy that a lifted rod gains") {
    const physics::RagdollProfile profile = makeRod(0.2F, 0.05F, 2.0F);
    const auto world = createCrowdWorld(WorldSettings{});
    world->addDoll(profile, std::vector<BodyState>(1));
    const physics::DollId rod = world->dolls()[0];
    const physics::DragId pull = world->addDrag({rod, 0, vec3(0), vec3(0), 500.0F});
    for (int i = 0; i < 240; ++i) {
        world->setDrag(pull,
                       {rod, 0, vec3(0), vec3(0, 0.5F * kStep * static_cast<float>(std::min(i, 180)), 0), 500.0F});
        world->step(kStep);
    }
    const BodyState body = bodiesOf(*world, 0)[0];
    const float gained = 2.0F * 9.81F * body.worldFromBody.translation.y +
                         0.5F * 2.0F * glm::dot(body.linearVelocity, body.linearVelocity);
    CHECK(world->dragWork() == Approx(gained).epsilon(0.005));
    CHECK(world->dragImpulse() == Approx(2.0 * 9.81 * 4.0).epsilon(0.005));  // its weight, for four seconds
    CHECK(body.worldFromBody.translation.y == Approx(1.5F).margin(0.02));
}

TEST_CASE("rays meet bodies and floors where they are") {
    const physics::RagdollProfile profile = makeRod(0.5F, 0.1F, 2.0F);
    const auto world = createCrowdWorld(WorldSettings{});
    world->addStatic(floorPlane());
    std::vector<BodyState> bodies(1);
    bodies[0].worldFromBody.translation = {0, 2, 0};
    world->addDoll(profile, bodies);
    const auto side = world->rayTest({-2, 2, 0}, {2, 2, 0});
    REQUIRE(side);
    CHECK(side->doll == world->dolls()[0]);
    CHECK(side->body == 0);
    CHECK(side->position.x == Approx(-0.1F).margin(1e-4));
    CHECK(side->normal.x == Approx(-1.0F).margin(1e-4));
    const auto cap = world->rayTest({0, 5, 0}, {0, 0, 0});
    REQUIRE(cap);
    CHECK(cap->position.y == Approx(2.6F).margin(1e-4));
    const auto floor = world->rayTest({1, 3, 0}, {1, -1, 0});
    REQUIRE(floor);
    CHECK_FALSE(floor->doll.isSet());
    CHECK(floor->fraction == Approx(0.75F));
    CHECK_FALSE(world->rayTest({1, 3, 0}, {1, 1, 0}));
}

TEST_CASE("a lying rod reports a contact at each end") {
    const physics::RagdollProfile profile = makeRod(0.3F, 0.1F, 2.0F);
    const auto world = createCrowdWorld(WorldSettings{});
    world->addStatic(floorPlane());
    std::vector<BodyState> bodies(1);
    bodies[0].worldFromBody.rotation = glm::angleAxis(kPi / 2, vec3(1, 0, 0));
    bodies[0].worldFromBody.translation = {0, 0.12F, 0};
    world->addDoll(profile, bodies);
    for (int i = 0; i < 60; ++i)
        world->step(kStep);
    std::vector<physics::ContactPoint> contacts;
    world->getContacts(contacts);
    REQUIRE(contacts.size() == 2);
    for (const physics::ContactPoint& contact : contacts) {
        CHECK(contact.normal.y == Approx(1.0F));
        CHECK(contact.position.y == Approx(0.0F).margin(2e-3));
        CHECK(std::abs(contact.position.z) == Approx(0.3F).margin(0.01));
        CHECK(std::abs(contact.distance) < 3e-3F);
    }
}

TEST_CASE("dolls of two profiles share a world and placing one anew wakes it") {
    const physics::RagdollProfile doll = makeDoll();
    const physics::RagdollProfile rod = makeRod(0.3F, 0.1F, 2.0F);
    const auto world = createCrowdWorld(WorldSettings{});
    world->addStatic(floorPlane());
    std::vector<BodyState> bodies(1);
    bodies[0].worldFromBody.translation = {3, 0.6F, 0};
    world->addDoll(doll, placedDoll(doll, {0, 0.2F, 0}));
    const physics::DollId second = world->addDoll(rod, bodies);
    CHECK(second == world->dolls()[1]);
    world->addDoll(doll, placedDoll(doll, {-3, 0.2F, 0}));
    CHECK(&world->profileOf(world->dolls()[1]) == &rod);
    for (int i = 0; i < 480; ++i)
        world->step(kStep);
    CHECK(world->isAsleep(world->dolls()[1]));
    bodies[0].worldFromBody.translation = {3, 2, 0};
    world->setBodies(world->dolls()[1], bodies);
    CHECK_FALSE(world->isAsleep(world->dolls()[1]));
    CHECK(bodiesOf(*world, 1)[0].worldFromBody.translation.y == Approx(2.0F));
    world->step(kStep);
    CHECK(bodiesOf(*world, 1)[0].worldFromBody.translation.y < 2.0F);
}
