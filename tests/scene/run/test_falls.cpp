// Falls of real models, each scene and seed by itself. bench/falls.cpp runs thousands (docs/crowd.md has the figures);
// here are a few of each, and those that went wrong.
#include "support/falls.hpp"

#include <utility>
#include <vector>

#include "scene/run/make_world.hpp"
#include "scene/run/simulation.hpp"
#include "support/catch.hpp"
#include "support/zoo.hpp"

using namespace lutka;

namespace {

std::unique_ptr<scene::RagdollAsset> mannequin() {
    auto asset = test::loadFigure(LUTKA_ASSETS_DIR "/models/mannequin.glb");
    REQUIRE(asset.ok());
    return std::move(asset).value();
}

test::Fall fallOf(const scene::RagdollAsset& asset, physics::SolverKind solver, const std::string& scene,
                  std::uint64_t seed, float seconds) {
    physics::WorldSettings settings;
    settings.solver = solver;
    auto result = test::fall(asset, scene::makeWorld(settings), {scene, seed, seconds});
    REQUIRE(result.ok());
    return std::move(result).value();
}

}  // namespace

// A wrist's ellipse is narrow: past its tip one row let the hand run 47, 66 and 106 degrees too far, for half a second
// and more.
TEST_CASE("no hand stays past its limit, whatever falls on it") {
    const auto asset = mannequin();
    for (const auto solver : {physics::SolverKind::crowd, physics::SolverKind::bullet}) {
        for (const std::uint64_t seed : {59, 63, 65, 66, 77}) {
            const test::Fall fall = fallOf(*asset, solver, "drop", seed, 3.0F);
            CAPTURE(physics::solverName(solver), seed, fall.worstJoint);
            CHECK(fall.quality.limitViolationDeg.lasting < 15.0F);
        }
    }
}

// A figure that sat down on its own straight arm pressed the hand 15 to 27 degrees past its limit: mending the overlap
// with the floor turned it there, against a limit that was as stiff as a hand is heavy.
TEST_CASE("a hand that carries the whole figure keeps its limit") {
    const auto asset = mannequin();
    for (const std::uint64_t seed : {257, 301, 453, 495, 498}) {
        const test::Fall fall = fallOf(*asset, physics::SolverKind::crowd, "drop", seed, 2.0F);
        CAPTURE(seed, fall.worstJoint);
        CHECK(fall.quality.limitViolationDeg.lasting < 6.0F);
    }
}

// Substeps were a sixth of a step, however long that was: at 30 steps a second a hand stayed 25 degrees past its limit,
// at 20 a joint opened by 5.7 mm, and where each step had another length no figure ever lay still.
TEST_CASE("a figure falls as well at any rate of frames, and where they vary") {
    const auto asset = mannequin();
    const std::vector<float> ways[]{
        {0.05F},         {1.0F / 30.0F},
        {0.02F},         {1.0F / 144.0F},
        {1.0F / 240.0F}, {0.033F, 0.007F, 0.016F, 0.004F, 0.021F, 0.030F, 0.011F, 0.0166F, 0.025F, 0.005F}};
    for (const std::vector<float>& frames : ways) {
        for (const char* scene : {"drop", "throw"}) {
            for (std::uint64_t seed = 0; seed < 3; ++seed) {
                CAPTURE(frames[0], frames.size(), scene, seed);
                auto result = test::fall(*asset, scene::makeWorld({}), {scene, seed, 6.0F, frames});
                REQUIRE(result.ok());
                const physics::Quality& quality = result.value().quality;
                CHECK(quality.settleSeconds.has_value());
                CHECK(quality.limitViolationDeg.lasting < 5.0F);
                CHECK(quality.jointSeparationM.max < 0.002F);
                CHECK(quality.floorPenetrationM < 0.003F);
                CHECK(quality.selfPenetrationM < 0.015F);
                CHECK(quality.energyGrowthJ < 0.01F * quality.initialEnergyJ);
            }
        }
    }
}

// Each point was pushed out by itself, which folded the figure up, was never solved and so left out: it lay 1 m deep
// for good.
TEST_CASE("a figure that starts with its legs in the floor comes out of it as it is") {
    const auto asset = mannequin();
    for (const float depth : {0.3F, 1.0F}) {
        for (const float lean : {0.0F, 0.2F, 0.5F}) {
            CAPTURE(depth, lean);
            const auto world = scene::makeWorld({});
            const std::vector<physics::StaticShape> statics(1);
            world->addStatic(statics[0]);
            std::vector<physics::BodyState> bodies(asset->profile.bodies.size());
            RigidTransform at;
            at.rotation = glm::angleAxis(lean, vec3(1, 0, 0));
            at.translation = {0, -depth, 0};
            physics::bodiesFromPose(asset->rig, asset->character.skeleton.bindModelFromJoint, at, bodies);
            world->addDoll(asset->profile, bodies);
            for (int i = 0; i < 120; ++i)
                world->step(1.0F / 60.0F);
            physics::QualityMeter meter(*world, statics, vec3(0, -9.81F, 0));
            for (int i = 0; i < 180; ++i) {
                world->step(1.0F / 60.0F);
                meter.sample(static_cast<double>(i + 1) / 60.0);
            }
            CHECK(meter.result().floorPenetrationM < 0.003F);
            CHECK(meter.result().jointSeparationM.max < 0.002F);
            CHECK(world->caught().empty());
        }
    }
}

// A range of no width has its stops on both sides at once: these trembled by 7 to 14 cm/s for ever, and gave way by
// 29 degrees.
TEST_CASE("a figure whose joints are locked comes to rest") {
    const auto asset = mannequin();
    std::vector<physics::BodyState> bound(asset->profile.bodies.size());
    physics::bodiesFromPose(asset->rig, asset->character.skeleton.bindModelFromJoint, {}, bound);
    for (physics::ConstraintProfile& constraint : asset->profile.constraints) {
        const quat& parent = bound[constraint.parent].worldFromBody.rotation;
        const quat& child = bound[constraint.child].worldFromBody.rotation;
        constraint.childFromFrame.rotation = glm::conjugate(child) * parent * constraint.parentFromFrame.rotation;
        constraint.hinge = {0, 0};
        constraint.cone = {0.001F, 0.001F, 0.001F};
    }
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
        CAPTURE(seed);
        const test::Fall fall = fallOf(*asset, physics::SolverKind::crowd, "drop", seed, 6.0F);
        CHECK(fall.quality.settleSeconds.has_value());
        CHECK(fall.quality.jointSeparationM.max < 0.003F);
        CHECK(fall.quality.limitViolationDeg.lasting < 2.0F);
    }
}

// What is faster than any fall had substeps of a fall: a joint opened by 105 mm, and a limb stayed 89 degrees past its
// limit.
TEST_CASE("a figure that hits the floor at 50 m/s holds together") {
    const auto asset = mannequin();
    for (const float speed : {50.0F, 70.0F}) {
        for (int seed = 0; seed < 4; ++seed) {
            CAPTURE(speed, seed);
            const auto world = scene::makeWorld({});
            const std::vector<physics::StaticShape> statics(1);
            world->addStatic(statics[0]);
            std::vector<physics::BodyState> bodies(asset->profile.bodies.size());
            RigidTransform at;
            at.rotation = glm::angleAxis(1.3F * static_cast<float>(seed), glm::normalize(vec3(1, 0.3F, 0.5F)));
            at.translation = {0, 3, 0};
            physics::bodiesFromPose(asset->rig, asset->character.skeleton.bindModelFromJoint, at, bodies);
            for (physics::BodyState& body : bodies)
                body.linearVelocity = {0.2F * speed, -speed, 0};
            world->addDoll(asset->profile, bodies);
            physics::QualityMeter meter(*world, statics, vec3(0, -9.81F, 0));
            double seconds = 0;
            for (int i = 0; i < 60; ++i)
                world->step(1.0F / 60.0F, [&] { meter.sample(seconds += 1.0 / 60.0 / world->substepsPerStep()); });
            const physics::Quality quality = meter.result();
            CHECK(quality.jointSeparationM.max < 0.004F);
            CHECK(quality.limitViolationDeg.lasting < 6.0F);
            CHECK(quality.floorPenetrationM < 0.005F);
            CHECK(quality.energyGrowthJ < 0.01F * quality.initialEnergyJ);
        }
    }
}

// From the same wall a figure as tall as a hand falls as fast as a man: its limbs turn eight times as far in a substep,
// and stayed 17 degrees past their limits.
TEST_CASE("a figure as tall as a hand keeps its limits") {
    scene::LoadOptions options;
    options.import.metresPerFileUnit = 0.12F;
    const auto asset = scene::loadRagdoll(LUTKA_ASSETS_DIR "/models/mannequin.glb", options);
    REQUIRE(asset.ok());
    CHECK(asset.value()->profile.heightM < 0.25F);
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        const test::Fall fall = fallOf(*asset.value(), physics::SolverKind::crowd, "throw", seed, 2.0F);
        CAPTURE(seed, fall.worstJoint);
        CHECK(fall.quality.limitViolationDeg.lasting < 3.0F);
    }
}

// Arms that were foreseen by what their own pushes gave turned a hand or foot faster and faster, to 350 rad/s in one
// substep: 18 and 7 % of the energy, and a wrist 5 mm apart.
TEST_CASE("no impact gives a figure energy") {
    NEEDS_ZOO();
    const auto man = test::loadFigure(test::zooFile("quaternius_man_fbx/Male_Casual.fbx").string());
    REQUIRE(man.ok());
    const auto asset = mannequin();
    for (const auto& [figure, seed] : {std::pair(man.value().get(), 358), std::pair(asset.get(), 471)}) {
        const test::Fall fall = fallOf(*figure, physics::SolverKind::crowd, "throw", seed, 2.0F);
        CAPTURE(seed);
        CHECK(fall.quality.energyGrowthJ < 0.02F * fall.quality.initialEnergyJ);
        CHECK(fall.quality.jointSeparationM.max < 0.002F);
    }
}

// A blow of tens of kilonewtons through the head goes down a spine whose arms turn within the substep: 0.6 % of the
// energy, and 2 % in a figure with long arms.
TEST_CASE("a blow through the whole figure gives it no energy") {
    NEEDS_ZOO();
    for (const auto& [file, seed] :
         {std::pair("quaternius_man_fbx/Male_Casual.fbx", 493), std::pair("quaternius_man_fbx/Male_Casual.fbx", 239),
          std::pair("makehuman_mixamo/makehuman_mixamo.glb", 469)}) {
        const auto figure = test::loadFigure(test::zooFile(file).string());
        REQUIRE(figure.ok());
        const test::Fall fall = fallOf(*figure.value(), physics::SolverKind::crowd, "throw", seed, 1.0F);
        CAPTURE(file, seed);
        CHECK(fall.quality.energyGrowthJ < 0.002F * fall.quality.initialEnergyJ);
        CHECK(fall.quality.jointSeparationM.max < 0.002F);
    }
}

// A contact that had stopped a limb within a substep was not found when contacts were looked for once more there, since
// what stands still reaches nothing; and a limb that an impact turned towards a wall that it only was near had none. A
// foot and a hand went 12.6, 7.5, 10.4 and 8 mm into the wall.
TEST_CASE("what has stopped a limb within a substep goes on holding it") {
    const auto asset = mannequin();
    for (const std::uint64_t seed : {1079, 2178}) {
        const test::Fall fall = fallOf(*asset, physics::SolverKind::crowd, "throw", seed, 1.0F);
        CAPTURE(seed);
        CHECK(fall.quality.floorPenetrationM < 0.003F);
    }
    NEEDS_ZOO();
    const auto man = test::loadFigure(test::zooFile("rocketbox_male/Male_Adult_17.fbx").string());
    REQUIRE(man.ok());
    for (const std::uint64_t seed : {130, 230}) {
        const test::Fall fall = fallOf(*man.value(), physics::SolverKind::crowd, "throw", seed, 1.0F);
        CAPTURE(seed);
        CHECK(fall.quality.floorPenetrationM < 0.003F);
    }
}

// What a pull held had no guard against arms that turn a limb faster and faster: the held hand was whirled to 835 rad/s
// between the pin and the doll that hangs on it, which gave 148, 104 and 191 % of the energy.
TEST_CASE("a figure that hangs by its hand gains no energy") {
    const auto asset = mannequin();
    for (const std::uint64_t seed : {0, 5, 9}) {
        auto scenario = scene::makeScenario({.name = "hang", .seed = seed}, *asset);
        REQUIRE(scenario.ok());
        const auto simulation = scene::Simulation::create(*asset, std::move(scenario).value(), {});
        REQUIRE(simulation.ok());
        for (int step = 0; step < 60; ++step)
            simulation.value()->step();
        const physics::Quality quality = simulation.value()->quality();
        CAPTURE(seed);
        CHECK(quality.energyGrowthJ < 0.002F * quality.initialEnergyJ);
    }
}

// With a doll's arms of free motion in place of the right ones, a hand that hit the wall turned at 134 rad/s and its
// wrist opened by 5.4 mm; 28 mm were the answers within the doll, which pressed more than had been there to stop. These
// gave the two drops 5.4 and 1.3 % of their energy.
TEST_CASE("the hardest hits open no joint and give no energy") {
    const auto asset = mannequin();
    const std::pair<const char*, std::uint64_t> falls[]{{"throw", 273}, {"throw", 3193}, {"drop", 984}, {"drop", 920}};
    for (const auto& [scene, seed] : falls) {
        const test::Fall fall = fallOf(*asset, physics::SolverKind::crowd, scene, seed, 2.0F);
        CAPTURE(scene, seed);
        CHECK(fall.quality.jointSeparationM.max < 0.0015F);
        CHECK(fall.quality.energyGrowthJ < 0.01F * fall.quality.initialEnergyJ);
    }
}

// What hits a wall at 8 m/s comes together otherwise than the step foresaw. Contacts were looked for once a step: these
// went 51, 37, 112, 72, 72, 82 and 71 mm into each other before the next search, boxes whose contacts stayed where they
// were found among them.
TEST_CASE("limbs that a hard hit throws together meet within the step") {
    const auto depthOf = [](const scene::RagdollAsset& asset, std::uint64_t seed) {
        return fallOf(asset, physics::SolverKind::crowd, "throw", seed, 1.0F).quality.selfPenetrationM;
    };
    const auto asset = mannequin();
    for (const std::uint64_t seed : {1632, 2628}) {
        CAPTURE(seed);
        CHECK(depthOf(*asset, seed) < 0.015F);
    }
    NEEDS_ZOO();
    const std::pair<const char*, std::vector<std::uint64_t>> figures[]{
        {"lumberjack_rigify/lumberjack.glb", {9, 13, 19}}, {"sketchbook_boxman/boxman.glb", {5, 16}}};
    for (const auto& [file, seeds] : figures) {
        const auto figure = test::loadFigure(test::zooFile(file).string());
        REQUIRE(figure.ok());
        for (const std::uint64_t seed : seeds) {
            CAPTURE(file, seed);
            CHECK(depthOf(*figure.value(), seed) < 0.025F);
        }
    }
}

// The one contact that two boxes had while they were apart stayed at a corner, while an arm came down flat: 31 and 35
// mm. With balls about there are as many answers as without.
TEST_CASE("boxes of a figure that come down flat upon each other meet at their deepest point, balls or not") {
    NEEDS_ZOO();
    const auto figure = test::loadFigure(test::zooFile("minetest_character/character.b3d").string());
    REQUIRE(figure.ok());
    for (const auto& [scene, seed] : {std::pair("throw", 9), std::pair("balls", 6), std::pair("balls", 11)}) {
        CAPTURE(scene, seed);
        const test::Fall fall = fallOf(*figure.value(), physics::SolverKind::crowd, scene, seed, 3.0F);
        CHECK(fall.quality.selfPenetrationM < 0.010F);
        CHECK(fall.quality.energyGrowthJ < 0.01F * fall.quality.initialEnergyJ);
    }
}

// Contacts within a doll were pressed once, as the masses of their two bodies ask, and the limbs behind them carried
// on: a hand, an arm or the other foot went 19 to 46 mm deep in each of these falls.
TEST_CASE("limbs stay out of their own trunk") {
    const auto asset = mannequin();
    const std::pair<const char*, std::vector<std::uint64_t>> falls[]{{"drop", {3, 9, 29, 31, 80, 95}},
                                                                     {"stairs", {38, 41, 45, 48, 52, 68, 81, 97}},
                                                                     {"throw", {5, 6, 16, 17, 19, 22, 29, 47, 78, 83}}};
    int count = 0, deep = 0;
    for (const auto& [scene, seeds] : falls) {
        for (const std::uint64_t seed : seeds) {
            const test::Fall fall = fallOf(*asset, physics::SolverKind::crowd, scene, seed, 3.0F);
            CAPTURE(scene, seed);
            CHECK(fall.quality.selfPenetrationM < 0.030F);
            CHECK(fall.quality.energyGrowthJ < 0.02F * fall.quality.initialEnergyJ);
            deep += fall.quality.selfPenetrationM > 0.015F ? 1 : 0;
            ++count;
        }
    }
    CAPTURE(count);
    CHECK(deep <= 3);
}

// What closes slowly is pressed as well. Contacts were left alone below 2 mm or 0.1 m/s, and mending fought what sank:
// 2.6 mm in the mean of these falls, and a figure that knelt on its own feet lay 25 mm deep with its arm bent past its
// limit.
TEST_CASE("limbs that lie on the own body do not sink into it") {
    const auto asset = mannequin();
    float sum = 0.0F;
    for (const char* scene : {"drop", "stairs", "throw"}) {
        for (std::uint64_t seed = 0; seed < 20; ++seed)
            sum += fallOf(*asset, physics::SolverKind::crowd, scene, seed, 3.0F).quality.selfPenetrationM;
    }
    CHECK(sum / 60.0F < 0.002F);
    NEEDS_ZOO();
    const auto figure = test::loadFigure(test::zooFile("rocketbox_male/Male_Adult_17.fbx").string());
    REQUIRE(figure.ok());
    const test::Fall fall = fallOf(*figure.value(), physics::SolverKind::crowd, "drop", 0, 3.0F);
    CHECK(fall.quality.selfPenetrationM < 0.010F);
    CHECK(fall.quality.limitViolationDeg.lasting < 3.0F);
}

// What a contact of the hand with the own head did to the hand alone was taken for what the pull had worked against:
// nine in ten of these figures were left without any speed and stood in the air for good.
TEST_CASE("a hand that is pulled past the own head at any force comes where it is pulled to") {
    const auto asset = mannequin();
    const physics::RagdollProfile& profile = asset->profile;
    const int hand = physics::bodyOf(profile, physics::Role::leftHand);
    const vec3 target(0, 2.5F, 0);
    RigidTransform above;
    above.translation = {0, 1, 0};
    std::vector<physics::BodyState> bodies(profile.bodies.size());
    for (float force = 4000.0F; force < 6000.0F; force += 100.0F) {
        CAPTURE(force);
        physics::WorldSettings settings;
        settings.solver = physics::SolverKind::crowd;
        const auto world = scene::makeWorld(settings);
        physics::bodiesFromPose(asset->rig, asset->character.skeleton.bindModelFromJoint, above, bodies);
        const physics::DollId doll = world->addDoll(profile, bodies);
        world->addDrag({doll, hand, vec3(0), target, force});
        for (int i = 0; i < 90; ++i)
            world->step(1.0F / 60.0F);
        world->getBodies(doll, bodies);
        CHECK(glm::distance(bodies[static_cast<std::size_t>(hand)].worldFromBody.translation, target) < 0.2F);
    }
}

TEST_CASE("joints of real models hold their limits in every scene") {
    NEEDS_ZOO();
    for (const char* file : {"quaternius_man_fbx/Male_Casual.fbx", "rocketbox_male/Male_Adult_17.fbx",
                             "makehuman_mixamo/makehuman_mixamo.glb"}) {
        const auto asset = test::loadFigure(test::zooFile(file).string());
        REQUIRE(asset.ok());
        for (const char* scene : {"drop", "stairs", "throw", "balls"}) {
            for (std::uint64_t seed = 0; seed < 5; ++seed) {
                const test::Fall fall = fallOf(*asset.value(), physics::SolverKind::crowd, scene, seed, 3.0F);
                CAPTURE(file, scene, seed, fall.worstJoint);
                CHECK(fall.quality.limitViolationDeg.lasting < 15.0F);
            }
        }
    }
}

// A limb that slid over an edge went 10 mm into the next stair until the contact was found anew.
TEST_CASE("nobody sinks into the edges of stairs") {
    const auto figure = mannequin();
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        const test::Fall fall = fallOf(*figure, physics::SolverKind::crowd, "stairs", seed, 4.0F);
        CAPTURE(seed);
        CHECK(fall.quality.floorPenetrationM < 0.006F);
    }
}

// A corner of the hips 0.3 mm above the floor was guessed to land: to hold it there pulled at the whole figure, and the
// legs' contacts were taken for ones that part. Half of the substeps went so, and the figures twitched by 2 cm/s for
// ever.
TEST_CASE("a figure at rest is not moved by what may just land") {
    NEEDS_ZOO();
    const auto figure = test::loadFigure(test::zooFile("minetest_character/character.b3d").string());
    REQUIRE(figure.ok());
    for (const std::uint64_t seed : {5, 7, 11, 30, 42}) {
        const test::Fall fall = fallOf(*figure.value(), physics::SolverKind::crowd, "drop", seed, 4.0F);
        CAPTURE(seed);
        CHECK(fall.quality.settleSeconds.has_value());
        CHECK(fall.quality.residualSpeedMps < 0.003F);
    }
}

// From seed 0 it sat on its knees, and figures with legs of one piece stood, each in exact balance.
TEST_CASE("a figure that nothing holds up does not stay upright") {
    NEEDS_ZOO();
    int upright = 0;
    int drops = 0;
    for (const char* file : {"minetest_character/character.b3d", "hl1_man/man.mdl", "rocketbox_male/Male_Adult_17.fbx",
                             "sketchbook_boxman/boxman.glb", "bvh_boxing/Boxing_Toes.bvh"}) {
        const auto asset = test::loadFigure(test::zooFile(file).string());
        REQUIRE(asset.ok());
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            const test::Fall fall = fallOf(*asset.value(), physics::SolverKind::crowd, "drop", seed, 6.0F);
            CAPTURE(file, seed, fall.hipsHeightShare, fall.trunkLeanDeg);
            CHECK(fall.hipsHeightShare < 0.6F);
            if (seed == 0) CHECK(fall.trunkLeanDeg > 45.0F);
            upright += fall.trunkLeanDeg > 45.0F ? 0 : 1;
            ++drops;
        }
    }
    CAPTURE(drops);
    CHECK(upright <= 2);
}
