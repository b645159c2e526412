#include <glm/geometric.hpp>

#include "crowd_scene.hpp"
#include "physics/collision/shape.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::BodyState;
using physics::createCrowdWorld;
using physics::WorldSettings;

namespace {

physics::DynamicProp makeBall(float radius, float massKg, const vec3& at, const vec3& velocity) {
    physics::DynamicProp ball;
    ball.shape.kind = physics::BodyShape::Kind::sphere;
    ball.shape.radius = radius;
    ball.massKg = massKg;
    ball.state.worldFromBody.translation = at;
    ball.state.linearVelocity = velocity;
    return ball;
}

// The doll with boxes in place of its capsules.
physics::RagdollProfile boxed(physics::RagdollProfile profile) {
    for (physics::BodyProfile& body : profile.bodies) {
        physics::BodyShape& shape = body.shape;
        if (shape.kind != physics::BodyShape::Kind::capsule) continue;
        shape.halfExtents = {shape.radius, shape.halfLength + 0.6F * shape.radius, shape.radius};
        shape.kind = physics::BodyShape::Kind::box;
    }
    return profile;
}

}  // namespace

TEST_CASE("a ball that lands at a slant rolls on, not faster than it goes, and gains no energy") {
    for (const float down : {1.0F, 3.0F, 5.0F, 7.0F}) {
        CAPTURE(down);
        const std::vector<physics::StaticShape> statics{floorPlane()};
        const auto world = createCrowdWorld(WorldSettings{});
        world->addStatic(statics[0]);
        world->addProp(makeBall(0.12F, 4.0F, {0, 0.3F, 0}, {6, -down, 0}));
        physics::QualityMeter meter(*world, statics, vec3(0, -9.81F, 0));
        double seconds = 0.0;
        float ahead = 0.0F;  // m/s, of the rolling surface before the centre
        for (int i = 0; i < 60; ++i) {
            world->step(kStep, [&] {
                seconds += static_cast<double>(kStep) / world->substepsPerStep();
                meter.sample(seconds);
                const BodyState ball = world->propState(world->props()[0]);
                ahead = std::max(ahead, -0.12F * ball.angularVelocity.z - ball.linearVelocity.x);
            });
        }
        CHECK(ahead < 0.15F);
        CHECK(meter.result().energyGrowthJ < 0.5F);
    }
}

TEST_CASE("contacts within a doll that press each other too much give it no energy") {
    const physics::RagdollProfile profile = boxed(makeDoll());
    physics::crowd::CrowdTuning eager;
    eager.ownMass = 64.0F;
    eager.ownBlow = 40.0F;
    float worst = 0.0F;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        Random random(seed);
        const std::vector<physics::StaticShape> statics{floorPlane(), staticBox({0, 2, 2}, {4, 2, 0.025F})};
        const auto world = createCrowdWorld(WorldSettings{}, eager);
        for (const physics::StaticShape& shape : statics)
            world->addStatic(shape);
        const quat turn = glm::normalize(
            quat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
        world->addDoll(profile, placedDoll(profile, {0, 0.8F, 0}, turn, {0, 0, 12}));
        const physics::Quality quality = stepAndMeasure(*world, statics, 1.0F);
        worst = std::max(worst, quality.energyGrowthJ / quality.initialEnergyJ);
    }
    CHECK(worst < 0.04F);
}

TEST_CASE("a ball that strikes a box in the middle of a step is met where both are then") {
    const physics::RagdollProfile pair =
        boxed(makePair(physics::ConeTwistLimits{radians(60), radians(60), radians(60)}));
    WorldSettings settings;
    settings.gravity = vec3(0);
    for (const float speed : {5.0F, 10.0F, 15.0F}) {
        CAPTURE(speed);
        float deepest = 0.0F;
        int hits = 0;
        for (int i = 0; i < 12; ++i) {
            const auto world = createCrowdWorld(settings);
            std::vector<BodyState> bodies(2);
            for (int b = 0; b < 2; ++b)
                bodies[b].worldFromBody = pair.bodies[b].jointFromBody;
            world->addDoll(pair, bodies);
            // Past the end of the arm, which the ball turns.
            world->addProp(makeBall(0.1F, 4.0F, {0.3F, 0.3F + 0.02F * static_cast<float>(i), 0.06F}, {0, -speed, 0}));
            for (int step = 0; step < 20; ++step)
                world->step(kStep, [&] {
                    const std::vector<BodyState> now = bodiesOf(*world, 0);
                    const BodyState ball = world->propState(world->props()[0]);
                    physics::BodyShape sphere;
                    sphere.kind = physics::BodyShape::Kind::sphere;
                    sphere.radius = 0.1F;
                    for (int b = 0; b < 2; ++b)
                        deepest = std::max(deepest, -distanceBetween(pair.bodies[b].shape, now[b].worldFromBody, sphere,
                                                                     ball.worldFromBody));
                });
            hits += world->propState(world->props()[0]).linearVelocity.y > -0.9F * speed ? 1 : 0;
        }
        CHECK(hits > 0);
        CHECK(deepest < 0.015F);
    }
}

TEST_CASE("a doll at rest that is struck only as others answer gets the whole blow") {
    // A blow on one end of the middle doll turns that, so that its other end strikes the third.
    const physics::HingeLimits wide{radians(-90), radians(90)};
    const physics::RagdollProfile pair = makePair(wide);
    const physics::RagdollProfile heavy = makePair(wide, 10.0F);
    WorldSettings settings;
    settings.gravity = vec3(0);
    const auto placed = [&](const vec3& firstBody, const vec3& velocity) {
        const quat across = glm::angleAxis(radians(90.0F), vec3(0, 1, 0));
        std::vector<BodyState> bodies(2);
        for (int b = 0; b < 2; ++b) {
            bodies[b].worldFromBody = RigidTransform{across, vec3(0)} * pair.bodies[b].jointFromBody;
            bodies[b].linearVelocity = velocity;
        }
        const vec3 offset = firstBody - bodies[0].worldFromBody.translation;
        for (BodyState& body : bodies)
            body.worldFromBody.translation += offset;
        return bodies;
    };
    for (int i = 0; i < 12; ++i) {
        const auto world = createCrowdWorld(settings);
        std::vector<BodyState> middle(2);
        for (int b = 0; b < 2; ++b)
            middle[b].worldFromBody = pair.bodies[b].jointFromBody;
        world->addDoll(pair, middle);
        world->addDoll(heavy, placed({0.35F, 0.11F + 0.04F * static_cast<float>(i), 0}, {0, -30, 0}));
        world->addDoll(pair, placed({-0.35F, -0.1001F, 0}, vec3(0)));
        for (int step = 0; step < 4; ++step)
            world->step(kStep);
        // The struck body goes ahead of the other. A doll that counts as one that pressed itself loses that.
        const std::vector<BodyState> third = bodiesOf(*world, 2);
        CHECK(third[0].linearVelocity.y < -0.4F);
        CHECK(third[0].linearVelocity.y < 5.0F * third[1].linearVelocity.y);
    }
}

TEST_CASE("a doll forgets the blow of a prop that is gone before it comes") {
    enum class Prop { none, leaves, stays };
    const auto hashWith = [](Prop prop) {
        // The second limb strikes the third, which reaches the fourth within that step: farther off than what is
        // foreseen without a blow.
        Limbs limbs = besideEachOther({-1.0F, -2.0F, -3.0F}, 0.13F);
        WorldSettings settings;
        settings.gravity = vec3(0);
        const auto world = createCrowdWorld(settings);
        const physics::DollId doll = world->addDoll(limbs.doll, limbs.bodies);
        physics::PropId passing;
        if (prop != Prop::none) passing = world->addProp(makeBall(0.1F, 4.0F, {-0.3F, 0.17F, 0}, {8, 0, 0}));
        world->step(kStep);
        if (prop == Prop::leaves) world->removeProp(passing);
        limbs.bodies[2].linearVelocity = {0, -9, 0};
        world->setBodies(doll, limbs.bodies);
        world->step(kStep);
        return stateHash(*world);
    };
    REQUIRE(hashWith(Prop::stays) != hashWith(Prop::none));
    CHECK(hashWith(Prop::leaves) == hashWith(Prop::none));
}
