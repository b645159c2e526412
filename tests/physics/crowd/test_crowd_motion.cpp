#include <glm/geometric.hpp>

#include "crowd_scene.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::BodyState;
using physics::createCrowdWorld;
using physics::WorldSettings;

namespace {

// Nothing but the laws of motion: the profile's own inertia, no damping.
physics::crowd::CrowdTuning plainMotion() {
    physics::crowd::CrowdTuning tuning;
    tuning.leastGyration = 0.0F;
    tuning.angularDamping = 0.0F;
    return tuning;
}

}  // namespace

TEST_CASE("a doll falls by half g t squared") {
    const physics::RagdollProfile profile = makeDoll();
    const auto world = createCrowdWorld(WorldSettings{});
    world->addDoll(profile, placedDoll(profile, {0, 100, 0}));
    const float start = totalsOf(*world, 0).centre.y;
    for (int i = 0; i < 60; ++i)
        world->step(kStep);
    const Totals totals = totalsOf(*world, 0);
    // The semi-implicit Euler step runs ahead by half a substep's fall; the first substeps, which are slow, are longer.
    const auto ahead = [](int substeps) { return 0.5F * 9.81F * kStep / static_cast<float>(substeps); };
    const float fallen = start - totals.centre.y;
    CHECK(fallen > 0.5F * 9.81F + ahead(world->substepsPerStep()) - 2e-3F);
    CHECK(fallen < 0.5F * 9.81F + ahead(physics::crowd::CrowdTuning{}.calmSubsteps));
    CHECK(totals.momentum.y / totals.massKg == Approx(-9.81F).margin(1e-3));
}

TEST_CASE("momentum and angular momentum of a tumbling doll stay in zero gravity") {
    const physics::RagdollProfile profile = makeDoll();
    WorldSettings settings;
    settings.gravity = vec3(0);
    const auto world = createCrowdWorld(settings, plainMotion());
    std::vector<BodyState> bodies = placedDoll(profile, {0, 0, 0}, quat(1, 0, 0, 0), {0.5F, 0.2F, -0.3F});
    for (BodyState& body : bodies) {
        const vec3 spin(1.0F, 3.0F, -2.0F);
        body.angularVelocity = spin;
        body.linearVelocity += glm::cross(spin, body.worldFromBody.translation - vec3(0, 0.9F, 0));
    }
    bodies[5].angularVelocity += vec3(0, 0, 8);
    world->addDoll(profile, bodies);
    const Totals before = totalsOf(*world, 0);
    for (int i = 0; i < 120; ++i)
        world->step(kStep);
    const Totals after = totalsOf(*world, 0);
    CHECK(glm::distance(after.momentum, before.momentum) < 0.01F * glm::length(before.momentum));
    // Angular momentum is about the origin, so that the centre's way counts in both.
    CHECK(glm::distance(after.angularMomentum, before.angularMomentum) < 0.02F * glm::length(before.angularMomentum));
}

TEST_CASE("a spinning rod keeps its energy through free precession") {
    const physics::RagdollProfile profile = makeRod(0.3F, 0.05F, 2.0F);
    WorldSettings settings;
    settings.gravity = vec3(0);
    const auto world = createCrowdWorld(settings, plainMotion());
    BodyState body;
    body.angularVelocity = {3, 12, 1};
    world->addDoll(profile, std::vector<BodyState>{body});
    const auto energy = [&] {
        const BodyState now = bodiesOf(*world, 0)[0];
        const vec3 rate = glm::conjugate(now.worldFromBody.rotation) * now.angularVelocity;
        return 0.5F * glm::dot(rate * profile.bodies[0].inertia, rate);
    };
    const float before = energy();
    for (int i = 0; i < 300; ++i)
        world->step(kStep);
    CHECK(energy() == Approx(before).epsilon(0.01));
}

TEST_CASE("a rod held at its end swings with the period of a physical pendulum") {
    constexpr float half = 0.4F;
    const physics::RagdollProfile profile = makeRod(half, 0.03F, 3.0F);
    const auto world = createCrowdWorld(WorldSettings{}, plainMotion());
    BodyState body;
    body.worldFromBody.rotation = glm::angleAxis(0.1F, vec3(0, 0, 1));
    body.worldFromBody.translation = body.worldFromBody.rotation * vec3(0, -half, 0);
    world->addDoll(profile, std::vector<BodyState>{body});
    world->addDrag({world->dolls()[0], 0, {0, half, 0}, {0, 0, 0}, 1e4F});
    // Two crossings of the vertical with the same sign of speed are a period apart.
    std::vector<float> crossings;
    float last = body.worldFromBody.translation.x;
    for (int i = 0; i < 600; ++i) {
        world->step(kStep);
        const float x = bodiesOf(*world, 0)[0].worldFromBody.translation.x;
        if (last < 0.0F && x >= 0.0F) crossings.push_back(kStep * (static_cast<float>(i) - last / (x - last)));
        last = x;
    }
    REQUIRE(crossings.size() >= 4);
    const float period = (crossings.back() - crossings.front()) / static_cast<float>(crossings.size() - 1);
    const float inertia = profile.bodies[0].inertia.x + 3.0F * half * half;
    CHECK(period == Approx(2.0F * kPi * std::sqrt(inertia / (3.0F * 9.81F * half))).epsilon(0.02));
}

TEST_CASE("an impulse changes momentum by itself") {
    const physics::RagdollProfile profile = makeDoll();
    WorldSettings settings;
    settings.gravity = vec3(0);
    const auto world = createCrowdWorld(settings, plainMotion());
    world->addDoll(profile, placedDoll(profile, {0, 0, 0}));
    world->applyImpulse(world->dolls()[0], 6, {0, 0, 5}, bodiesOf(*world, 0)[6].worldFromBody.translation);
    for (int i = 0; i < 30; ++i)
        world->step(kStep);
    CHECK(glm::distance(totalsOf(*world, 0).momentum, vec3(0, 0, 5)) < 0.05F);
}
