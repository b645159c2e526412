#include <algorithm>
#include <glm/geometric.hpp>

#include "crowd_scene.hpp"
#include "physics/profile/constraint_state.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::BodyState;
using physics::ConstraintState;
using physics::createCrowdWorld;

namespace {

// Runs the pair from the given turning rates in zero gravity, both about the anchor at the origin; returns the worst
// violation, in degrees.
struct PairRun {
    explicit PairRun(const physics::RagdollProfile& given) : profile(given) {
        physics::WorldSettings settings;
        settings.gravity = vec3(0);
        settings.sleeping = false;
        world = createCrowdWorld(settings);
        std::vector<BodyState> bodies(2);
        bodies[0].worldFromBody = profile.bodies[0].jointFromBody;
        bodies[1].worldFromBody = profile.bodies[1].jointFromBody;
        world->addDoll(profile, bodies);
    }

    void spin(int body, const vec3& rate) {
        std::vector<BodyState> bodies = bodiesOf(*world, 0);
        const vec3 anchor = bodies[0].worldFromBody * profile.constraints[0].parentFromFrame.translation;
        bodies[body].angularVelocity += rate;
        bodies[body].linearVelocity += glm::cross(rate, bodies[body].worldFromBody.translation - anchor);
        world->setBodies(world->dolls()[0], bodies);
    }

    void run(int steps) {
        for (int i = 0; i < steps; ++i) {
            world->step(kStep, [&] {
                state = measure();
                worstDeg = std::max(worstDeg, degrees(state.violation));
                worstSeparation = std::max(worstSeparation, state.separationM);
            });
        }
    }

    [[nodiscard]] ConstraintState measure() const {
        const std::vector<BodyState> bodies = bodiesOf(*world, 0);
        return physics::measureConstraint(profile.constraints[0], bodies[0].worldFromBody, bodies[1].worldFromBody);
    }

    physics::RagdollProfile profile;
    std::unique_ptr<physics::World> world;
    ConstraintState state;
    float worstDeg = 0.0F;
    float worstSeparation = 0.0F;
};

}  // namespace

TEST_CASE("a hinge holds its limits whichever body turns") {
    for (const int body : {0, 1}) {
        for (const float rate : {9.0F, -9.0F}) {
            CAPTURE(body, rate);
            PairRun pair(makePair(physics::HingeLimits{radians(-30), radians(70)}));
            pair.spin(body, {0, 0, rate});
            float reached = 0.0F;
            for (int i = 0; i < 60; ++i) {
                pair.run(1);
                reached = std::max(reached, std::abs(pair.state.hingeAngle));
            }
            const bool towardsUpper = (body == 1) == (rate > 0);
            CHECK(reached > radians(towardsUpper ? 50.0F : 25.0F));
            CHECK(pair.worstDeg < 3.0F);
            CHECK(pair.worstSeparation < 2e-3F);
        }
    }
}

TEST_CASE("a hinge turns about its own axis only") {
    PairRun pair(makePair(physics::HingeLimits{radians(-120), radians(120)}));
    pair.spin(1, {4, 6, 1});
    float crooked = 0.0F;
    for (int i = 0; i < 60; ++i) {
        pair.run(1);
        const std::vector<BodyState> bodies = bodiesOf(*pair.world, 0);
        const physics::ConstraintProfile& hinge = pair.profile.constraints[0];
        const vec3 parentZ = bodies[0].worldFromBody.rotation * hinge.parentFromFrame.rotation * vec3(0, 0, 1);
        const vec3 childZ = bodies[1].worldFromBody.rotation * hinge.childFromFrame.rotation * vec3(0, 0, 1);
        crooked = std::max(crooked, glm::length(glm::cross(parentZ, childZ)));
    }
    CHECK(crooked < radians(2));
}

TEST_CASE("a cone-twist holds when the child is twisted to its limit and then swung, in both body orders") {
    for (const int body : {0, 1}) {
        for (const vec3& swing : {vec3(0, 8, 0), vec3(0, -8, 0), vec3(0, 0, 8), vec3(0, 6, 6)}) {
            CAPTURE(body, swing.y, swing.z);
            PairRun pair(makePair(physics::ConeTwistLimits{radians(80), radians(20), radians(35)}));
            pair.spin(body, {12, 0, 0});
            pair.run(20);
            CHECK(std::abs(pair.state.twist) > radians(10));
            pair.spin(body, swing);
            pair.run(60);
            CHECK(pair.worstDeg < 3.0F);
            CHECK(pair.worstSeparation < 2e-3F);
        }
    }
}

TEST_CASE("a wide cone lets the child swing as far as its limit") {
    PairRun pair(makePair(physics::ConeTwistLimits{radians(80), radians(20), radians(35)}));
    pair.spin(1, {0, 5, 0});  // against each other: the pair as a whole does not turn
    pair.spin(0, {0, -5, 0});
    float reached = 0.0F;
    for (int i = 0; i < 30; ++i) {
        pair.run(1);
        reached = std::max(reached, glm::length(pair.state.swing));
    }
    CHECK(degrees(reached) > 70.0F);
    CHECK(degrees(reached) < 83.0F);
}

// Its stops on both sides held by turns, and were only as stiff as the two bodies are heavy.
TEST_CASE("a joint whose range has no width does not turn") {
    for (const int body : {0, 1}) {
        for (const vec3& rate : {vec3(12, 0, 0), vec3(0, 12, 0), vec3(0, 0, 12), vec3(-7, 7, 7)}) {
            CAPTURE(body, rate.x, rate.y, rate.z);
            PairRun cone(makePair(physics::ConeTwistLimits{0.001F, 0.001F, 0.001F}));
            cone.spin(body, rate);
            cone.run(60);
            CHECK(cone.worstDeg < 0.2F);
            CHECK(cone.worstSeparation < 2e-3F);
            PairRun hinge(makePair(physics::HingeLimits{0.0F, 0.0F}));
            hinge.spin(body, rate);
            hinge.run(60);
            CHECK(hinge.worstDeg < 0.2F);
        }
    }
}

TEST_CASE("a hinge that is locked elsewhere than where it starts comes there") {
    PairRun pair(makePair(physics::HingeLimits{radians(40), radians(40)}));
    pair.run(60);
    CHECK(degrees(pair.state.hingeAngle) == Approx(40.0F).margin(0.2));
    pair.spin(1, {0, 0, 9});
    pair.run(60);
    CHECK(degrees(pair.state.hingeAngle) == Approx(40.0F).margin(0.2));
    CHECK(pair.worstSeparation < 2e-3F);
}
