#include "world_table.hpp"

#include <glm/geometric.hpp>

#include "physics/bullet/bullet_world.hpp"
#include "physics/collision/shape.hpp"
#include "physics/crowd/crowd_world.hpp"
#include "physics/rig/rig.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"
#include "support/rigs.hpp"

namespace lutka::test {

using physics::BodyState;
using physics::RagdollProfile;
using physics::StaticShape;
using physics::TriangleMesh;
using physics::World;

std::unique_ptr<World> worldOf(physics::SolverKind solver, physics::WorldSettings settings) {
    settings.solver = solver;
    return solver == physics::SolverKind::crowd ? physics::createCrowdWorld(settings)
                                                : physics::createBulletWorld(settings);
}

namespace {

RagdollProfile single(const physics::BodyShape& shape, float massKg) {
    RagdollProfile profile;
    profile.name = "single";
    profile.totalMassKg = massKg;
    profile.bodies.emplace_back();
    setRole(profile.bodies.back(), animation::Role::hips);
    profile.bodies[0].shape = shape;
    profile.bodies[0].massKg = massKg;
    profile.bodies[0].inertia = physics::shapeInertia(shape, massKg);
    return profile;
}

std::shared_ptr<const TriangleMesh> made(const std::vector<vec3>& vertices,
                                         const std::vector<TriangleMesh::Triangle>& triangles) {
    auto mesh = TriangleMesh::make(vertices, triangles);
    REQUIRE(mesh.ok());
    return std::move(mesh).value();
}

}  // namespace

RagdollProfile rodProfile(float halfLength, float radius, float massKg) {
    physics::BodyShape shape;
    shape.halfLength = halfLength;
    shape.radius = radius;
    return single(shape, massKg);
}

RagdollProfile crateProfile(const vec3& halfExtents, float massKg) {
    physics::BodyShape shape;
    shape.kind = physics::BodyShape::Kind::box;
    shape.halfExtents = halfExtents;
    return single(shape, massKg);
}

BodyState stateAt(const vec3& position, const quat& rotation, const vec3& velocity) {
    return {{rotation, position}, velocity, vec3(0)};
}

std::vector<BodyState> bodiesOfDoll(const World& world, int doll) {
    const physics::DollId id = world.dolls()[doll];
    std::vector<BodyState> bodies(world.profileOf(id).bodies.size());
    world.getBodies(id, bodies);
    return bodies;
}

BodyState bodyOfDoll(const World& world, int doll, int body) {
    return bodiesOfDoll(world, doll)[body];
}

std::vector<BodyState> standingDoll(const RagdollProfile& profile, const vec3& position, const quat& turn,
                                    const vec3& velocity) {
    static const animation::Skeleton skeleton = makeBiped().skeleton;
    const auto rig = physics::bindRig(profile, skeleton);
    REQUIRE(rig.ok());
    const vec3 middle(0, 0.9F, 0);
    std::vector<BodyState> bodies(profile.bodies.size());
    bodiesFromPose(rig.value(), skeleton.bindModelFromJoint, {turn, position + middle - turn * middle}, bodies);
    for (BodyState& body : bodies)
        body.linearVelocity = velocity;
    return bodies;
}

void stepSeconds(World& world, float seconds) {
    for (int i = 0; i < static_cast<int>(seconds / kFrame + 0.5F); ++i)
        world.step(kFrame);
}

physics::Quality measureSeconds(World& world, std::span<const StaticShape> statics, float seconds) {
    physics::QualityMeter meter(world, statics, {0, -9.81F, 0});
    double time = 0;
    for (int i = 0; i < static_cast<int>(seconds / kFrame + 0.5F); ++i)
        world.step(kFrame, [&] { meter.sample(time += static_cast<double>(kFrame) / world.substepsPerStep()); });
    return meter.result();
}

std::shared_ptr<const TriangleMesh> gridMesh(int cells, float size, float (*height)(float, float)) {
    std::vector<vec3> vertices;
    std::vector<TriangleMesh::Triangle> triangles;
    for (int row = 0; row <= cells; ++row) {
        for (int column = 0; column <= cells; ++column) {
            const float x = size * (static_cast<float>(column) / static_cast<float>(cells) - 0.5F);
            const float z = size * (static_cast<float>(row) / static_cast<float>(cells) - 0.5F);
            vertices.emplace_back(x, height != nullptr ? height(x, z) : 0.0F, z);
        }
    }
    const int side = cells + 1;
    for (int row = 0; row < cells; ++row) {
        for (int column = 0; column < cells; ++column) {
            const int at = row * side + column;
            triangles.push_back({at, at + side, at + 1});
            triangles.push_back({at + 1, at + side, at + side + 1});
        }
    }
    return made(vertices, triangles);
}

std::shared_ptr<const TriangleMesh> boxMesh(const vec3& half) {
    std::vector<vec3> vertices;
    for (int i = 0; i < 8; ++i)
        vertices.push_back(half * vec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1));
    return made(vertices, {{0, 2, 1},
                           {1, 2, 3},
                           {4, 5, 6},
                           {5, 7, 6},
                           {0, 1, 4},
                           {1, 5, 4},
                           {2, 6, 3},
                           {3, 6, 7},
                           {0, 4, 2},
                           {2, 4, 6},
                           {1, 3, 5},
                           {3, 7, 5}});
}

StaticShape staticMesh(std::shared_ptr<const TriangleMesh> mesh, const vec3& position) {
    StaticShape shape;
    shape.kind = StaticShape::Kind::mesh;
    shape.mesh = std::move(mesh);
    shape.worldFromShape.translation = position;
    return shape;
}

StaticShape staticBoxAt(const vec3& centre, const vec3& halfExtents) {
    StaticShape shape;
    shape.kind = StaticShape::Kind::box;
    shape.worldFromShape.translation = centre;
    shape.halfExtents = halfExtents;
    return shape;
}

}  // namespace lutka::test
