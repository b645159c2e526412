#include "scene/scene_extent.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "scene/body_bounds.hpp"

namespace lutka::scene {
namespace {

using physics::StaticShape;

constexpr float kFast = 2.0F;  // m/s

void addCorners(const RigidTransform& world, const vec3& half, std::vector<vec3>& points) {
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 sign((corner & 1) != 0 ? 1.0F : -1.0F, (corner & 2) != 0 ? 1.0F : -1.0F,
                        (corner & 4) != 0 ? 1.0F : -1.0F);
        points.push_back(world * (sign * half));
    }
}

void addAround(const RigidTransform& world, const physics::BodyShape& shape, std::vector<vec3>& points) {
    addCorners({quat(1, 0, 0, 0), world.translation}, halfAabbOf(shape, world.rotation), points);
}

void addStatic(const StaticShape& shape, std::vector<vec3>& points) {
    switch (shape.kind) {
        case StaticShape::Kind::plane:
            return;
        case StaticShape::Kind::box:
            return addCorners(shape.worldFromShape, shape.halfExtents, points);
        case StaticShape::Kind::sphere:
            return addCorners(shape.worldFromShape, vec3(shape.radius), points);
        case StaticShape::Kind::capsule:
            return addCorners(shape.worldFromShape, vec3(shape.radius, shape.radius + shape.halfLength, shape.radius),
                              points);
        case StaticShape::Kind::mesh:
            for (const vec3& vertex : shape.mesh->vertices())
                points.push_back(shape.worldFromShape * vertex);
            return;
    }
}

// Below whoever is in the air, so that where it will land is seen.
void addGround(const Scenario& scenario, std::vector<vec3>& points) {
    const bool floor = std::any_of(scenario.statics.begin(), scenario.statics.end(), [](const StaticShape& shape) {
        return shape.kind == StaticShape::Kind::plane && shape.worldFromShape.rotation.w > 0.999F;
    });
    if (!floor) return;
    const std::size_t count = points.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (points[i].y > 0.0F) points.emplace_back(points[i].x, 0.0F, points[i].z);
    }
}

}  // namespace

void addExtentOfDoll(Simulation& simulation, int doll, float alpha, std::vector<vec3>& points) {
    const std::vector<physics::BodyProfile>& bodies = simulation.assetOf(doll).profile.bodies;
    const auto places = simulation.worldFromBody(doll, alpha);
    for (std::size_t body = 0; body < bodies.size(); ++body)
        addAround(places[body], bodies[body].shape, points);
}

void addExtentOfScene(Simulation& simulation, float alpha, std::vector<vec3>& points) {
    const Scenario& scenario = simulation.scenario();
    for (int doll = 0; doll < simulation.dollCount(); ++doll)
        addExtentOfDoll(simulation, doll, alpha, points);
    addGround(scenario, points);
    for (const StaticShape& shape : scenario.statics)
        addStatic(shape, points);
    const auto props = simulation.world().props();
    for (std::size_t i = 0; i < props.size(); ++i) {
        const physics::BodyState state = simulation.world().propState(props[i]);
        const vec3& speed = state.linearVelocity;
        if (glm::dot(speed, speed) > kFast * kFast) continue;
        addAround(state.worldFromBody, scenario.props[i].shape, points);
    }
}

}  // namespace lutka::scene
