#include "scene/puppet/rising.hpp"

#include <glm/gtc/quaternion.hpp>

#include "support/catch.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;

namespace {

constexpr float kStep = 1.0F / 60.0F;

// Steps until a limp doll is due to get up; -1: not within a second.
int stepsUntilDue(scene::Rising& rising, const physics::RagdollProfile& profile,
                  const std::vector<physics::BodyState>& bodies) {
    for (int step = 1; step <= 60; ++step)
        if (rising.watch(profile, bodies, false, kStep)) return step;
    return -1;
}

}  // namespace

TEST_CASE("a doll is due to get up when it has been at rest for a while, and not while a hand still swings") {
    const auto asset = test::bipedRagdoll();
    std::vector<physics::BodyState> bodies(asset->profile.bodies.size());
    scene::Rising rising;
    CHECK(stepsUntilDue(rising, asset->profile, bodies) == 18);  // 0.3 s
    CHECK(rising.restSeconds() >= 0.3F);

    bodies.back().angularVelocity = vec3(0, 4, 0);
    CHECK(stepsUntilDue(rising, asset->profile, bodies) == -1);
    CHECK(rising.restSeconds() == 0.0F);
    CHECK_FALSE(rising.watch(asset->profile, bodies, true, kStep));
    CHECK(rising.restSeconds() == Approx(kStep));
    rising.wake();
    CHECK(rising.restSeconds() == 0.0F);
}

TEST_CASE("the way up begins slowly, waits for feet that are behind, and not for ever") {
    scene::Rising rising;
    scene::GetUpClips::Match match;
    match.seconds = 0.5F;
    rising.begin(match);
    REQUIRE(rising.isOn());
    CHECK(rising.clipSeconds() == 0.5F);
    rising.advance(kStep, 0.0F, 0.0F);
    CHECK(rising.pace() == Approx(0.4F));
    rising.advance(kStep, 0.0F, 1.0F);
    CHECK(rising.pace() == Approx(1.0F));

    rising.advance(kStep, 1.0F, 1.0F);
    CHECK(rising.pace() < 0.1F);
    for (int step = 0; step < 120; ++step)
        rising.advance(kStep, 1.0F, 1.0F);
    CHECK(rising.pace() > 0.9F);
    rising.end();
    CHECK_FALSE(rising.isOn());
}

TEST_CASE("the first step of a way up turns no joint, the next tells which turned most") {
    const auto asset = test::bipedRagdoll();
    std::vector<RigidTransform> frames(asset->profile.bodies.size());
    scene::Rising rising;
    rising.begin({});
    CHECK_FALSE(rising.turnOfStep(asset->profile, frames));
    const int child = asset->profile.constraints[2].child;
    frames[child].rotation = glm::angleAxis(radians(7.0F), vec3(1, 0, 0));
    const auto turn = rising.turnOfStep(asset->profile, frames);
    REQUIRE(turn);
    CHECK(turn->degrees == Approx(7.0F).margin(1e-3));
    rising.begin({});
    CHECK_FALSE(rising.turnOfStep(asset->profile, frames));
}
