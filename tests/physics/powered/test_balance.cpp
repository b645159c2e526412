#include "physics/powered/balance.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "physics/powered/puppet.hpp"
#include "physics/worlds/world_table.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::BodyState;
using physics::Puppet;
using physics::PuppetSettings;
using physics::Role;
using physics::SolverKind;

namespace {

// Whether a doll that nothing pins stands for `seconds`, with a push of so many N s on its chest after three seconds.
bool standsFor(SolverKind solver, float seconds, const vec3& impulse, bool balances = true) {
    const physics::RagdollProfile profile = makeDoll();
    physics::WorldSettings world;
    world.contactReports = true;
    const auto made = worldOf(solver, world);
    made->addStatic(physics::StaticShape{});
    const auto start = standingDoll(profile, {0, 0.001F, 0});
    const physics::DollId doll = made->addDoll(profile, start);
    PuppetSettings settings;
    settings.pinForceN = 0.0F;
    settings.balances = balances;
    settings.knockOutLoss = 2.0F;
    const int chest = physics::bodyOf(profile, Role::chest);
    const int hips = physics::bodyOf(profile, Role::hips);
    Puppet puppet(*made, doll, profile, hips, start, settings);
    std::vector<RigidTransform> pose;
    for (const BodyState& body : start)
        pose.push_back(body.worldFromBody);
    const int steps = static_cast<int>(seconds / kFrame);
    for (int i = 0; i < steps; ++i) {
        if (i == 180 && impulse != vec3(0))
            puppet.hit(chest, bodyOfDoll(*made, 0, chest).worldFromBody.translation, impulse);
        puppet.prepare(pose, pose, kFrame);
        made->step(kFrame);
        std::array<bool, 2> grounded{false, false};
        for (const physics::ContactReport& report : made->contactReports())
            for (std::size_t side = 0; side < grounded.size(); ++side)
                grounded[side] =
                    grounded[side] || report.a.body == puppet.feet()[side] || report.b.body == puppet.feet()[side];
        puppet.setGrounded(grounded);
    }
    return puppet.state() != physics::PuppetState::limp &&
           bodyOfDoll(*made, 0, hips).worldFromBody.translation.y > 0.9F * start[hips].worldFromBody.translation.y;
}

}  // namespace

TEST_CASE("a powered doll that nothing pins stands by its ankles") {
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        CHECK(standsFor(solver, 10.0F, vec3(0)));
    }
}

TEST_CASE("balance takes pushes from eight directions that knock over a doll without it") {
    // N s from behind, …, the lesser of both solvers; this doll has no heels: its feet begin below the ankles, so least
    // can be taken from ahead.
    constexpr float kTaken[8] = {15, 20, 20, 15, 15, 15, 20, 20};
    for (const SolverKind solver : kOurSolvers) {
        int fallen = 0;
        for (int way = 0; way < 8; ++way) {
            const float angle = kPi / 4.0F * static_cast<float>(way);
            INFO(physics::solverName(solver) << ", " << way * 45 << " degrees from ahead");
            const vec3 push = kTaken[way] * vec3(std::sin(angle), 0, std::cos(angle));
            CHECK(standsFor(solver, 8.0F, push));
            fallen += standsFor(solver, 8.0F, push, false) ? 0 : 1;
        }
        CHECK(fallen >= 4);
    }
}

TEST_CASE("nobody balances without a foot on the ground") {
    const physics::RagdollProfile profile = makeDoll();
    physics::Balance balance(profile);
    const auto start = standingDoll(profile, vec3(0));
    CHECK(balance.stanceOf(start, {false, false}, 9.81F, kFrame) == nullptr);
    const physics::Stance* stance = balance.stanceOf(start, {true, false}, 9.81F, kFrame);
    REQUIRE(stance != nullptr);
    const int left = physics::bodyOf(profile, Role::leftFoot) - 1;
    const int right = physics::bodyOf(profile, Role::rightFoot) - 1;
    CHECK(stance->share[left] == 1.0F);
    CHECK(stance->share[right] == 0.0F);
    CHECK(glm::length(stance->axis[left]) == Approx(1.0F));
    CHECK(stance->axis[right] == vec3(0));
}

TEST_CASE("an ankle gives what presses the foot beyond the capture point, within its length, trunk and arms the rest") {
    const physics::RagdollProfile profile = makeDoll();
    const int left = physics::bodyOf(profile, Role::leftFoot) - 1;
    const int arm = physics::bodyOf(profile, Role::leftUpperArm) - 1;
    const int thigh = physics::bodyOf(profile, Role::leftUpperLeg) - 1;
    auto bodies = standingDoll(profile, vec3(0));
    // The torque of the left ankle, and how the arm is turned, about the axis that points to the left: for a doll that
    // moves ahead at so much.
    const auto at = [&](float speed) {
        physics::Balance balance(profile);
        for (physics::BodyState& body : bodies)
            body.linearVelocity = {0, 0, speed};
        const physics::Stance* stance = nullptr;
        for (int i = 0; i < 12; ++i)
            stance = balance.stanceOf(bodies, {true, true}, 9.81F, kFrame);
        REQUIRE(stance != nullptr);
        CHECK(std::abs(stance->axis[left].x) == Approx(1.0F).margin(1e-3F));
        return std::array<float, 3>{stance->torque[left] * stance->axis[left].x, stance->turn[arm].x,
                                    stance->turn[thigh].x};
    };
    const auto slow = at(0.01F);
    const auto fast = at(0.5F);
    const auto faster = at(0.6F);
    CHECK(fast[0] > slow[0]);
    CHECK(faster[0] == fast[0]);
    // Half of the weight, at no more than the foot's tip (its caps' centres are 14 cm apart, the ankle is over one).
    CHECK(fast[0] < 0.5F * profile.totalMassKg * 9.81F * (0.07F + 1.21F * 0.07F));
    CHECK(slow[1] == 0.0F);
    CHECK(fast[1] > 0.1F);
    CHECK(fast[2] < 0.0F);
    // Backwards all of it is the other way round.
    const auto back = at(-0.5F);
    CHECK(back[0] <= slow[0]);
    CHECK(back[1] == Approx(-fast[1]).epsilon(0.2));
}

TEST_CASE("a doll that is held by a pin or a led body does not balance as well") {
    const physics::RagdollProfile profile = makeDoll();
    const int chest = physics::bodyOf(profile, Role::chest);
    // Where the chest is after a push; what holds it is told by `hold`.
    const auto chestAfter = [&](bool balances, const std::function<void(PuppetSettings&)>& hold) {
        const auto world = worldOf(SolverKind::crowd);
        world->addStatic(physics::StaticShape{});
        const auto start = standingDoll(profile, {0, 0.001F, 0});
        const physics::DollId doll = world->addDoll(profile, start);
        PuppetSettings settings;
        settings.pinForceN = 0.0F;
        settings.balances = balances;
        settings.pins.assign(profile.bodies.size(), 0.0F);
        settings.led.assign(profile.bodies.size(), 0.0F);
        hold(settings);
        Puppet puppet(*world, doll, profile, physics::bodyOf(profile, Role::hips), start, settings);
        std::vector<RigidTransform> pose;
        for (const BodyState& body : start)
            pose.push_back(body.worldFromBody);
        for (int i = 0; i < 60; ++i) {
            if (i == 10) puppet.hit(chest, bodyOfDoll(*world, 0, chest).worldFromBody.translation, vec3(0, 0, 20));
            puppet.setGrounded({true, true});
            puppet.prepare(pose, pose, kFrame);
            world->step(kFrame);
        }
        return bodyOfDoll(*world, 0, chest).worldFromBody.translation;
    };
    const auto freely = [](PuppetSettings&) {};
    const auto pinned = [&](PuppetSettings& settings) { settings.pins[chest] = 500.0F; };
    const auto led = [&](PuppetSettings& settings) { settings.led[chest] = 0.3F; };
    CHECK(chestAfter(true, freely) != chestAfter(false, freely));
    CHECK(chestAfter(true, pinned) == chestAfter(false, pinned));
    CHECK(chestAfter(true, led) == chestAfter(false, led));
}
