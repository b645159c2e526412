#include "scene/puppet/puppet_cast.hpp"

#include <algorithm>

#include "scene/measure/report.hpp"
#include "scene/puppet/floor_keeper.hpp"
#include "scene/run/simulation.hpp"
#include "support/catch.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using physics::MusclePreset;
using physics::Role;
using physics::SolverKind;
using scene::PuppetPlay;

namespace {

const scene::RagdollAsset& mannequin() {
    static const auto asset = scene::loadRagdoll(std::filesystem::path(LUTKA_ASSETS_DIR) / "models/mannequin.glb");
    REQUIRE(asset);
    return *asset.value();
}

// The figure on level ground, where its clip puts it.
scene::Scenario ground(int dolls = 1) {
    scene::Scenario scenario;
    scenario.statics.emplace_back();
    for (int i = 0; i < dolls; ++i) {
        scene::Placement& placement = scenario.dolls.emplace_back();
        placement.worldFromModel.translation.x = 2.0F * static_cast<float>(i);
    }
    return scenario;
}

std::unique_ptr<scene::Simulation> simulate(const PuppetPlay& play, SolverKind solver, float seconds, int dolls = 1) {
    scene::SimulationOptions options;
    options.world.solver = solver;
    options.puppet = play;
    auto simulation = scene::Simulation::create(mannequin(), ground(dolls), options);
    REQUIRE(simulation);
    for (int i = 0; i < static_cast<int>(seconds * 60.0F); ++i)
        simulation.value()->step();
    return std::move(simulation).value();
}

}  // namespace

TEST_CASE("a pinned puppet walks within two degrees of its clip, its pelvis within two centimetres") {
    for (const SolverKind solver : {SolverKind::crowd, SolverKind::bullet}) {
        INFO(physics::solverName(solver));
        PuppetPlay play;
        play.start.clip = "walk";
        const auto simulation = simulate(play, solver, 4.0F);
        const scene::PuppetFigures figures = simulation->puppets()->figures();
        INFO(figures.rmsDeg << " rms, " << figures.maxDeg << " at most at " << figures.worstJoint << ", root "
                            << figures.rootM << " m");
        CHECK(figures.rmsDeg <= 2.0F);
        CHECK(figures.rootM <= 0.02F);
        CHECK(figures.knockOuts == 0);
        CHECK(simulation->quality().nonFinite == 0);
        CHECK(simulation->quality().jointSeparationM.max < 0.01F);
    }
}

TEST_CASE("a walking figure whose bodies follow the clip themselves is let go of with the velocities of its frames") {
    for (const SolverKind solver : {SolverKind::crowd, SolverKind::bullet}) {
        INFO(physics::solverName(solver));
        PuppetPlay play;
        play.start.clip = "walk";
        play.led = {{"all", 1.0F}};
        const auto simulation = simulate(play, solver, 0.25F);
        scene::PuppetCast& cast = *simulation->puppets();
        for (int step = 0; step < 60; ++step)
            simulation->step();
        const auto first = cast.pose(0, 0.0F);
        const std::vector<RigidTransform> from(first.begin(), first.end());
        const auto to = cast.pose(0);
        cast.puppet(0).goLimp();
        std::vector<physics::BodyState> bodies(to.size());
        simulation->world().getBodies(cast.puppet(0).doll(), bodies);
        for (std::size_t i = 0; i < to.size(); ++i) {
            const vec3 frame = (to[i].translation - from[i].translation) * 60.0F;
            INFO(mannequin().profile.bodies[i].name << " at " << glm::length(frame) << " m/s");
            CHECK(glm::distance(bodies[i].linearVelocity, frame) <= 0.01F * std::max(glm::length(frame), 0.1F));
        }
    }
}

TEST_CASE("a clip that puts feet into the floor walks on it: neither in it nor over it") {
    PuppetPlay play;
    play.start.clip = "walk";
    const auto simulation = simulate(play, SolverKind::crowd, 0.1F);
    const scene::FloorKeeper floor(mannequin());
    const int left = physics::bodyOf(mannequin().profile, Role::leftFoot);
    const int right = physics::bodyOf(mannequin().profile, Role::rightFoot);
    float lowest = 1.0F;
    float highest = -1.0F;
    for (int i = 0; i < 120; ++i) {
        simulation->step();
        const auto pose = simulation->puppets()->pose(0);
        const float stands = std::min(floor.lowestOf(left, pose[left]), floor.lowestOf(right, pose[right]));
        lowest = std::min(lowest, stands);
        highest = std::max(highest, stands);
    }
    CHECK(lowest > -0.002F);
    CHECK(highest < 0.02F);
}

TEST_CASE("the pose that a puppet follows is told in the course of a step as its bodies are") {
    PuppetPlay play;
    play.start.clip = "walk";
    const auto simulation = simulate(play, SolverKind::crowd, 1.0F);
    scene::PuppetCast& cast = *simulation->puppets();
    const int foot = physics::bodyOf(mannequin().profile, Role::leftFoot);
    const vec3 end = cast.pose(0)[foot].translation;
    const vec3 begin = cast.pose(0, 0.0F)[foot].translation;
    CHECK(glm::distance(begin, end) > 1e-4F);
    CHECK(glm::distance(cast.pose(0, 1.0F)[foot].translation, end) < 1e-6F);
    CHECK(glm::distance(cast.pose(0, 0.5F)[foot].translation, 0.5F * (begin + end)) < 1e-5F);
    simulation->step();
    CHECK(glm::distance(cast.pose(0, 0.0F)[foot].translation, end) < 1e-6F);
}

TEST_CASE("puppets run the same bits again, after a reset as well") {
    PuppetPlay play;
    play.start.clip = "walk";
    play.hits = {{"upperChest", 0.5F, {0, 0, -15}}};
    const auto one = simulate(play, SolverKind::crowd, 2.0F, 3);
    const auto other = simulate(play, SolverKind::crowd, 2.0F, 3);
    CHECK(one->stateHash() == other->stateHash());
    other->reset();
    for (int i = 0; i < 120; ++i)
        other->step();
    CHECK(one->stateHash() == other->stateHash());
}

TEST_CASE("a hit shows, passes and is told, one too much knocks the puppet out") {
    PuppetPlay play;
    play.start.clip = "idle";
    play.hits = {{"leftLowerArm", 0.5F, {0, 0, 10}}};
    const auto hit = simulate(play, SolverKind::crowd, 2.5F);
    CHECK(hit->puppets()->figures().maxDeg > 15.0F);
    CHECK(hit->puppets()->figures().recoverySeconds > 0.1F);
    CHECK(hit->puppets()->figures().recoverySeconds < 1.0F);
    CHECK(hit->puppets()->figures().knockOuts == 0);
    play.hits = {{"hips", 0.5F, {0, 0, 500}}, {"upperChest", 0.5F, {0, 0, 300}}};
    const auto out = simulate(play, SolverKind::crowd, 2.5F);
    CHECK(out->puppets()->figures().knockOuts == 1);
    CHECK(out->puppets()->figures().limp == 1);
    CHECK(scene::reportText(*out).find("knocked out") != std::string::npos);
}

TEST_CASE("a hit on a part of the trunk without a body meets the next body below") {
    PuppetPlay play;
    play.start.clip = "idle";
    play.hits = {{"spine", 0.2F, {0, 0, -40}}};
    const auto spine = simulate(play, SolverKind::crowd, 0.5F);
    REQUIRE(physics::bodyOf(mannequin().profile, Role::chest) < 0);
    play.hits.front().body = "chest";
    CHECK(simulate(play, SolverKind::crowd, 0.5F)->stateHash() == spine->stateHash());
    play.hits.clear();
    CHECK(simulate(play, SolverKind::crowd, 0.5F)->stateHash() != spine->stateHash());
}

TEST_CASE("kinematic legs walk as the clip does while the limp upper body hangs") {
    for (const SolverKind solver : {SolverKind::crowd, SolverKind::bullet}) {
        INFO(physics::solverName(solver));
        PuppetPlay play;
        play.start.clip = "walk";
        play.puppet.muscles = physics::musclesOf(MusclePreset::limp);
        play.led = {{"hips", 1.0F}, {"leg", 1.0F}};
        const auto simulation = simulate(play, solver, 3.0F);
        const scene::PuppetFigures figures = simulation->puppets()->figures();
        INFO("led bodies off by " << figures.ledM << " m, joints by " << figures.maxDeg << " degrees");
        CHECK(figures.ledM < 0.002F);
        CHECK(figures.maxDeg > 30.0F);  // the upper body does as it likes
        CHECK(figures.limp == 0);
        CHECK(simulation->quality().nonFinite == 0);
        CHECK(simulation->world().caught().empty());
    }
    PuppetPlay wrong;
    wrong.start.clip = "walk";
    wrong.led = {{"tentacle", 1.0F}};
    scene::SimulationOptions options;
    options.puppet = wrong;
    const auto refused = scene::Simulation::create(mannequin(), ground(), options);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message.find("tentacle") != std::string::npos);
    options.puppet->led = {{"hips", 1.0F}};
    options.world.solver = SolverKind::stock;
    const auto stock = scene::Simulation::create(mannequin(), ground(), options);
    REQUIRE_FALSE(stock);
    CHECK(stock.error().message.find("can't lead bodies") != std::string::npos);
}

TEST_CASE("a profile's own muscles and pins are used where nothing else is asked for") {
    auto asset = scene::loadRagdoll(std::filesystem::path(LUTKA_ASSETS_DIR) / "models/mannequin.glb");
    REQUIRE(asset);
    scene::RagdollAsset& own = *asset.value();
    own.profile.muscles = physics::muscleProfileOf(MusclePreset::weak);
    own.profile.bodies[0].pinForceN = 500.0F;
    scene::SimulationOptions options;
    options.puppet.emplace().start.clip = "walk";
    const auto settingsOf = [&](bool ownMuscles, std::optional<float> pin) {
        options.puppet->ownMuscles = ownMuscles;
        options.puppet->pinForceN = pin;
        const auto simulation = scene::Simulation::create(own, ground(), options);
        REQUIRE(simulation);
        return simulation.value()->puppets()->settingsOfFirst();
    };
    CHECK(settingsOf(true, {}).muscles.frequencyHz == 1.5F);
    CHECK(settingsOf(true, {}).pinForceN == 500.0F);
    CHECK(settingsOf(false, {}).muscles.frequencyHz == 10.0F);
    CHECK(settingsOf(false, 50.0F).pinForceN == 50.0F);
}

TEST_CASE("a clip that is not there is an error that names those that are") {
    scene::SimulationOptions options;
    options.puppet.emplace().start.clip = "dance";
    const auto refused = scene::Simulation::create(mannequin(), ground(), options);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code == ErrorCode::usage);
    CHECK(refused.error().message.find("dance") != std::string::npos);
    CHECK(refused.error().mend.find("walk") != std::string::npos);
}

TEST_CASE("a limp doll that goes on in a simulation made anew was not knocked out once more") {
    PuppetPlay play;
    play.start.clip = "idle";
    const auto simulation = simulate(play, SolverKind::crowd, 0.2F);
    scene::PuppetCast& cast = *simulation->puppets();
    cast.puppet(0).goLimp();
    REQUIRE(cast.figures().knockOuts == 1);
    const scene::PuppetMemory memory = cast.memoryOf(0);
    simulation->reset();
    cast.resume(0, memory);
    CHECK(cast.puppet(0).state() == physics::PuppetState::limp);
    CHECK(cast.figures().knockOuts == 0);
}

TEST_CASE("a body's own strength counts where the profile says nothing of the whole doll's") {
    auto asset = scene::loadRagdoll(std::filesystem::path(LUTKA_ASSETS_DIR) / "models/mannequin.glb");
    REQUIRE(asset);
    const int hand = physics::bodyOf(asset.value()->profile, Role::leftHand);
    asset.value()->profile.bodies[hand].muscle.strength = 0.25F;
    scene::SimulationOptions options;
    options.puppet.emplace();
    options.puppet->start.clip = "idle";
    const auto strengthOf = [&](bool own) {
        options.puppet->ownMuscles = own;
        auto simulation = scene::Simulation::create(*asset.value(), ground(), options);
        REQUIRE(simulation);
        return physics::strengthOf(simulation.value()->puppets()->settingsOfFirst().muscles, asset.value()->profile,
                                   hand);
    };
    CHECK(strengthOf(true) == 0.25F);
    CHECK(strengthOf(false) == 1.0F);
}

TEST_CASE("what strikes a foot from above is no ground to stand on") {
    // In the air, without gravity: nothing may change by a puppet's wish to balance.
    const auto hashOf = [](bool balances) {
        scene::Scenario scenario = ground();
        scenario.statics.clear();
        const int foot = physics::bodyOf(mannequin().profile, Role::leftFoot);
        physics::DynamicProp& ball = scenario.props.emplace_back();
        ball.shape.kind = physics::BodyShape::Kind::sphere;
        ball.shape.radius = 0.05F;
        ball.massKg = 2.0F;
        ball.state.worldFromBody.translation =
            mannequin().rig.bindModelFromBody[foot].translation + vec3(0, 0.3F, 0.1F);
        ball.state.linearVelocity = vec3(0, -2.0F, 0);
        scene::SimulationOptions options;
        options.world.gravity = vec3(0);
        options.puppet.emplace();
        options.puppet->start.clip = "idle";
        options.puppet->pinForceN = 0.0F;
        options.puppet->puppet.balances = balances;
        auto simulation = scene::Simulation::create(mannequin(), scenario, options);
        REQUIRE(simulation);
        bool struck = false;
        for (int i = 0; i < 40; ++i) {
            simulation.value()->step();
            struck = struck || !simulation.value()->world().contactReports().empty();
        }
        REQUIRE(struck);
        return simulation.value()->stateHash();
    };
    CHECK(hashOf(true) == hashOf(false));
}
