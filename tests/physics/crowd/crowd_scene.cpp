#include "crowd_scene.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/random.hpp"
#include "physics/collision/shape.hpp"
#include "support/dolls.hpp"
#include "support/rigs.hpp"

namespace lutka::test {

using physics::BodyState;
using physics::RagdollProfile;
using physics::StaticShape;

std::vector<BodyState> placedDoll(const RagdollProfile& profile, const vec3& offset, const quat& turn,
                                  const vec3& velocity) {
    const vec3 middle(0, 0.9F, 0);
    const animation::Character biped = makeBiped();
    std::vector<BodyState> bodies(profile.bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const int joint = animation::findJoint(biped.skeleton, profile.bodies[i].joint);
        const RigidTransform modelFromBody = biped.skeleton.bindModelFromJoint[joint] * profile.bodies[i].jointFromBody;
        bodies[i].worldFromBody = RigidTransform{turn, offset + middle - turn * middle} * modelFromBody;
        bodies[i].linearVelocity = velocity;
    }
    return bodies;
}

RagdollProfile makeRod(float halfLength, float radius, float massKg) {
    RagdollProfile profile;
    profile.name = "rod";
    profile.totalMassKg = massKg;
    profile.bodies.emplace_back();
    setRole(profile.bodies.back(), animation::Role::hips);
    profile.bodies[0].shape.halfLength = halfLength;
    profile.bodies[0].shape.radius = radius;
    profile.bodies[0].massKg = massKg;
    profile.bodies[0].inertia = physics::shapeInertia(profile.bodies[0].shape, massKg);
    return profile;
}

Limbs besideEachOther(const std::vector<float>& sides, float apart) {
    Limbs limbs{makePair(physics::ConeTwistLimits{radians(60), radians(60), radians(60)}, 10.0F), {}};
    physics::RagdollProfile& doll = limbs.doll;
    doll.bodies[0].massKg = 30.0F;
    const physics::BodyProfile limb = doll.bodies[1];
    const physics::ConstraintProfile joint = doll.constraints[0];
    doll.bodies[1].massKg = 0.4F;
    for (const float side : sides) {
        doll.constraints.push_back(joint);
        doll.constraints.back().child = static_cast<int>(doll.bodies.size());
        doll.constraints.back().parentFromFrame =
            joint.parentFromFrame * RigidTransform{quat(1, 0, 0, 0), {0, side * apart, 0}};
        doll.bodies.push_back(limb);
    }
    doll.totalMassKg = 0.0F;
    for (const physics::BodyProfile& body : doll.bodies) {
        doll.totalMassKg += body.massKg;
        limbs.bodies.push_back({});
        limbs.bodies.back().worldFromBody = body.jointFromBody;
    }
    for (std::size_t i = 0; i < sides.size(); ++i)
        limbs.bodies[i + 2].worldFromBody.translation.y += sides[i] * apart;
    return limbs;
}

float lowestPoint(const RagdollProfile& profile, const std::vector<BodyState>& bodies) {
    float low = 1e9F;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const physics::BodyShape& shape = profile.bodies[i].shape;
        const RigidTransform& at = bodies[i].worldFromBody;
        low = std::min(low, at.translation.y - std::abs((at.rotation * vec3(0, shape.halfLength, 0)).y) - shape.radius);
    }
    return low;
}

StaticShape floorPlane() {
    return {};
}

StaticShape staticBox(const vec3& centre, const vec3& halfExtents) {
    StaticShape shape;
    shape.kind = StaticShape::Kind::box;
    shape.worldFromShape.translation = centre;
    shape.halfExtents = halfExtents;
    return shape;
}

void fillPit(physics::World& world, const RagdollProfile& profile, int count, std::vector<StaticShape>& statics,
             float apart) {
    statics = {floorPlane(), staticBox({3.5F, 4, 0}, {0.5F, 4, 4}), staticBox({-3.5F, 4, 0}, {0.5F, 4, 4}),
               staticBox({0, 4, 3.5F}, {4, 4, 0.5F}), staticBox({0, 4, -3.5F}, {4, 4, 0.5F})};
    for (const StaticShape& shape : statics)
        world.addStatic(shape);
    Random random(7);
    for (int i = 0; i < count; ++i) {
        const int place = i % 16;
        const vec3 offset(1.2F * static_cast<float>(place % 4) - 1.8F, 0.4F + apart * static_cast<float>(i / 16),
                          1.2F * static_cast<float>(place / 4) - 1.8F);
        const vec3 axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1F, 1));
        world.addDoll(profile, placedDoll(profile, offset, glm::angleAxis(random.uniform(0, 3), glm::normalize(axis))));
    }
}

std::vector<BodyState> bodiesOf(const physics::World& world, int doll) {
    const physics::DollId id = world.dolls()[doll];
    std::vector<BodyState> bodies(world.profileOf(id).bodies.size());
    world.getBodies(id, bodies);
    return bodies;
}

Totals totalsOf(const physics::World& world, int doll) {
    Totals totals;
    const std::vector<BodyState> bodies = bodiesOf(world, doll);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const physics::BodyProfile& body = world.profileOf(world.dolls()[doll]).bodies[i];
        const quat& rotation = bodies[i].worldFromBody.rotation;
        const vec3 spin = rotation * (body.inertia * (glm::conjugate(rotation) * bodies[i].angularVelocity));
        totals.massKg += body.massKg;
        totals.centre += body.massKg * bodies[i].worldFromBody.translation;
        totals.momentum += body.massKg * bodies[i].linearVelocity;
        totals.angularMomentum +=
            spin + glm::cross(bodies[i].worldFromBody.translation, body.massKg * bodies[i].linearVelocity);
    }
    totals.centre /= totals.massKg;
    return totals;
}

std::uint64_t stateHash(const physics::World& world) {
    std::uint64_t hash = kHashStart;
    for (int doll = 0; doll < static_cast<int>(world.dolls().size()); ++doll) {
        for (const BodyState& body : bodiesOf(world, doll))
            hash = hashBytes(&body, sizeof body, hash);
    }
    return hash;
}

physics::Quality stepAndMeasure(physics::World& world, const std::vector<StaticShape>& statics, float seconds) {
    physics::QualityMeter meter(world, statics, vec3(0, -9.81F, 0));
    double time = 0;
    const double substep = static_cast<double>(kStep) / world.substepsPerStep();
    for (int i = 0; i < static_cast<int>(std::lround(seconds / kStep)); ++i)
        world.step(kStep, [&] { meter.sample(time += substep); });
    return meter.result();
}

}  // namespace lutka::test
