// Falls that start from the clips of real models: velocities against the clip's own derivative.
#include <algorithm>
#include <glm/geometric.hpp>

#include "animation/clip_reference.hpp"
#include "animation/pose.hpp"
#include "scene/run/simulation.hpp"
#include "scene/run/start_pose.hpp"
#include "support/catch.hpp"
#include "support/zoo.hpp"

using namespace lutka;
using physics::BodyState;
using scene::RagdollAsset;
using scene::Simulation;

namespace {

std::unique_ptr<RagdollAsset> load(const char* file) {
    scene::LoadOptions options;
    options.import.loadTextures = false;
    auto loaded = scene::loadRagdoll(test::zooFile(file), options);
    REQUIRE(loaded.ok());
    return std::move(loaded).value();
}

std::unique_ptr<Simulation> startFrom(const RagdollAsset& asset, const animation::Clip& clip, float seconds, float dt) {
    auto scenario = scene::makeScenario({.name = "drop"}, asset);
    REQUIRE(scenario.ok());
    scene::SimulationOptions options;
    options.world.gravity = vec3(0);
    options.dt = dt;
    options.measure = false;
    const std::vector<animation::Clip>& clips = asset.character.clips;
    options.fromClip =
        scene::ClipStart{animation::clipReference(clips, static_cast<std::size_t>(&clip - clips.data())), seconds};
    auto simulation = Simulation::create(asset, std::move(scenario).value(), options);
    REQUIRE(simulation.ok());
    return std::move(simulation).value();
}

std::vector<BodyState> bodiesOf(const Simulation& simulation) {
    std::vector<BodyState> bodies(simulation.asset().profile.bodies.size());
    simulation.world().getBodies(simulation.world().dolls()[0], bodies);
    return bodies;
}

// The bodies at a frame as the clip stores it, where the simulation stands.
std::vector<BodyState> bodiesAt(const Simulation& simulation, const animation::Clip& clip, int frame) {
    const RagdollAsset& asset = simulation.asset();
    std::vector<RigidTransform> pose(asset.character.skeleton.parents.size());
    const auto first = clip.parentFromJoint.begin() + static_cast<std::ptrdiff_t>(pose.size()) * frame;
    std::copy_n(first, pose.size(), pose.begin());
    localToModel(asset.character.skeleton, pose, pose);
    std::vector<BodyState> bodies(asset.profile.bodies.size());
    physics::bodiesFromPose(asset.rig, pose, simulation.worldFromModel(0), bodies);
    return bodies;
}

vec3 centreOf(const physics::RagdollProfile& profile, const std::vector<BodyState>& bodies) {
    vec3 sum(0);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        sum += profile.bodies[i].massKg / profile.totalMassKg * bodies[i].worldFromBody.translation;
    return sum;
}

// In the middle between two frames, with a step of half a frame, the velocities are those between the frames.
void checkVelocities(const RagdollAsset& asset, const animation::Clip& clip, int frame) {
    const float interval = 1.0F / clip.framesPerSecond;
    const auto simulation = startFrom(asset, clip, (static_cast<float>(frame) + 0.5F) * interval, 0.5F * interval);
    const auto start = bodiesOf(*simulation);
    const auto before = bodiesAt(*simulation, clip, frame);
    const auto after = bodiesAt(*simulation, clip, frame + 1);
    // The fall's own placement may turn or throw the doll; "drop" does neither.
    float worst = 0;
    for (std::size_t i = 0; i < start.size(); ++i) {
        const RigidTransform& a = before[i].worldFromBody;
        const RigidTransform& b = after[i].worldFromBody;
        const vec3 speed = (b.translation - a.translation) / interval;
        const vec3 turn = rotationVector(b.rotation * glm::conjugate(a.rotation)) / interval;
        worst = std::max(worst, glm::distance(start[i].linearVelocity, speed) / (1.0F + glm::length(speed)));
        worst = std::max(worst, glm::distance(start[i].angularVelocity, turn) / (1.0F + glm::length(turn)));
    }
    CHECK(worst < 0.02F);

    // Left alone, the doll goes on as the clip does: joints push inside it, but cannot push its centre.
    const vec3 centre = centreOf(asset.profile, start);
    const vec3 speed = (centreOf(asset.profile, after) - centreOf(asset.profile, before)) / interval;
    simulation->step();
    const vec3 moved = centreOf(asset.profile, bodiesOf(*simulation)) - centre;
    CHECK(glm::distance(moved, speed * (0.5F * interval)) < 0.05F * glm::length(moved) + 0.001F);
}

}  // namespace

TEST_CASE("a fall from a clip of a real model starts with the clip's velocities and goes on as the clip does") {
    NEEDS_ZOO();
    int clips = 0;
    for (const char* file :
         {"cesium_man_glb/CesiumMan.glb", "lumberjack_rigify/lumberjack.glb", "khronos_rigged_figure/RiggedFigure.glb",
          "quaternius_man_fbx/Male_Casual.fbx", "raylib_robot/robot.glb", "bvh_boxing/Boxing_Toes.bvh"}) {
        INFO(file);
        const auto asset = load(file);
        int taken = 0;
        for (const animation::Clip& clip : asset->character.clips) {
            if (clip.frameCount < 5 || taken == 3) continue;
            ++taken;
            INFO(clip.name);
            for (const int frame : {0, clip.frameCount / 3, clip.frameCount - 2})
                checkVelocities(*asset, clip, frame);
        }
        clips += taken;
    }
    CHECK(clips >= 6);
}

TEST_CASE("a moment outside of a clip is refused, and its end has the velocities of its last step") {
    NEEDS_ZOO();
    const auto asset = load("cesium_man_glb/CesiumMan.glb");
    const animation::Clip& clip = asset->character.clips.front();
    const auto hash = [&](float seconds) { return startFrom(*asset, clip, seconds, 1.0F / 60.0F)->stateHash(); };
    for (const float outside : {clip.seconds() + 5.0F, -1.0F}) {
        scene::SimulationOptions options;
        options.fromClip = scene::ClipStart{clip.name, outside};
        const auto refused = scene::startBodies(*asset, options, {});
        REQUIRE_FALSE(refused.ok());
        CHECK(refused.error().code == ErrorCode::usage);
    }
    CHECK(hash(0.0F) != hash(0.5F * clip.seconds()));
    // At the end the clip still moves: one-sided differences over its last step.
    const auto end = startFrom(*asset, clip, clip.seconds(), 1.0F / clip.framesPerSecond);
    const auto last = bodiesAt(*end, clip, clip.frameCount - 1);
    const auto before = bodiesAt(*end, clip, clip.frameCount - 2);
    const vec3 speed = (last[0].worldFromBody.translation - before[0].worldFromBody.translation) * clip.framesPerSecond;
    CHECK(glm::distance(bodiesOf(*end)[0].linearVelocity, speed) < 0.02F * (1.0F + glm::length(speed)));
}
