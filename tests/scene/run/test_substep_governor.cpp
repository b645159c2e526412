#include "scene/run/substep_governor.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "physics/bullet/bullet_world.hpp"
#include "physics/crowd/crowd_world.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"

using lutka::scene::SubstepGovernor;

namespace {

// A machine on which a step with n substeps takes n times `perSubstep` of the real time.
int settled(SubstepGovernor& governor, double perSubstep, int frames, int& changes) {
    for (int frame = 0; frame < frames; ++frame) {
        const int before = governor.substeps();
        if (governor.update(perSubstep * governor.substeps()) != before) ++changes;
    }
    return governor.substeps();
}

}  // namespace

TEST_CASE("a machine that keeps up has all its substeps") {
    SubstepGovernor governor(8);
    int changes = 0;
    CHECK(settled(governor, 0.09, 1000, changes) == 8);
    CHECK(changes == 0);
}

TEST_CASE("a late machine gets as many substeps as fit, at once, and keeps them") {
    SubstepGovernor governor(8);
    int changes = 0;
    CHECK(settled(governor, 0.15, 6, changes) == 4);  // 0.6 of the time; five would be 0.75
    CHECK(settled(governor, 0.15, 2000, changes) == 4);
    CHECK(changes == 1);
}

TEST_CASE("one slow frame changes nothing") {
    SubstepGovernor governor(8);
    for (int i = 0; i < 100; ++i) {
        for (int frame = 0; frame < 5; ++frame)
            CHECK(governor.update(3.0) == 8);
        CHECK(governor.update(0.5) == 8);
    }
}

TEST_CASE("substeps come back one by one when there is room, and never more than there were") {
    SubstepGovernor governor(8);
    int changes = 0;
    settled(governor, 0.5, 20, changes);
    REQUIRE(governor.substeps() == 2);  // not below the least, however late
    changes = 0;
    CHECK(settled(governor, 0.05, 59, changes) == 2);
    CHECK(settled(governor, 0.05, 1, changes) == 3);
    CHECK(settled(governor, 0.05, 2000, changes) == 8);
    CHECK(changes == 6);
}

TEST_CASE("at no steady load do substeps swing back and forth") {
    for (int percent = 1; percent <= 100; ++percent) {
        SubstepGovernor governor(8);
        int changes = 0;
        settled(governor, 0.01 * percent, 500, changes);
        changes = 0;
        settled(governor, 0.01 * percent, 2000, changes);
        INFO(percent);
        CHECK(changes == 0);
    }
}

TEST_CASE("the number of substeps changes while dolls fall and none tears") {
    using namespace lutka;
    const physics::RagdollProfile profile = test::makePair(physics::HingeLimits{-1.0F, 1.0F});
    for (const auto solver : {physics::SolverKind::bullet, physics::SolverKind::crowd}) {
        physics::WorldSettings settings;
        settings.solver = solver;
        const auto world = solver == physics::SolverKind::crowd ? physics::createCrowdWorld(settings)
                                                                : physics::createBulletWorld(settings);
        world->addStatic({});
        std::vector<physics::BodyState> bodies(2);
        bodies[0].worldFromBody.translation = {-0.2F, 1.0F, 0};
        bodies[1].worldFromBody.translation = {0.2F, 1.0F, 0};
        for (std::size_t i = 0; i < 2; ++i)
            bodies[i].worldFromBody.rotation = glm::conjugate(i == 0 ? profile.constraints[0].parentFromFrame.rotation
                                                                     : profile.constraints[0].childFromFrame.rotation);
        const int full = world->substepsPerStep();
        world->addDoll(profile, bodies);
        float worst = 0;
        for (int step = 0; step < 120; ++step) {
            const int wanted = 2 + step % (full - 1);
            world->setSubsteps(wanted);
            int taken = 0;
            world->step(1.0F / 60.0F, [&] { ++taken; });
            CHECK(taken == wanted);
            world->getBodies(world->dolls()[0], bodies);
            const physics::ConstraintProfile& joint = profile.constraints[0];
            worst = std::max(worst, glm::distance(bodies[0].worldFromBody * joint.parentFromFrame.translation,
                                                  bodies[1].worldFromBody * joint.childFromFrame.translation));
        }
        INFO(full);
        CHECK(worst < 0.03F);
    }
}

TEST_CASE("setting the number of substeps that there is changes nothing, in long steps and fast falls either") {
    using namespace lutka;
    const physics::RagdollProfile profile = test::makePair(physics::HingeLimits{-1.0F, 1.0F});
    for (const float dt : {1.0F / 60.0F, 0.05F}) {
        std::vector<physics::BodyState> ends[2];
        for (const bool sets : {false, true}) {
            physics::WorldSettings settings;
            settings.solver = physics::SolverKind::crowd;
            const auto world = physics::createCrowdWorld(settings);
            world->addStatic({});
            std::vector<physics::BodyState> bodies(2);
            bodies[0].worldFromBody.translation = {-0.2F, 1.0F, 0};
            bodies[1].worldFromBody.translation = {0.2F, 1.0F, 0};
            for (std::size_t i = 0; i < 2; ++i) {
                bodies[i].worldFromBody.rotation =
                    glm::conjugate(i == 0 ? profile.constraints[0].parentFromFrame.rotation
                                          : profile.constraints[0].childFromFrame.rotation);
                bodies[i].linearVelocity = {0, -60.0F, 0};
            }
            world->addDoll(profile, bodies);
            for (int step = 0; step < 20; ++step) {
                if (sets) world->setSubsteps(world->substepsPerStep());
                world->step(dt);
            }
            ends[sets ? 1 : 0].resize(2);
            world->getBodies(world->dolls()[0], ends[sets ? 1 : 0]);
        }
        INFO(dt);
        for (std::size_t i = 0; i < 2; ++i)
            CHECK(ends[0][i].worldFromBody.translation == ends[1][i].worldFromBody.translation);
    }
}
