#include "scene/puppet/terrain_walk.hpp"

#include <glm/gtc/quaternion.hpp>

#include "animation/pose.hpp"
#include "scene/run/simulation.hpp"
#include "support/catch.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using physics::StaticShape;
using scene::PuppetPlay;

namespace {

const scene::RagdollAsset& walker() {
    static const auto asset = scene::loadRagdoll(std::filesystem::path(LUTKA_ASSETS_DIR) / "models/mannequin.glb");
    REQUIRE(asset);
    return *asset.value();
}

StaticShape slab(const vec3& centre, const vec3& halfExtents, const quat& turn = quat(1, 0, 0, 0)) {
    StaticShape shape;
    shape.kind = StaticShape::Kind::box;
    shape.halfExtents = halfExtents;
    shape.worldFromShape = {turn, centre};
    return shape;
}

// A floor, and along +z from z = 1 on a ramp of 12 degrees up, or stairs.
std::vector<StaticShape> rampUp() {
    const quat tilt = glm::angleAxis(-radians(12.0F), vec3(1, 0, 0));
    const vec3 half(1.0F, 0.1F, 3.0F);
    const vec3 foot(0, 0, 1);
    return {StaticShape{}, slab(foot + tilt * vec3(0, -half.y, half.z), half, tilt)};
}
std::vector<StaticShape> stairsUp() {
    std::vector<StaticShape> shapes{StaticShape{}};
    for (int i = 0; i < 8; ++i) {
        const float top = 0.14F * static_cast<float>(i + 1);
        shapes.push_back(slab({0, 0.5F * top, 1.0F + 0.45F * static_cast<float>(i) + 1.5F}, {1.0F, 0.5F * top, 1.5F}));
    }
    return shapes;
}

struct Walked {
    scene::PuppetFigures figures;
    float hipsRise = 0.0F;
    float mostHipsStep = 0.0F;  // m in a step, up or down
    bool sound = false;
};

Walked walkOn(const std::vector<StaticShape>& statics, bool meets, bool kinematic, float seconds) {
    scene::Scenario scenario;
    scenario.statics = statics;
    scenario.dolls.emplace_back();
    PuppetPlay play;
    play.start.clip = "walk";
    play.pace = 0.95F;
    play.meetsGround = meets;
    if (kinematic) play.led = {{"all", 1.0F}};
    scene::SimulationOptions options;
    options.puppet = play;
    auto made = scene::Simulation::create(walker(), scenario, options);
    REQUIRE(made);
    scene::Simulation& simulation = *made.value();
    Walked walked;
    const float start = simulation.worldFromBody(0)[0].translation.y;
    float last = start;
    for (int i = 0; i < static_cast<int>(seconds * 60.0F); ++i) {
        simulation.step();
        const float now = simulation.worldFromBody(0)[0].translation.y;
        walked.mostHipsStep = std::max(walked.mostHipsStep, std::abs(now - last));
        last = now;
    }
    walked.figures = simulation.puppets()->figures();
    walked.hipsRise = last - start;
    walked.sound = simulation.quality().nonFinite == 0 && simulation.world().caught().empty();
    return walked;
}

}  // namespace

TEST_CASE("a clip's feet meet a ramp and stairs, which they go through without being fitted") {
    for (const bool isRamp : {true, false}) {
        const auto statics = isRamp ? rampUp() : stairsUp();
        const Walked with = walkOn(statics, true, true, 3.6F);
        const Walked without = walkOn(statics, false, true, 3.6F);
        INFO((isRamp ? "ramp" : "stairs")
             << ", fitted: mean gap " << with.figures.footGapMeanM << ", most " << with.figures.footGapM << ", depth "
             << with.figures.footDepthM << "; not: " << without.figures.footGapMeanM << ", "
             << without.figures.footDepthM << "; hips rose " << with.hipsRise << ", in a step " << with.mostHipsStep);
        CHECK(with.figures.footDepthM < (isRamp ? 0.005F : 0.06F));
        CHECK(with.figures.footGapMeanM < 0.005F);
        CHECK(without.figures.footDepthM > 0.1F);
        CHECK(with.hipsRise > 0.35F);
        CHECK(without.hipsRise < 0.1F);
        CHECK(with.mostHipsStep < 0.05F);
        CHECK(with.sound);
    }
}

TEST_CASE("who begins on a ramp or on stairs begins in the pose that is fitted to them") {
    for (const auto& [shapes, ahead] : {std::pair(rampUp(), 3.0F), std::pair(stairsUp(), 2.1F)}) {
        scene::Scenario scenario;
        scenario.statics = shapes;
        scenario.dolls.emplace_back().worldFromModel.translation = {0, 1.0F, ahead};
        PuppetPlay play;
        play.start.clip = "walk";
        play.pace = 0.95F;
        scene::SimulationOptions options;
        options.puppet = play;
        auto made = scene::Simulation::create(walker(), scenario, options);
        REQUIRE(made);
        const auto wanted = made.value()->puppets()->pose(0, 0.0F);
        const auto placed = made.value()->worldFromBody(0);
        for (std::size_t body = 0; body < wanted.size(); ++body)
            CHECK(glm::distance(wanted[body].translation, placed[body].translation) < 1e-4F);
        for (int step = 0; step < 6; ++step)
            made.value()->step();
        CAPTURE(ahead);
        CHECK(made.value()->puppets()->figures().rootM < 0.02F);
    }
}

TEST_CASE("a powered walk goes up a ramp and stairs without being knocked out") {
    for (const bool isRamp : {true, false}) {
        const Walked walked = walkOn(isRamp ? rampUp() : stairsUp(), true, false, 3.6F);
        INFO((isRamp ? "ramp" : "stairs")
             << ": gap " << walked.figures.footGapM << ", depth " << walked.figures.footDepthM << ", behind "
             << walked.figures.rmsDeg << " degrees, root " << walked.figures.rootM << " m");
        CHECK(walked.figures.knockOuts == 0);
        CHECK(walked.figures.limp == 0);
        CHECK(walked.hipsRise > 0.35F);
        CHECK(walked.figures.footDepthM < 0.02F);
        CHECK(walked.figures.rmsDeg < 9.0F);
        CHECK(walked.sound);
    }
}

TEST_CASE("level ground that is no plane changes little of a clip") {
    // Soles are put onto it one by one, where a plane lifts the whole figure by its lowest body.
    const Walked fitted = walkOn({slab({0, -0.5F, 0}, {20, 0.5F, 20})}, true, false, 1.0F);
    const Walked plain = walkOn({StaticShape{}}, false, false, 1.0F);
    CHECK(fitted.hipsRise == Approx(plain.hipsRise).margin(0.025));
    CHECK(fitted.figures.rmsDeg == Approx(plain.figures.rmsDeg).margin(1.0));
}

TEST_CASE("a pose that is fitted at once somewhere else forgets the ground where it was") {
    auto walk = scene::TerrainWalk::of(walker());
    REQUIRE(walk);
    // A terrace of 2 m beyond z = 5.
    const animation::GroundQuery ground = [](const vec3& point) {
        return animation::GroundHit{point.z > 5.0F ? 2.0F : 0.0F, vec3(0, 1, 0)};
    };
    const animation::Skeleton& skeleton = walker().character.skeleton;
    std::vector<RigidTransform> pose(skeleton.parents.size());
    const RigidTransform standing{walker().map.standardFromModel, vec3(0)};
    animation::modelToLocal(skeleton, skeleton.bindModelFromJoint, pose);
    CHECK(walk->fit(ground, 0.0F, 0.0F, standing, pose).translation.y == Approx(0.0F).margin(1e-4));
    const RigidTransform above{standing.rotation, vec3(0, 2, 8)};
    animation::modelToLocal(skeleton, skeleton.bindModelFromJoint, pose);
    CHECK(walk->fit(ground, 0.0F, 2.0F, above, pose).translation.y == Approx(2.0F).margin(1e-4));
}

TEST_CASE("feet that slide are told on a terrace as on a plane") {
    // Idle, drawn along at 5 cm/s: slow enough to stand.
    const auto slid = [](const std::vector<StaticShape>& statics, float height) {
        scene::Scenario scenario;
        scenario.statics = statics;
        scenario.dolls.emplace_back().worldFromModel.translation.y = height;
        scene::SimulationOptions options;
        options.puppet.emplace();
        options.puppet->start.clip = "idle";
        options.puppet->pace = 0.05F;
        options.puppet->led = {{"all", 1.0F}};
        auto made = scene::Simulation::create(walker(), scenario, options);
        REQUIRE(made);
        for (int i = 0; i < 90; ++i)
            made.value()->step();
        return made.value()->puppets()->figures().footSlideM;
    };
    const float onPlane = slid({StaticShape{}}, 0.0F);
    CHECK(onPlane == Approx(0.075F).margin(0.02));
    CHECK(slid({slab({0, 0.5F, 0}, {5, 0.5F, 5})}, 1.0F) == Approx(onPlane).margin(0.005));
    // Up on a ramp the floor of the clip is far below.
    const auto ramp = slid(rampUp(), 0.0F);
    CHECK(ramp == Approx(onPlane).margin(0.005));
    const quat tilt = glm::angleAxis(-radians(12.0F), vec3(1, 0, 0));
    const float high = slid({slab(tilt * vec3(0, -0.1F, 0) + vec3(0, 1.5F, 0), {2, 0.1F, 4}, tilt)}, 1.5F);
    CHECK(high == Approx(onPlane).margin(0.01));
}

TEST_CASE("who walks over an edge falls, whatever leads it") {
    for (const bool kinematic : {true, false}) {
        for (const physics::SolverKind solver : {physics::SolverKind::crowd, physics::SolverKind::bullet}) {
            scene::Scenario scenario;
            scenario.statics = {StaticShape{}, slab({0, 2.5F, 0}, {2, 0.5F, 1.5F})};
            scenario.dolls.emplace_back().worldFromModel.translation.y = 3.0F;
            scene::SimulationOptions options;
            options.world.solver = solver;
            options.puppet.emplace();
            options.puppet->start.clip = "walk";
            options.puppet->pace = 0.95F;
            if (kinematic) options.puppet->led = {{"all", 1.0F}};
            auto made = scene::Simulation::create(walker(), scenario, options);
            REQUIRE(made);
            for (int i = 0; i < 60; ++i)
                made.value()->step();
            INFO(physics::solverName(solver) << (kinematic ? ", kinematic" : ", powered"));
            CHECK(made.value()->puppets()->figures().limp == 0);
            for (int i = 0; i < 180; ++i)
                made.value()->step();
            CHECK(made.value()->puppets()->figures().limp == 1);
            CHECK(made.value()->worldFromBody(0)[0].translation.y < 2.0F);
        }
    }
}

TEST_CASE("props that lie in the way are no ground to feet") {
    scene::Scenario scenario;
    scenario.statics = {slab({0, -0.5F, 0}, {20, 0.5F, 20})};
    scenario.dolls.emplace_back();
    for (int i = 0; i < 6; ++i) {
        physics::DynamicProp& crate = scenario.props.emplace_back();
        crate.shape.kind = physics::BodyShape::Kind::box;
        crate.shape.halfExtents = vec3(0.3F, 0.1F, 0.15F);
        crate.state.worldFromBody.translation = {0, 0.1F, 0.6F + 0.4F * static_cast<float>(i)};
    }
    scene::SimulationOptions options;
    options.puppet.emplace();
    options.puppet->start.clip = "walk";
    options.puppet->pace = 0.95F;
    options.puppet->led = {{"all", 1.0F}};
    auto made = scene::Simulation::create(walker(), scenario, options);
    REQUIRE(made);
    for (int i = 0; i < 150; ++i)
        made.value()->step();
    const scene::PuppetFigures figures = made.value()->puppets()->figures();
    INFO("mean gap " << figures.footGapMeanM << ", most " << figures.footGapM);
    CHECK(figures.footGapMeanM < 0.005F);
    CHECK(figures.footGapM < 0.05F);
}
