#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "crowd_scene.hpp"
#include "physics/crowd/substeps.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::createCrowdWorld;
using physics::WorldSettings;

TEST_CASE("a step has as many substeps as its motion needs") {
    physics::crowd::CrowdTuning tuning;
    tuning.angularDamping = 0.0F;
    WorldSettings settings;
    settings.sleeping = GENERATE(true, false);
    CAPTURE(settings.sleeping);
    const auto world = createCrowdWorld(settings, tuning);
    const physics::RagdollProfile rod = makeRod(0.2F, 0.05F, 2.0F);
    world->addDoll(rod, std::vector<physics::BodyState>(1, physics::BodyState{}));
    float speed = 0.0F;
    float fallen = 0.0F;
    for (int i = 0; i < 60; ++i) {
        // Where nothing sleeps, what is still has fewer: here the first step.
        const int least = i == 0 && !settings.sleeping ? tuning.restSubsteps : tuning.calmSubsteps;
        const int substeps =
            std::clamp(static_cast<int>(std::ceil(speed / tuning.substepSpeed)), least, tuning.substeps);
        for (int k = 0; k < substeps; ++k) {
            const float seconds = kStep / static_cast<float>(substeps);
            speed += 9.81F * seconds;
            fallen += speed * seconds;
        }
        world->step(kStep);
        // One substep more or less in any step would be off by 0.1 mm.
        REQUIRE(bodiesOf(*world, 0)[0].worldFromBody.translation.y == Approx(-fallen).margin(2e-5));
    }
}

TEST_CASE("a world with a small figure has as many more substeps as that is smaller, unless it is told how many") {
    const auto substepsWith = [](float heightM, const std::optional<int>& told) {
        WorldSettings settings;
        settings.substeps = told;
        const auto world = createCrowdWorld(settings);
        physics::RagdollProfile rod = makeRod(0.2F, 0.05F, 2.0F);
        rod.heightM = heightM;
        world->addDoll(rod, std::vector<physics::BodyState>(1, physics::BodyState{}));
        return world->substepsPerStep();
    };
    const int own = physics::crowd::CrowdTuning{}.substeps;
    CHECK(substepsWith(1.75F, std::nullopt) == own);
    CHECK(substepsWith(0.75F, std::nullopt) == own);
    CHECK(substepsWith(0.375F, std::nullopt) == 2 * own);
    CHECK(substepsWith(0.01F, std::nullopt) == 4 * own);
    CHECK(substepsWith(0.01F, 5) == 5);
    // Told later is told as well.
    const auto world = createCrowdWorld(WorldSettings{});
    world->setSubsteps(4);
    physics::RagdollProfile rod = makeRod(0.2F, 0.05F, 2.0F);
    rod.heightM = 0.01F;
    world->addDoll(rod, std::vector<physics::BodyState>(1, physics::BodyState{}));
    CHECK(world->substepsPerStep() == 4);
}

TEST_CASE("a few dolls of a calm heap may have fewer substeps than they need, unless many lie deep in each other") {
    using namespace physics::crowd;
    CrowdState state(WorldSettings{}, CrowdTuning{});
    state.stepSubsteps = substepsFor(state, kStep);
    state.dolls.resize(1);  // of which all lanes are
    const Topology topology = makeTopology(makeDoll(), 0.05F);
    std::vector<Batch> batches(5, Batch(topology));
    Job job;
    job.touches.resize(500);
    for (Batch& batch : batches) {
        batch.used = kLanes;
        std::fill(std::begin(batch.substepsOf), std::end(batch.substepsOf), 3);
        job.batches.push_back(&batch);
        job.topologies.push_back(&topology);
    }
    const auto substepsWith = [&](int deepTouches) {
        job.deepTouches = deepTouches;
        setSubsteps(state, job);
        return job.substeps;
    };
    REQUIRE(state.tuning.spared * 40.0F == Approx(8.0F));
    batches[1].substepsOf[3] = 6;
    batches[4].substepsOf[7] = 6;
    CHECK(substepsWith(0) == 3);  // six too few in sum
    const Topology rod = makeTopology(makeRod(0.2F, 0.05F, 2.0F), 0.05F);
    std::fill(job.topologies.begin(), job.topologies.end(), &rod);
    CHECK(substepsWith(0) == 6);  // props count for nothing: a doll among balls is no heap
    std::fill(job.topologies.begin(), job.topologies.end(), &topology);
    batches[2].substepsOf[0] = 6;
    CHECK(substepsWith(0) == 4);  // nine would be
    CHECK(substepsWith(6) == 6);
    state.dolls[0].motors = 1;
    CHECK(substepsWith(0) == 6);  // muscles need their own
    state.dolls[0].motors = 0;
    for (Batch& batch : batches)
        batch.substepsOf[5] = 5;
    CHECK(substepsWith(0) == 5);
    job.batches.resize(1);
    batches[0].used = 4;
    batches[0].substepsOf[1] = 5;
    CHECK(substepsWith(0) == 5);  // of four dolls none may be short
}

TEST_CASE("a pull at its bound gives its force, in all substeps however slow the body is") {
    physics::crowd::CrowdTuning tuning;
    tuning.angularDamping = 0.0F;
    WorldSettings settings;
    settings.gravity = vec3(0);
    const auto world = createCrowdWorld(settings, tuning);
    const physics::RagdollProfile rod = makeRod(0.2F, 0.05F, 2.0F);
    physics::Drag drag;
    drag.doll = world->addDoll(rod, std::vector<physics::BodyState>(1, physics::BodyState{}));
    drag.body = 0;
    drag.worldTarget = {0, 1000, 0};
    drag.maxForceN = 2.0F;
    world->addDrag(drag);
    for (int i = 0; i < 30; ++i)
        world->step(kStep);
    const physics::BodyState body = bodiesOf(*world, 0)[0];
    CHECK(body.linearVelocity.y == Approx(0.5F).epsilon(1e-4));
    // In the fewest substeps it would have come 0.7 mm farther.
    const auto substeps = static_cast<float>(30 * tuning.substeps);
    CHECK(body.worldFromBody.translation.y == Approx(0.125F * (1.0F + 1.0F / substeps)).margin(1e-5));
}

TEST_CASE("a muscle gives the same torque in long and short substeps") {
    const physics::RagdollProfile pair = makePair(physics::HingeLimits{radians(-170), radians(170)});
    const auto turnOf = [&](int calmSubsteps, float maxTorqueNm) {
        physics::crowd::CrowdTuning tuning;
        tuning.angularDamping = 0.0F;
        tuning.calmSubsteps = calmSubsteps;
        WorldSettings settings;
        settings.gravity = vec3(0);
        const auto world = createCrowdWorld(settings, tuning);
        std::vector<physics::BodyState> start(2);
        start[0].worldFromBody = inverse(pair.constraints[0].parentFromFrame);
        start[1].worldFromBody = inverse(pair.constraints[0].childFromFrame);
        const physics::DollId doll = world->addDoll(pair, start);
        physics::JointMotor motor;
        motor.angle = radians(20);
        motor.stiffness = 1.0F;
        motor.damping = 0.1F;
        motor.maxTorqueNm = maxTorqueNm;
        world->setMotor(doll, 0, motor);
        for (int i = 0; i < 20; ++i)
            world->step(kStep);
        const auto bodies = bodiesOf(*world, 0);
        return bodies[1].angularVelocity.z - bodies[0].angularVelocity.z;
    };
    for (const float bound : {0.02F, 100.0F}) {
        INFO(bound << " N m at most");
        CHECK(std::abs(turnOf(6, bound)) > 0.1F);
        CHECK(turnOf(3, bound) == Approx(turnOf(6, bound)).epsilon(0.05));
    }
}

TEST_CASE("what lies in a heap feels nothing of longer and shorter substeps") {
    WorldSettings settings;
    settings.sleeping = false;
    physics::crowd::CrowdTuning tuning;
    tuning.calmSubsteps = tuning.substeps;
    const auto world = createCrowdWorld(settings, tuning);
    std::vector<physics::StaticShape> statics;
    const physics::RagdollProfile profile = makeDoll();
    fillPit(*world, profile, 6, statics);
    const auto fastest = [&] {
        float speed = 0.0F;
        for (int doll = 0; doll < 6; ++doll)
            for (const physics::BodyState& body : bodiesOf(*world, doll))
                speed = std::max(speed, glm::length(body.linearVelocity));
        return speed;
    };
    // For a second: a limb that swings over an edge stands still at every turn.
    int resting = 0;
    for (int i = 0; i < 30 * 60 && resting < 60; ++i) {
        world->step(kStep);
        resting = fastest() < 0.01F ? resting + 1 : 0;
    }
    REQUIRE(resting == 60);
    for (int i = 0; i < 20; ++i) {
        world->setSubsteps(i % 2 == 0 ? 2 : 6);
        world->step(kStep);
        // What contacts carry is fitted to the substep's length: without that it is 14 cm/s.
        CHECK(fastest() < 0.03F);
    }
}

TEST_CASE("watching the substeps changes no bit, however many a step has") {
    const auto hash = [](bool watched) {
        WorldSettings settings;
        settings.sleeping = false;
        const auto world = createCrowdWorld(settings);
        std::vector<physics::StaticShape> statics;
        const physics::RagdollProfile profile = makeDoll();
        fillPit(*world, profile, 9, statics);
        int parts = 0;
        for (int i = 0; i < 240; ++i)
            world->step(kStep, watched ? std::function<void()>([&] { ++parts; }) : std::function<void()>());
        CHECK(parts == (watched ? 240 * world->substepsPerStep() : 0));
        return stateHash(*world);
    };
    CHECK(hash(true) == hash(false));
}
