#include "support/tumbling.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "physics/rig/rig.hpp"
#include "scene/run/make_world.hpp"

namespace lutka::test {

using physics::BodyState;

namespace {

constexpr float kStep = 1.0F / 60.0F;

// Of the whole doll about its centre of mass, in double precision: the loss that is looked for is small.
struct Motion {
    glm::dvec3 angularMomentum{0, 0, 0};
    glm::dvec3 velocity{0, 0, 0};  // of the centre of mass
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
    motion.velocity = momentum / mass;
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

}  // namespace

std::unique_ptr<physics::World> emptySpace(physics::SolverKind solver) {
    physics::WorldSettings settings;
    settings.solver = solver;
    settings.gravity = vec3(0);
    settings.sleeping = false;
    settings.linearDamping = settings.angularDamping = 0.0F;
    return scene::makeWorld(settings);
}

physics::RagdollProfile withoutContacts(physics::RagdollProfile profile) {
    for (int a = 0; a < static_cast<int>(profile.bodies.size()); ++a) {
        for (int b = a + 1; b < static_cast<int>(profile.bodies.size()); ++b)
            profile.filteredPairs.emplace_back(a, b);
    }
    return profile;
}

physics::RagdollProfile withoutLosses(physics::RagdollProfile profile) {
    for (physics::ConstraintProfile& constraint : profile.constraints) {
        constraint.kind = physics::ConstraintProfile::Kind::coneTwist;
        constraint.cone = {1e3F, 1e3F, 1e3F};
        constraint.frictionNm = 0.0F;
    }
    return withoutContacts(std::move(profile));
}

Loss tumble(const scene::RagdollAsset& asset, const physics::RagdollProfile& profile, physics::World& world,
            const vec3& rate) {
    std::vector<BodyState> bodies(profile.bodies.size());
    physics::bodiesFromPose(asset.rig, asset.character.skeleton.bindModelFromJoint, {}, bodies);
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
    loss.momentum = glm::distance(end.velocity, start.velocity);
    loss.energy = 1.0 - end.energy / start.energy;
    return loss;
}

}  // namespace lutka::test
