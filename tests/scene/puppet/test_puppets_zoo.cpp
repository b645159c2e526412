// Real models as puppets of the mannequin's clips: figures with short legs, fat trunks, bent knees, their origin at the
// hips.
#include <cmath>

#include "core/files.hpp"
#include "scene/puppet/reachable_clip.hpp"
#include "scene/run/simulation.hpp"
#include "support/catch.hpp"
#include "support/zoo.hpp"

using namespace lutka;
using physics::SolverKind;
using scene::RagdollAsset;
using scene::Simulation;

namespace {

std::unique_ptr<RagdollAsset> figure(const char* file) {
    scene::LoadOptions options;
    options.import.loadTextures = false;
    auto loaded = scene::loadRagdoll(test::zooFile(file), options);
    REQUIRE(loaded.ok());
    return std::move(loaded).value();
}

std::unique_ptr<Simulation> playIn(const RagdollAsset& asset, scene::Scenario scenario, const scene::PuppetPlay& play,
                                   SolverKind solver, float seconds) {
    scene::SimulationOptions options;
    options.world.solver = solver;
    options.puppet = play;
    auto simulation = Simulation::create(asset, std::move(scenario), options);
    REQUIRE(simulation.ok());
    for (int i = 0; i < static_cast<int>(seconds * 60.0F); ++i)
        simulation.value()->step();
    return std::move(simulation).value();
}

}  // namespace

TEST_CASE("figures of any proportions walk within two degrees of a clip that they borrow") {
    NEEDS_ZOO();
    for (const char* file :
         {"cesium_man_glb/CesiumMan.glb", "makehuman_mixamo/makehuman_mixamo.glb", "kenney_medium/characterMedium.fbx",
          "kaykit_rogue/Rogue_Hooded.glb", "lumberjack_rigify/lumberjack.glb", "quaternius_man_fbx/Male_Casual.fbx",
          "godot_platformer_robot/platformer_player.glb",                 // shins that fold into the hips
          "quaternius_platformer_ik/platformer_game_pack_Character.glb",  // arms that swing through the belly
          "ozz_pab_skeleton_zup_dae/skeleton_zup.dae",                    // no skin: its bodies end above its soles
          "quaternius_skeleton/q_skeleton.fbx", "hl1_man/man.mdl"}) {     // no feet, no knees
        const auto asset = figure(file);
        for (const SolverKind solver : {SolverKind::crowd, SolverKind::bullet}) {
            INFO(file << ", " << physics::solverName(solver));
            scene::Scenario ground;
            ground.statics.emplace_back();
            ground.dolls.emplace_back();
            scene::PuppetPlay play;
            play.start.clip = "walk";
            play.borrows = true;
            const auto simulation = playIn(*asset, std::move(ground), play, solver, 3.0F);
            const scene::PuppetFigures figures = simulation->puppets()->figures();
            INFO(figures.rmsDeg << " rms, " << figures.maxDeg << " at most at " << figures.worstJoint
                                << "; the clip was turned by " << figures.clipReachDeg << " at "
                                << figures.clipReachJoint);
            CHECK(figures.rmsDeg <= 2.0F);
            CHECK(figures.rootM <= 0.02F);
            CHECK(simulation->quality().nonFinite == 0);
        }
    }
}

TEST_CASE("figures of any proportions get up: short legs, a large head, a heavy trunk, an origin at the hips") {
    NEEDS_ZOO();
    constexpr int kDolls = 20;
    struct Falls {
        const char* file;
        std::uint64_t seed = 1;
    };
    for (const auto& [file, seed] :
         {Falls{"kaykit_rogue/Rogue_Hooded.glb"}, Falls{"bvh_boxing/Boxing_Toes.bvh"},
          Falls{"lumberjack_rigify/lumberjack.glb"},
          Falls{"quaternius_platformer_ik/platformer_game_pack_Character.glb"}, Falls{"hl1_man/man.mdl"},
          Falls{"kenney_medium/characterMedium.fbx"}, Falls{"vrm_addon_example/Example.glb"},
          Falls{"raylib_robot/robot.glb", 201}}) {  // a hand that comes down on the floor at full speed
        const auto asset = figure(file);
        for (const SolverKind solver : {SolverKind::crowd, SolverKind::bullet}) {
            INFO(file << ", " << physics::solverName(solver));
            auto scenario = scene::makeScenario({.name = "spread", .count = kDolls, .seed = seed}, *asset);
            REQUIRE(scenario.ok());
            scene::PuppetPlay play;
            play.getUp = play.limp = true;
            const auto simulation = playIn(*asset, std::move(scenario).value(), play, solver, 10.0F);
            const scene::GetUpFigures up = simulation->puppets()->getUpFigures();
            INFO(up.begun << " begun, " << up.stood << " stood, " << up.mostSeconds << " s at most; " << up.mostStepDeg
                          << " degrees in a step at " << up.stepJoint << "; feet slid " << up.mostSlideM);
            CHECK(up.stood >= kDolls - 1);
            CHECK(up.begun <= kDolls + 2);
            CHECK(up.mostSlideM <= 0.05F);
            CHECK(up.mostStepDeg <= 10.0F);
            CHECK(simulation->quality().nonFinite == 0);
            const vec3 up3 = glm::conjugate(asset->profile.standardFromModel) * vec3(0, 1, 0);
            const float standing = scene::figureOf(*asset).bounds.low.y;
            int upright = 0;
            for (int doll = 0; doll < simulation->dollCount(); ++doll) {
                const float hips = simulation->worldFromBody(doll).front().translation.y;
                upright +=
                    hips > 0.85F * (glm::dot(asset->rig.bindModelFromBody.front().translation, up3) - standing) ? 1 : 0;
            }
            CHECK(upright >= kDolls - 1);
        }
    }
}

TEST_CASE("figures of any proportions stand, and a push of 20 N s on the chest from no side makes them fall or step") {
    NEEDS_ZOO();
    constexpr int kWays = 8;
    const std::filesystem::path mannequin = findAsset("models/mannequin.glb").value();
    for (const std::filesystem::path& file :
         {mannequin, test::zooFile("cesium_man_glb/CesiumMan.glb"),
          test::zooFile("makehuman_mixamo/makehuman_mixamo.glb"), test::zooFile("kenney_medium/characterMedium.fbx"),
          test::zooFile("kaykit_rogue/Rogue_Hooded.glb"),
          test::zooFile("godot_platformer_robot/platformer_player.glb")}) {
        auto loaded = scene::loadRagdoll(file);
        REQUIRE(loaded.ok());
        const RagdollAsset& asset = *loaded.value();
        for (const SolverKind solver : {SolverKind::crowd, SolverKind::bullet}) {
            INFO(file.string() << ", " << physics::solverName(solver));
            const scene::Figure about = scene::figureOf(asset);
            scene::Scenario ground;
            ground.statics.emplace_back();
            scene::PuppetPlay play;
            play.start.clip = "idle";
            play.borrows = true;
            play.pinForceN = 0.0F;
            for (int way = 0; way < kWays; ++way) {
                ground.dolls.emplace_back().worldFromModel = {
                    about.standardFromModel, vec3(3.0F * static_cast<float>(way), -about.bounds.low.y, 0)};
                const float angle = 2.0F * kPi / kWays * static_cast<float>(way);
                play.hits.push_back({"upperChest", 3.0F, 20.0F * vec3(std::sin(angle), 0, std::cos(angle)), way});
            }
            const auto simulation = playIn(asset, std::move(ground), play, solver, 7.0F);
            const float standing = about.bounds.low.y;
            const vec3 up = glm::conjugate(asset.profile.standardFromModel) * vec3(0, 1, 0);
            const float hips = glm::dot(asset.rig.bindModelFromBody.front().translation, up) - standing;
            for (int way = 0; way < kWays; ++way) {
                INFO(way * 45 << " degrees from ahead");
                CHECK(simulation->puppets()->puppet(way).state() != physics::PuppetState::limp);
                const auto bodies = simulation->worldFromBody(way);
                CHECK(bodies.front().translation.y > 0.85F * hips);
                const int left = physics::bodyOf(asset.profile, physics::Role::leftFoot);
                const int right = physics::bodyOf(asset.profile, physics::Role::rightFoot);
                const vec3 between = 0.5F * (bodies[left].translation + bodies[right].translation);
                CHECK(std::abs(between.x - 3.0F * static_cast<float>(way)) < 0.06F);
            }
        }
    }
}
