#include <cstring>

#include "support/catch.hpp"
#include "support/dolls.hpp"
#include "world_table.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::BodyState;
using physics::CaughtDoll;
using physics::SolverKind;

namespace {

// Moments that no body can have in one hand, which drives any solver to numbers that are not finite.
physics::RagdollProfile poisoned() {
    physics::RagdollProfile profile = makeDoll();
    for (physics::BodyProfile& body : profile.bodies)
        body.inertia = {1e-12F, 10.0F, 1e-12F};
    return profile;
}

bool sameBits(const std::vector<BodyState>& a, const std::vector<BodyState>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(BodyState)) == 0;
}

bool isFinite(const std::vector<BodyState>& bodies) {
    for (const BodyState& body : bodies)
        if (!lutka::isFinite(body.worldFromBody) || !lutka::isFinite(body.linearVelocity) ||
            !lutka::isFinite(body.angularVelocity))
            return false;
    return true;
}

}  // namespace

TEST_CASE("a doll faster than sense allows is put back to where it was and to sleep, and named") {
    const physics::RagdollProfile profile = makeDoll();
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver);
        world->addDoll(profile, standingDoll(profile, {0, 5, 0}));
        const auto before = bodiesOfDoll(*world, 0);
        const physics::DollId doll = world->dolls()[0];
        world->applyImpulse(doll, 0, {1e6F, 0, 0}, before[0].worldFromBody.translation);
        world->step(kFrame);
        REQUIRE(world->caught().size() == 1);
        CHECK(world->caught()[0].doll == doll);
        CHECK(world->caught()[0].times == 1);
        CHECK(world->isAsleep(doll));
        const auto after = bodiesOfDoll(*world, 0);
        for (std::size_t i = 0; i < after.size(); ++i) {
            CHECK(after[i].worldFromBody.translation == before[i].worldFromBody.translation);
            CHECK(after[i].linearVelocity == vec3(0));
        }
    }
}

TEST_CASE("a doll that no solver can hold leaves its neighbours the bits that they have without it") {
    const physics::RagdollProfile profile = makeDoll();
    const physics::RagdollProfile bad = poisoned();
    // Not stock Bullet: the order in which it solves depends on what else is in the world.
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        std::unique_ptr<physics::World> worlds[2];
        for (int with = 0; with < 2; ++with) {
            worlds[with] = worldOf(solver);
            worlds[with]->addStatic({});
            for (int i = 0; i < 2; ++i)
                worlds[with]->addDoll(profile, standingDoll(profile, {5.0F * static_cast<float>(i), 0.5F, 0}));
            if (with == 0) continue;
            worlds[with]->addDoll(bad, standingDoll(profile, {-5, 0.5F, 0}, quat(1, 0, 0, 0), {0, -30, 0}));
        }
        for (int step = 0; step < 180; ++step) {
            for (const auto& world : worlds)
                world->step(kFrame);
            REQUIRE(isFinite(bodiesOfDoll(*worlds[1], 2)));
            for (int i = 0; i < 2; ++i)
                REQUIRE(sameBits(bodiesOfDoll(*worlds[0], i), bodiesOfDoll(*worlds[1], i)));
        }
    }
}
