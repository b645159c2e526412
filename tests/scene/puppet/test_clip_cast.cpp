#include "scene/puppet/clip_cast.hpp"

#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "scene/run/simulation.hpp"
#include "support/catch.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using namespace lutka::scene;

namespace {

constexpr float kSpeed = 1.2F;  // m/s ahead

// A second of the biped going ahead and lifting an arm.
animation::Character walkingBiped() {
    animation::Character character = test::makeBiped();
    const animation::Skeleton& skeleton = character.skeleton;
    const int arm = animation::findJoint(skeleton, "leftUpperArm");
    animation::Clip clip;
    clip.name = "go";
    clip.frameCount = 31;
    for (int frame = 0; frame < clip.frameCount; ++frame) {
        const float seconds = static_cast<float>(frame) / clip.framesPerSecond;
        std::vector<RigidTransform> pose(skeleton.parents.size());
        animation::modelToLocal(skeleton, skeleton.bindModelFromJoint, pose);
        pose[0].translation += vec3(0, 0, kSpeed * seconds);
        pose[arm].rotation = glm::angleAxis(std::sin(2.0F * kPi * seconds), vec3(0, 0, 1));
        clip.parentFromJoint.append(pose);
    }
    character.clips.push_back(clip);
    return character;
}

std::unique_ptr<Simulation> playing(const RagdollAsset& asset, const ClipPlay& play, int count = 1) {
    SimulationOptions options;
    options.play = play;
    auto scenario = makeScenario({.name = "drop", .count = count}, asset);
    REQUIRE(scenario);
    auto simulation = Simulation::create(asset, std::move(scenario).value(), options);
    REQUIRE(simulation);
    return std::move(simulation).value();
}

}  // namespace

TEST_CASE("a doll that plays a clip shows its poses, and its bodies go with them at their velocities") {
    const auto asset = makeRagdoll(walkingBiped());
    REQUIRE(asset);
    const animation::Character& character = asset.value()->character;
    const auto simulation = playing(*asset.value(), {.start = {"go", 0.2F}}, 2);
    std::vector<RigidTransform> expected(character.skeleton.parents.size());
    std::vector<RigidTransform> got(expected.size());
    for (int step = 0; step < 20; ++step)
        simulation->step();
    animation::sampleClip(character.clips[0], 0.2F + 20.0F / 60.0F, expected);
    animation::localToModel(character.skeleton, expected, expected);
    simulation->pose(1, 1.0F, got);
    const auto skinned = simulation->poseSkins(1.0F).modelFromJoint(1);
    for (std::size_t joint = 0; joint < got.size(); ++joint) {
        CHECK(glm::distance(got[joint].translation, expected[joint].translation) < 1e-3F);
        CHECK(glm::distance(skinned[joint].translation, expected[joint].translation) < 1e-3F);
    }
    std::vector<physics::BodyState> bodies(asset.value()->profile.bodies.size());
    simulation->getBodies(0, bodies);
    const vec3 ahead = simulation->worldFromModel(0).rotation * vec3(0, 0, kSpeed);
    CHECK(glm::distance(bodies[0].linearVelocity, ahead) < 0.01F);
    CHECK(simulation->quality().initialEnergyJ == 0.0);
}

TEST_CASE("a looped clip's way goes on over its seam, in place it does not, and reset brings both back") {
    const auto asset = makeRagdoll(walkingBiped());
    REQUIRE(asset);
    for (const bool inPlace : {false, true}) {
        const auto simulation = playing(*asset.value(), {.start = {"go", 0.0F}, .inPlace = inPlace});
        const std::uint64_t start = simulation->stateHash();
        for (int step = 0; step < 150; ++step)
            simulation->step();
        CHECK(simulation->clipCast()->travelM(0) == Approx(inPlace ? 0.0F : kSpeed * 2.5F).margin(2e-3));
        simulation->reset();
        CHECK(simulation->stateHash() == start);
    }
}

TEST_CASE("a clip that is not there, or has no such moment, is a usage error") {
    const auto asset = makeRagdoll(walkingBiped());
    REQUIRE(asset);
    const RagdollAsset* pointer = asset.value().get();
    for (const ClipStart& start : {ClipStart{"fly", 0.0F}, ClipStart{"go", 3.0F}, ClipStart{"go", -1.0F}}) {
        const auto cast = ClipCast::create(std::span(&pointer, 1), {.start = start});
        REQUIRE(!cast);
        CHECK(cast.error().code == ErrorCode::usage);
    }
}
