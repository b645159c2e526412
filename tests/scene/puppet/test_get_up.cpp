#include <glm/gtc/quaternion.hpp>

#include "physics/profile/constraint_state.hpp"
#include "scene/measure/report.hpp"
#include "scene/puppet/floor_keeper.hpp"
#include "scene/puppet/get_up_clips.hpp"
#include "scene/run/simulation.hpp"
#include "support/catch.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using physics::PuppetState;
using physics::Role;
using physics::SolverKind;
using scene::GetUpClips;
using scene::Lying;

namespace {

const scene::RagdollAsset& getUpMannequin() {
    static const auto asset = scene::loadRagdoll(std::filesystem::path(LUTKA_ASSETS_DIR) / "models/mannequin.glb");
    REQUIRE(asset);
    return *asset.value();
}

// The bodies of a clip's frame, standing on the world's ground with the figure turned by `yaw`.
std::vector<RigidTransform> frameOf(const scene::RagdollAsset& asset, const char* clip, float seconds, float yaw,
                                    const vec3& place) {
    auto clips = GetUpClips::create(asset, nullptr);
    REQUIRE(clips);
    std::vector<RigidTransform> bodies(asset.profile.bodies.size());
    for (int i = 0; i < clips.value().clipCount(); ++i) {
        if (clips.value().name(i) != clip) continue;
        clips.value().sample({i, seconds, {glm::angleAxis(yaw, vec3(0, 1, 0)), place}, 0.0F}, seconds, bodies);
        return bodies;
    }
    FAIL("there is no such clip");
    return bodies;
}

std::unique_ptr<scene::Simulation> falls(SolverKind solver, int dolls, float seconds,
                                         std::vector<scene::PuppetHit> hits = {}) {
    auto scenario = scene::makeScenario({.name = "spread", .count = dolls, .seed = 3}, getUpMannequin());
    REQUIRE(scenario);
    scene::SimulationOptions options;
    options.world.solver = solver;
    scene::PuppetPlay play;
    play.getUp = true;
    play.limp = true;
    play.hits = std::move(hits);
    options.puppet = play;
    auto simulation = scene::Simulation::create(getUpMannequin(), std::move(scenario).value(), options);
    REQUIRE(simulation);
    for (int i = 0; i < static_cast<int>(seconds * 60.0F); ++i)
        simulation.value()->step();
    return std::move(simulation).value();
}

}  // namespace

TEST_CASE("a scene's clip is the character's own only by its very name, one that was asked for by what it means") {
    const scene::RagdollAsset& donor = getUpMannequin();
    auto loaded = scene::loadRagdoll(donor.character.file);
    REQUIRE(loaded);
    scene::RagdollAsset& hero = *loaded.value();
    for (animation::Clip& clip : hero.character.clips)
        if (clip.name == "walk") clip.name = "Rig|Walk";
    CHECK(scene::clipOf(hero, &donor, "walk", true).value().name == "walk");
    CHECK(scene::clipOf(hero, &donor, "walk", false).value().name == "Rig|Walk");
    CHECK(scene::clipOf(hero, nullptr, "walk", true).value().name == "Rig|Walk");
    CHECK(scene::clipOf(hero, &donor, "Rig|Walk", true).value().name == "Rig|Walk");
    CHECK(scene::clipOf(hero, &donor, "#1", true).value().name == hero.character.clips[0].name);
    CHECK_FALSE(scene::clipOf(hero, &donor, "fly").ok());
}

TEST_CASE(
    "how a figure lies is told from its trunk, and the frame that it lies like is found with its place and heading") {
    const scene::RagdollAsset& asset = getUpMannequin();
    auto clips = GetUpClips::create(asset, nullptr);
    REQUIRE(clips);
    CHECK(clips.value().clipCount() == 4);
    const std::pair<const char*, Lying> ways[] = {{"get_up_prone", Lying::prone},
                                                  {"get_up_supine", Lying::supine},
                                                  {"get_up_left", Lying::leftSide},
                                                  {"get_up_right", Lying::rightSide}};
    for (const auto& [name, lying] : ways) {
        INFO(name);
        const auto bodies = frameOf(asset, name, 0.0F, 1.3F, {3, 0.5F, -2});
        CHECK(scene::lyingOf(asset, bodies) == lying);
        const GetUpClips::Match match = clips.value().match(bodies, 0.5F);
        CHECK(clips.value().name(match.clip) == name);
        CHECK(match.seconds == 0.0F);
        CHECK(match.distanceM < 1e-3F);
        std::vector<RigidTransform> again(bodies.size());
        clips.value().sample(match, match.seconds, again);
        CHECK(glm::distance(again[0].translation, bodies[0].translation) < 1e-3F);
    }
}

TEST_CASE("who stands up from a seat does not get up from the ground") {
    scene::RagdollAsset asset = getUpMannequin();
    std::vector<animation::Clip>& clips = asset.character.clips;
    const auto idle = std::find_if(clips.begin(), clips.end(), [](const auto& clip) { return clip.name == "idle"; });
    REQUIRE(idle != clips.end());
    const std::size_t joints = asset.character.skeleton.parents.size();
    const std::vector<RigidTransform> all = idle->parentFromJoint.get();
    std::vector<RigidTransform> standing(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(joints));
    std::vector<RigidTransform> low = standing;
    low[static_cast<std::size_t>(asset.map.jointOf(animation::Role::hips))].translation.y *= 0.3F;
    const auto holdsGetUp = [&](const std::vector<RigidTransform>& first) {
        animation::Clip clip;
        clip.name = "stand_up_left";
        clip.framesPerSecond = 1.0F;
        clip.frameCount = 2;
        clip.parentFromJoint.append(first);
        clip.parentFromJoint.append(standing);
        clips = {clip};
        return scene::GetUpClips::hasOwn(asset);
    };
    CHECK_FALSE(holdsGetUp(low));
    RigidTransform& hips = low[static_cast<std::size_t>(asset.map.jointOf(animation::Role::hips))];
    hips.rotation = glm::angleAxis(kPi / 2, vec3(1, 0, 0)) * hips.rotation;
    CHECK(holdsGetUp(low));
}

TEST_CASE("limp dolls fall, get up, and go on standing in both solvers, no joint snaps and feet stay") {
    for (const SolverKind solver : {SolverKind::crowd, SolverKind::bullet}) {
        INFO(physics::solverName(solver));
        const auto simulation = falls(solver, 9, 9.0F);
        const scene::GetUpFigures up = simulation->puppets()->getUpFigures();
        INFO(up.mostStepDeg << " degrees in a step at " << up.stepJoint << ", feet slid " << up.mostSlideM << " m");
        CHECK(up.stood == 9);
        CHECK(up.mostSeconds <= 4.0F);
        CHECK(up.mostStepDeg <= 10.0F);
        CHECK(up.mostSlideM <= 0.05F);
        for (int doll = 0; doll < simulation->dollCount(); ++doll) {
            CHECK(simulation->puppets()->puppet(doll).state() == PuppetState::animated);
            CHECK(simulation->worldFromBody(doll).front().translation.y > 0.85F);
        }
        CHECK(simulation->quality().nonFinite == 0);
        CHECK(scene::reportText(*simulation).find("got up") != std::string::npos);
    }
}

TEST_CASE("while nobody has got up the report tells no time of it and no joint") {
    const std::string text = scene::reportText(*falls(SolverKind::crowd, 1, 0.1F));
    CHECK(text.find("got up") != std::string::npos);
    CHECK(text.find("0.00 s at most") == std::string::npos);
    CHECK(text.find("()") == std::string::npos);
}

TEST_CASE("a doll that is struck down on its way up lies, and gets up again") {
    const auto once = falls(SolverKind::crowd, 1, 3.5F);
    REQUIRE(once->puppets()->puppet(0).state() == PuppetState::gettingUp);
    const auto twice =
        falls(SolverKind::crowd, 1, 12.0F, {{"hips", 3.5F, {0, 0, 400}}, {"upperChest", 3.5F, {0, 0, 400}}});
    CHECK(twice->puppets()->getUpFigures().begun >= 2);
    CHECK(twice->puppets()->figures().knockOuts >= 1);
    CHECK(twice->puppets()->puppet(0).state() == PuppetState::animated);
}

TEST_CASE("hits on the way up and while the clip is blended into move no joint by more than ten degrees in a step") {
    for (const SolverKind solver : {SolverKind::crowd, SolverKind::bullet}) {
        for (const float at : {1.7F, 2.6F, 3.5F, 4.4F}) {
            INFO(physics::solverName(solver) << ", hit at " << at << " s");
            const auto simulation = falls(solver, 4, 11.0F, {{"upperChest", at, {0, 0, 20}}});
            const scene::GetUpFigures up = simulation->puppets()->getUpFigures();
            INFO(up.mostStepDeg << " degrees at " << up.stepJoint);
            CHECK(up.mostStepDeg <= 10.0F);
            for (int doll = 0; doll < simulation->dollCount(); ++doll)
                CHECK(simulation->puppets()->puppet(doll).state() == PuppetState::animated);
            CHECK(simulation->quality().nonFinite == 0);
        }
    }
}

TEST_CASE("hands and feet in the floor are lifted by their limbs, the rest with the whole figure") {
    const scene::RagdollAsset& asset = getUpMannequin();
    const scene::FloorKeeper keeper(asset);
    const auto level = [](const vec3&) { return 0.0F; };
    auto bodies = frameOf(asset, "get_up_prone", 1.0F, 0.4F, vec3(0));
    keeper.keep(level, bodies);
    const auto before = bodies;
    for (RigidTransform& body : bodies)
        body.translation.y -= 0.08F;
    keeper.keep(level, bodies);
    for (int body = 0; body < static_cast<int>(bodies.size()); ++body)
        CHECK(keeper.lowestOf(body, bodies[body]) > -1e-3F);
    // Legs are folded no further than they can be: what is left of the depth is the whole figure's.
    for (const float sunk : {0.08F, 0.2F, 0.4F}) {
        INFO(sunk);
        bodies = before;
        for (RigidTransform& body : bodies)
            body.translation.y -= sunk;
        keeper.keep(level, bodies);
        for (const Role role : {Role::leftUpperLeg, Role::leftLowerLeg, Role::rightUpperLeg, Role::rightLowerLeg}) {
            const int body = physics::bodyOf(asset.profile, role);
            const auto& joint = asset.profile.constraints[body - 1];
            const auto state = physics::measureConstraint(joint, bodies[joint.parent], bodies[joint.child]);
            CHECK(degrees(state.violation) < 0.1F);
        }
        for (int body = 0; body < static_cast<int>(bodies.size()); ++body)
            CHECK(keeper.lowestOf(body, bodies[body]) > -1e-3F);
    }
    // What is out of the floor stays as it is.
    auto high = before;
    for (RigidTransform& body : high)
        body.translation.y += 0.5F;
    const auto kept = high;
    keeper.keep(level, high);
    for (std::size_t body = 0; body < high.size(); ++body)
        CHECK(glm::distance(high[body].translation, kept[body].translation) < 1e-3F);
}
