#include "scene/draw/scene_extent.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/aabb.hpp"
#include "scene/asset/body_bounds.hpp"

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
        case StaticShape::Kind::hull:  // of bodies alone
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

bool hasFloor(const Scenario& scenario) {
    return std::any_of(scenario.statics.begin(), scenario.statics.end(), [](const StaticShape& shape) {
        return shape.kind == StaticShape::Kind::plane && shape.worldFromShape.rotation.w > 0.999F;
    });
}

// Below a doll, from the points around it: where it will land, and how far it will reach when it lies there.
void addGround(std::vector<vec3>& points, std::size_t first) {
    Aabb box;
    const std::size_t end = points.size();
    for (std::size_t i = first; i < end; ++i) {
        box.add(points[i]);
        if (points[i].y > 0.0F) points.emplace_back(points[i].x, 0.0F, points[i].z);
    }
    if (box.low.y <= 0.0F) return;
    constexpr float kShare = 0.85F;  // of its height, from where its middle is now: 38 of 40 falls of the mannequin
    const vec3 middle = box.middle();
    const float reach = kShare * box.size().y;
    for (const float way : {-reach, reach}) {
        points.emplace_back(middle.x + way, 0.0F, middle.z);
        points.emplace_back(middle.x, 0.0F, middle.z + way);
    }
}

}  // namespace

void addExtentOfDoll(Simulation& simulation, int doll, float alpha, std::vector<vec3>& points) {
    const std::vector<physics::BodyProfile>& bodies = simulation.assetOf(doll).profile.bodies;
    const auto places = simulation.worldFromBody(doll, alpha);
    for (std::size_t body = 0; body < bodies.size(); ++body)
        addAround(places[body], bodies[body].shape, points);
    const auto skin = simulation.skinReachOf(doll);
    for (std::size_t body = 0; body < skin.size(); ++body)
        for (const vec3& point : skin[body])
            points.push_back(places[body] * point);
}

void addExtentOfScene(Simulation& simulation, float alpha, std::vector<vec3>& points) {
    const Scenario& scenario = simulation.scenario();
    const bool floor = hasFloor(scenario);
    for (int doll = 0; doll < simulation.dollCount(); ++doll) {
        const std::size_t first = points.size();
        addExtentOfDoll(simulation, doll, alpha, points);
        if (floor && points.size() > first) addGround(points, first);
    }
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
