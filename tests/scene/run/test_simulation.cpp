#include "scene/run/simulation.hpp"

#include <array>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>

#include "animation/pose.hpp"
#include "physics/collision/shape.hpp"
#include "scene/asset/body_bounds.hpp"
#include "scene/asset/figure_bounds.hpp"
#include "scene/run/bake.hpp"
#include "support/catch.hpp"
#include "support/counting_new.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using namespace lutka::scene;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::unique_ptr<Simulation> start(const RagdollAsset& asset, std::string_view name,
                                  const SimulationOptions& options = {}, int count = 1, std::uint64_t seed = 0) {
    auto scenario = makeScenario({.name = name, .count = count, .seed = seed}, asset);
    REQUIRE(scenario);
    auto simulation = Simulation::create(asset, std::move(scenario).value(), options);
    REQUIRE(simulation);
    return std::move(simulation).value();
}

// A figure whose arms end in forearms as long as its thighs and shins together.
std::unique_ptr<RagdollAsset> withLongForearms() {
    std::vector<test::JointSpec> joints{{"hips", -1, {0, 0.95F, 0}},
                                        {"spine", 0, {0, 1.05F, 0}},
                                        {"chest", 1, {0, 1.20F, 0}},
                                        {"neck", 2, {0, 1.48F, 0}},
                                        {"head", 3, {0, 1.56F, 0}}};
    std::vector<test::TubeSpec> tubes{{0, {0, 0.85F, 0}, 0.15F},
                                      {1, {0, 1.20F, 0}, 0.13F},
                                      {2, {0, 1.45F, 0}, 0.15F},
                                      {3, {0, 1.56F, 0}, 0.06F},
                                      {4, {0, 1.75F, 0}, 0.09F}};
    for (const float side : {1.0F, -1.0F}) {
        const std::string name = side > 0 ? "left" : "right";
        const auto add = [&](const char* role, int parent, const vec3& at, const vec3& end, float radius) {
            const vec3 across(side, 1, 1);
            joints.push_back({name + role, parent, across * at});
            tubes.push_back({static_cast<int>(joints.size()) - 1, across * end, radius});
            return static_cast<int>(joints.size()) - 1;
        };
        const int upperArm = add("UpperArm", 2, {0.18F, 1.42F, 0}, {0.46F, 1.42F, 0}, 0.05F);
        add("LowerArm", upperArm, {0.46F, 1.42F, 0}, {1.26F, 1.42F, 0}, 0.04F);
        const int thigh = add("UpperLeg", 0, {0.10F, 0.90F, 0}, {0.10F, 0.50F, 0}, 0.08F);
        const int shin = add("LowerLeg", thigh, {0.10F, 0.50F, 0}, {0.10F, 0.09F, 0}, 0.055F);
        add("Foot", shin, {0.10F, 0.09F, 0}, {0.10F, 0.03F, 0.18F}, 0.04F);
    }
    auto asset = makeRagdoll(test::makeFigure("long forearms", joints, tubes));
    if (!asset) FAIL(asset.error().text());
    REQUIRE(physics::bodyOf(asset.value()->profile, physics::Role::leftHand) < 0);
    return std::move(asset).value();
}

// A clip of the biped: everything turns about Y at `speed` rad/s and moves along X at 2 m/s.
void addTurningClip(animation::Character& character, float speed) {
    animation::Clip clip{"turn", 60.0F, 61, {}, {}};
    for (int frame = 0; frame < clip.frameCount; ++frame) {
        const float t = static_cast<float>(frame) / clip.framesPerSecond;
        std::vector<RigidTransform> pose = character.skeleton.nodeParentFromJoint;
        pose[0] = RigidTransform{glm::angleAxis(speed * t, vec3(0, 1, 0)), {2.0F * t, 0, 0}} * pose[0];
        clip.parentFromJoint.append(pose);
    }
    character.clips.push_back(clip);
}

}  // namespace

TEST_CASE("a doll that was dropped lies on the floor, finite and at rest") {
    const auto asset = test::bipedRagdoll();
    const auto simulation = start(*asset, "drop");
    for (int step = 0; step < 360; ++step)
        simulation->step();
    const physics::Quality quality = simulation->quality();
    CHECK(quality.nonFinite == 0);
    CHECK(quality.residualSpeedMps < 0.01F);
    CHECK(quality.settleSeconds.has_value());
    for (const RigidTransform& body : simulation->worldFromBody(0)) {
        CHECK(body.translation.y < 0.6F);
        CHECK(body.translation.y > 0.0F);
    }
}

TEST_CASE("the first frame of a simulation shows the bind pose where the scenario put it") {
    const auto asset = test::bipedRagdoll();
    const auto simulation = start(*asset, "drop");
    const animation::Skeleton& skeleton = asset->character.skeleton;
    std::vector<RigidTransform> pose(skeleton.parents.size());
    simulation->pose(0, 1.0F, pose);
    for (std::size_t joint = 0; joint < pose.size(); ++joint) {
        CHECK(glm::distance(pose[joint].translation, skeleton.bindModelFromJoint[joint].translation) < 1e-4F);
    }
}

TEST_CASE("the same simulation gives the same bits, also after a reset") {
    const auto asset = test::bipedRagdoll();
    const auto hashes = [&](Simulation& simulation) {
        std::vector<std::uint64_t> all;
        for (int step = 0; step < 90; ++step) {
            simulation.step();
            if (step % 30 == 29) all.push_back(simulation.stateHash());
        }
        return all;
    };
    const auto a = start(*asset, "stairs", {}, 2, 3);
    const auto b = start(*asset, "stairs", {}, 2, 3);
    const auto first = hashes(*a);
    CHECK(first == hashes(*b));
    a->reset();
    CHECK(a->steps() == 0);
    CHECK(first == hashes(*a));
    const auto other = start(*asset, "stairs", {}, 2, 4);
    CHECK(first != hashes(*other));
}

TEST_CASE("measuring does not change the simulation") {
    const auto asset = test::bipedRagdoll();
    SimulationOptions silent;
    silent.measure = false;
    const auto measured = start(*asset, "drop", {}, 1, 2);
    const auto unmeasured = start(*asset, "drop", silent, 1, 2);
    for (int step = 0; step < 60; ++step) {
        measured->step();
        unmeasured->step();
    }
    CHECK(measured->stateHash() == unmeasured->stateHash());
}

TEST_CASE("steps and poses of a simulation that does not measure allocate nothing once it has been at work") {
    const auto asset = test::bipedRagdoll();
    for (const int threads : {1, 2}) {
        INFO(threads << " threads");
        SimulationOptions options;
        options.measure = false;
        options.world.threads = threads;
        options.world.sleeping = false;
        const auto simulation = start(*asset, "pile", options, 4);
        const auto stepAndPose = [&] {
            simulation->step();
            return simulation->poseSkins(0.5F).posed();
        };
        for (int step = 0; step < 300; ++step)
            static_cast<void>(stepAndPose());
        const std::size_t before = test::allocationCount();
        int posed = 0;
        for (int step = 0; step < 120; ++step)
            posed += stepAndPose();
        CHECK(test::allocationCount() == before);
        CHECK(posed > 0);
    }
}

TEST_CASE("a fall from a clip starts with the clip's own velocities") {
    constexpr float speed = 1.5F;
    animation::Character character = test::makeBiped();
    addTurningClip(character, speed);
    auto asset = makeRagdoll(std::move(character));
    REQUIRE(asset);
    SimulationOptions options;
    options.fromClip = ClipStart{"turn", 0.5F};
    const auto simulation = start(*asset.value(), "drop", options);
    std::vector<physics::BodyState> bodies(asset.value()->profile.bodies.size());
    simulation->world().getBodies(simulation->world().dolls()[0], bodies);
    const quat worldFromModel = simulation->worldFromModel(0).rotation;
    const vec3 turn = worldFromModel * vec3(0, speed, 0);
    const vec3 slide = worldFromModel * vec3(2, 0, 0);
    // The clip turns about the model's own vertical axis, which has slid 1 m along X at half a second.
    const vec3 centre = simulation->worldFromModel(0) * vec3(1, 0, 0);
    for (const physics::BodyState& body : bodies) {
        const vec3 expected = slide + glm::cross(turn, body.worldFromBody.translation - centre);
        CHECK(glm::distance(body.linearVelocity, expected) < 0.01F);
        CHECK(glm::distance(body.angularVelocity, turn) < 0.01F);
    }
}

TEST_CASE("a clip that is not there is a usage error that lists those that are") {
    animation::Character character = test::makeBiped();
    addTurningClip(character, 1.0F);
    const auto asset = makeRagdoll(std::move(character));
    REQUIRE(asset);
    SimulationOptions options;
    options.fromClip = ClipStart{"run", 0.0F};
    auto scenario = makeScenario({.name = "drop"}, Figure{{vec3(-1), vec3(1)}});
    REQUIRE(scenario);
    const auto simulation = Simulation::create(*asset.value(), std::move(scenario).value(), options);
    REQUIRE_FALSE(simulation);
    CHECK(simulation.error().code == ErrorCode::usage);
    CHECK(simulation.error().mend.find("turn") != std::string::npos);
}

TEST_CASE("what can't be simulated is refused with all that is wrong with it, and nothing is touched") {
    struct Run {
        Scenario scenario;
        SimulationOptions options;
    };
    struct Fault {
        const char* told;
        std::function<void(Run&)> make;
    };
    const std::array faults{
        Fault{"a step of 0 s", [](Run& run) { run.options.dt = 0.0F; }},
        Fault{"a step of nan s", [](Run& run) { run.options.dt = kNan; }},
        Fault{"gravity is not finite", [](Run& run) { run.options.world.gravity.y = kNan; }},
        Fault{"substeps is 0", [](Run& run) { run.options.world.substeps = 0; }},
        Fault{"iterations is 5000", [](Run& run) { run.options.world.iterations = 5000; }},
        Fault{"linear damping is 1", [](Run& run) { run.options.world.linearDamping = 1.0F; }},
        Fault{"angular damping is nan", [](Run& run) { run.options.world.angularDamping = kNan; }},
        Fault{"the eye is not finite", [](Run& run) { run.options.eye = vec3(kNan); }},
        Fault{"can't be spared",
              [](Run& run) {
                  run.options.puppet.emplace();
                  run.options.shed.lodFrom = 10.0F;
              }},
        Fault{"doll 0 is of asset 1 of 1", [](Run& run) { run.scenario.dolls[0].asset = 1; }},
        Fault{"doll 0 is of asset -1 of 1", [](Run& run) { run.scenario.dolls[0].asset = -1; }},
        Fault{"doll 0 stands nowhere",
              [](Run& run) { run.scenario.dolls[0].worldFromModel.rotation = quat(0, 0, 0, 0); }},
        Fault{"doll 0 has a velocity", [](Run& run) { run.scenario.dolls[0].linearVelocity.x = kNan; }},
        Fault{"the strength of doll 0", [](Run& run) { run.scenario.dolls[0].strength = -1.0F; }},
        Fault{"a pin holds doll 7 of 1",
              [](Run& run) {
                  run.scenario.pins.push_back({7, "head"});
              }},
        Fault{"-3 threads", [](Run& run) { run.options.world.threads = -3; }},
        Fault{"static shape 0 stands nowhere",
              [](Run& run) { run.scenario.statics[0].worldFromShape.translation.y = kNan; }},
        Fault{"static shape 0 stands nowhere",
              [](Run& run) { run.scenario.statics[0].worldFromShape.rotation = quat(0, 0, 0, 0); }},
        Fault{"static shape 0: the mesh is null",
              [](Run& run) { run.scenario.statics[0].kind = physics::StaticShape::Kind::mesh; }},
        Fault{"static shape 0: place, size or friction", [](Run& run) { run.scenario.statics[0].friction = -1.0F; }},
        Fault{"static shape 0: place, size or friction",
              [](Run& run) {
                  run.scenario.statics[0].kind = physics::StaticShape::Kind::sphere;
                  run.scenario.statics[0].radius = kNan;
              }},
        Fault{"prop 1 stands nowhere",
              [](Run& run) {
                  run.scenario.props.resize(2);
                  run.scenario.props[1].state.worldFromBody.translation.x = kNan;
              }},
        Fault{"prop 0: the state is not finite or the mass",
              [](Run& run) { run.scenario.props.emplace_back().massKg = 0.0F; }},
        Fault{"prop 0: the state is not finite",
              [](Run& run) { run.scenario.props.emplace_back().state.linearVelocity.z = kNan; }},
        Fault{"prop 0: the shape has no size", [](Run& run) { run.scenario.props.emplace_back().shape.radius = kNan; }},
        Fault{"prop 0: the shape has no size",
              [](Run& run) { run.scenario.props.emplace_back().shape.kind = physics::BodyShape::Kind::hull; }},
        Fault{"a hit is on doll 4 of 1",
              [](Run& run) {
                  run.scenario.hits.push_back({"chest", 0.0F, vec3(1), 4});
              }},
        Fault{"a hit's time or impulse",
              [](Run& run) {
                  run.scenario.hits.push_back({"chest", 0.0F, vec3(kNan), -1});
              }},
        Fault{"a hit's time or impulse",
              [](Run& run) {
                  run.options.puppet.emplace().hits.push_back({"chest", -1.0F, vec3(1), 0});
              }},
    };
    const auto asset = test::bipedRagdoll();
    for (const Fault& fault : faults) {
        INFO(fault.told);
        Run run{makeScenario({.name = "drop"}, *asset).value(), {}};
        fault.make(run);
        const auto refused = Simulation::create(*asset, std::move(run.scenario), run.options);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().code == ErrorCode::usage);
        CHECK(refused.error().message.find(fault.told) != std::string::npos);
        CHECK(refused.error().message.find(';') == std::string::npos);  // nothing else
    }
    Scenario scenario = makeScenario({.name = "drop"}, *asset).value();
    const std::vector<const RagdollAsset*> assets{asset.get(), nullptr};
    scenario.dolls[0].asset = 5;
    const auto refused = Simulation::create(assets, std::move(scenario), {});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message == "asset 1 is null; doll 0 is of asset 5 of 2");
    CHECK(Simulation::create(std::vector<const RagdollAsset*>{}, {}, {}).error().message == "there is no asset");
}

TEST_CASE("all of the damping that the settings allow is taken, and no more") {
    const auto asset = test::bipedRagdoll();
    SimulationOptions options;
    options.world.linearDamping = 0.9995F;
    options.world.angularDamping = 0.9995F;
    const auto simulation = start(*asset, "drop", options);
    for (int step = 0; step < 30; ++step)
        simulation->step();
    CHECK(simulation->quality().nonFinite == 0);
    options.world.linearDamping = 1.0F;
    const auto refused = Simulation::create(*asset, makeScenario({.name = "drop"}, *asset).value(), options);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message == "linear damping is 1, not in [0, 1)");
}

TEST_CASE("a clip whose name ends in a number after @ is found by its whole name") {
    animation::Character character = test::makeBiped();
    addTurningClip(character, 1.0F);
    character.clips.front().name = "a@b@1";
    const auto asset = makeRagdoll(std::move(character));
    REQUIRE(asset);
    const auto startsAt = [&](const ClipStart& clip) {
        SimulationOptions options;
        options.fromClip = clip;
        auto scenario = makeScenario({.name = "drop"}, Figure{{vec3(-1), vec3(1)}});
        REQUIRE(scenario);
        return Simulation::create(*asset.value(), std::move(scenario).value(), options).ok();
    };
    CHECK(startsAt({"a@b", 1.0F}));  // as a command line reads it
    CHECK(startsAt({"a@b@1", 0.0F}));
    CHECK_FALSE(startsAt({"a@b", 0.5F}));
}

TEST_CASE("drawing between two steps is between their states") {
    const auto asset = test::bipedRagdoll();
    const auto simulation = start(*asset, "drop");
    for (int step = 0; step < 20; ++step)
        simulation->step();
    const vec3 before = simulation->worldFromBody(0, 0.0F)[0].translation;
    const vec3 middle = simulation->worldFromBody(0, 0.5F)[0].translation;
    const vec3 after = simulation->worldFromBody(0, 1.0F)[0].translation;
    CHECK(before.y > after.y);
    CHECK(glm::distance(middle, (before + after) * 0.5F) < 1e-5F);
}

TEST_CASE("a baked clip shows the poses that the simulation had") {
    const auto asset = test::bipedRagdoll();
    const auto simulation = start(*asset, "drop");
    ClipBaker baker(0, 60.0F, "fall");
    baker.sample(*simulation);
    for (int step = 0; step < 30; ++step) {
        simulation->step();
        baker.sample(*simulation);
    }
    const animation::Clip& clip = baker.clip();
    REQUIRE(clip.frameCount == 31);
    CHECK(clip.seconds() == Approx(0.5F));
    const animation::Skeleton& skeleton = asset->character.skeleton;
    std::vector<RigidTransform> baked(skeleton.parents.size());
    std::vector<RigidTransform> live(skeleton.parents.size());
    animation::sampleClip(clip, clip.seconds(), baked);
    animation::localToModel(skeleton, baked, baked);
    simulation->pose(0, 1.0F, live);
    for (std::size_t joint = 0; joint < live.size(); ++joint) {
        CHECK(glm::distance(baked[joint].translation, live[joint].translation) < 1e-4F);
    }
}

TEST_CASE("a doll that hangs by its hand stays up") {
    const auto asset = test::bipedRagdoll();
    const auto simulation = start(*asset, "hang");
    const int hand = physics::bodyOf(asset->profile, physics::Role::leftHand);
    const vec3 held = simulation->worldFromBody(0)[hand].translation;
    for (int step = 0; step < 240; ++step)
        simulation->step();
    CHECK(glm::distance(simulation->worldFromBody(0)[hand].translation, held) < 0.25F);
    const int foot = physics::bodyOf(asset->profile, physics::Role::leftFoot);
    CHECK(simulation->worldFromBody(0)[foot].translation.y > 0.2F);
}

// By a hand that is low beside the hips a figure hangs by a whole height more than it stands; and by half a body more
// where its arm ends in a long forearm, which is held by the tip.
TEST_CASE("a figure hangs clear of the floor, by hands that are low and by the tips of long forearms") {
    std::vector<std::unique_ptr<RagdollAsset>> assets;
    auto mannequin = scene::loadRagdoll(LUTKA_ASSETS_DIR "/models/mannequin.glb");
    REQUIRE(mannequin);
    const scene::FigureBounds bounds = scene::figureBounds(mannequin.value()->profile, mannequin.value()->rig);
    CHECK(bounds.handReach > bounds.high.y - bounds.low.y);
    assets.push_back(std::move(mannequin).value());
    assets.push_back(withLongForearms());
    for (const auto& asset : assets) {
        for (const std::uint64_t seed : {0, 3}) {
            const auto simulation = start(*asset, "hang", {}, 1, seed);
            float lowest = 1e9F;
            for (int step = 0; step < 480; ++step) {
                simulation->step();
                const auto frames = simulation->worldFromBody(0);
                for (std::size_t body = 0; body < frames.size(); ++body) {
                    const vec3 half = halfAabbOf(asset->profile.bodies[body].shape, frames[body].rotation);
                    lowest = std::min(lowest, frames[body].translation.y - half.y);
                }
            }
            CAPTURE(asset->character.name, seed, lowest);
            CHECK(lowest > 0.0F);
            CHECK(lowest < 1.0F);
        }
    }
}
