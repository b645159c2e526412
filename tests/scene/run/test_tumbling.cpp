// Free flight: nothing but the joints' own forces, which can change neither the momentum nor the angular momentum.
#include <algorithm>
#include <glm/geometric.hpp>

#include "physics/crowd/crowd_world.hpp"
#include "support/catch.hpp"
#include "support/falls.hpp"
#include "support/zoo.hpp"

using namespace lutka;
using physics::BodyState;

namespace {

constexpr float kStep = 1.0F / 60.0F;

// Of the whole doll about its centre of mass, in double precision: the loss that is looked for is small.
struct Motion {
    glm::dvec3 angularMomentum{0, 0, 0};
    double energy = 0;
};

Motion motionOf(const physics::World& world, physics::DollId doll) {
    const physics::RagdollProfile& profile = world.profileOf(doll);
    std::vector<BodyState> bodies(profile.bodies.size());
    world.getBodies(doll, bodies);
    glm::dvec3 centre(0), momentum(0);
    double mass = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const double m = static_cast<double>(profile.bodies[i].massKg);
        centre += m * glm::dvec3(bodies[i].worldFromBody.translation);
        momentum += m * glm::dvec3(bodies[i].linearVelocity);
        mass += m;
    }
    centre /= mass;
    Motion motion;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const double m = static_cast<double>(profile.bodies[i].massKg);
        const glm::dquat rotation(bodies[i].worldFromBody.rotation);
        const glm::dvec3 inertia(world.inertiaOf(doll, static_cast<int>(i)));
        const glm::dvec3 rate = glm::conjugate(rotation) * glm::dvec3(bodies[i].angularVelocity);
        const glm::dvec3 velocity = glm::dvec3(bodies[i].linearVelocity) - momentum / mass;
        const glm::dvec3 arm = glm::dvec3(bodies[i].worldFromBody.translation) - centre;
        motion.angularMomentum += m * glm::cross(arm, velocity) + rotation * (inertia * rate);
        motion.energy += 0.5 * (m * glm::dot(velocity, velocity) + glm::dot(inertia * rate, rate));
    }
    return motion;
}

// What two seconds of tumbling cost.
struct Loss {
    double angularMomentum = 0;  // share of it
    double energy = 0;           // share that is gone at the end; negative: gained
    double growth = 0;           // largest rise over the least energy before, as a share
};

Loss tumble(const physics::RagdollProfile& profile, physics::World& world, std::vector<BodyState> bodies,
            const vec3& rate) {
    vec3 centre(0);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        centre += bodies[i].worldFromBody.translation * (profile.bodies[i].massKg / profile.totalMassKg);
    for (BodyState& body : bodies) {
        body.linearVelocity = glm::cross(rate, body.worldFromBody.translation - centre);
        body.angularVelocity = rate;
    }
    const physics::DollId doll = world.addDoll(profile, bodies);
    const Motion start = motionOf(world, doll);
    double least = start.energy;
    Loss loss;
    for (int i = 0; i < 120; ++i) {
        world.step(kStep);
        const double energy = motionOf(world, doll).energy;
        least = std::min(least, energy);
        loss.growth = std::max(loss.growth, (energy - least) / start.energy);
    }
    const Motion end = motionOf(world, doll);
    loss.angularMomentum =
        glm::distance(end.angularMomentum, start.angularMomentum) / glm::length(start.angularMomentum);
    loss.energy = 1.0 - end.energy / start.energy;
    return loss;
}

std::unique_ptr<physics::World> emptySpace() {
    physics::WorldSettings settings;
    settings.gravity = vec3(0);
    settings.sleeping = false;
    settings.linearDamping = settings.angularDamping = 0.0F;
    return physics::createCrowdWorld(settings);
}

// Bodies that pass through each other.
physics::RagdollProfile withoutContacts(physics::RagdollProfile profile) {
    for (int a = 0; a < static_cast<int>(profile.bodies.size()); ++a) {
        for (int b = a + 1; b < static_cast<int>(profile.bodies.size()); ++b)
            profile.filteredPairs.emplace_back(a, b);
    }
    return profile;
}

// Joints that neither rub nor stop as well: nothing is left that takes energy.
physics::RagdollProfile withoutLosses(physics::RagdollProfile profile) {
    for (physics::ConstraintProfile& constraint : profile.constraints) {
        constraint.kind = physics::ConstraintProfile::Kind::coneTwist;
        constraint.cone = {1e3F, 1e3F, 1e3F};
        constraint.frictionNm = 0.0F;
    }
    return withoutContacts(std::move(profile));
}

void checkTumbling(const scene::RagdollAsset& asset) {
    for (const vec3& axis : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(1, 1, 1)}) {
        std::vector<BodyState> bodies(asset.profile.bodies.size());
        physics::bodiesFromPose(asset.rig, asset.character.skeleton.bindModelFromJoint, {}, bodies);
        const vec3 rate = 7.0F * glm::normalize(axis);
        CAPTURE(asset.character.name, axis.x, axis.y, axis.z);
        CHECK(tumble(asset.profile, *emptySpace(), bodies, rate).angularMomentum < 0.003);
        CHECK(tumble(withoutContacts(asset.profile), *emptySpace(), bodies, rate).angularMomentum < 0.003);
        const Loss free = tumble(withoutLosses(asset.profile), *emptySpace(), bodies, rate);
        CHECK(free.angularMomentum < 0.003);
        CHECK(std::abs(free.energy) < 0.01);
        CHECK(free.growth < 0.01);
    }
}

}  // namespace

// It lost 9 % in two seconds, in proportion to the substep.
TEST_CASE("a doll that tumbles at 7 rad/s keeps its angular momentum, and its energy where nothing takes any") {
    const auto asset = test::loadFigure(LUTKA_ASSETS_DIR "/models/mannequin.glb");
    REQUIRE(asset.ok());
    checkTumbling(*asset.value());
}

TEST_CASE("real models keep their angular momentum when they tumble") {
    NEEDS_ZOO();
    for (const char* file : {"quaternius_man_fbx/Male_Casual.fbx", "rocketbox_male/Male_Adult_17.fbx",
                             "makehuman_mixamo/makehuman_mixamo.glb", "minetest_character/character.b3d",
                             "raylib_greenman/greenman.glb", "ubiq_robot/ubiqrobot.fbx"}) {
        const auto asset = test::loadFigure(test::zooFile(file).string());
        REQUIRE(asset.ok());
        checkTumbling(*asset.value());
    }
}
