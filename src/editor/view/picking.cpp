#include "editor/view/picking.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace lutka::editor {
namespace {

constexpr float kPickReach = 100.0F;  // metres

vec3 boxNormal(const PickTarget& target, const vec3& world) {
    const vec3 local = inverse(target.worldFromBox) * world / target.halfExtents;
    const vec3 size = glm::abs(local);
    int axis = 0;
    if (size.y > size[axis]) axis = 1;
    if (size.z > size[axis]) axis = 2;
    vec3 normal(0);
    normal[axis] = local[axis] < 0.0F ? -1.0F : 1.0F;
    return target.worldFromBox.rotation * normal;
}

struct Solid {
    physics::RayHit hit;
    float distance = 0.0F;
};

// The first doll on the way, or the first thing at all when geometry stops the ray.
std::optional<Solid> firstSolid(const render::Ray& ray, const physics::WorldView& world, bool throughGeometry) {
    constexpr int mostLayers = 16;
    constexpr float beyond = 0.01F;  // metres past a surface, where the next cast starts
    float start = 0.0F;
    for (int layer = 0; layer < mostLayers && start < kPickReach; ++layer) {
        const auto hit = world.rayTest(ray.origin + ray.direction * start, ray.origin + ray.direction * kPickReach);
        if (!hit) return std::nullopt;
        const float distance = start + hit->fraction * (kPickReach - start);
        if (hit->doll.isSet() || !throughGeometry) return Solid{*hit, distance};
        start = distance + beyond;
    }
    return std::nullopt;
}

}  // namespace

std::optional<float> rayBox(const render::Ray& ray, const RigidTransform& worldFromBox, const vec3& halfExtents) {
    const RigidTransform boxFromWorld = inverse(worldFromBox);
    const vec3 origin = boxFromWorld * ray.origin;
    const vec3 direction = boxFromWorld.rotation * ray.direction;
    float enter = 0.0F;
    float leave = std::numeric_limits<float>::max();
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0F) {
            if (std::abs(origin[axis]) > halfExtents[axis]) return std::nullopt;
            continue;
        }
        const float a = (-halfExtents[axis] - origin[axis]) / direction[axis];
        const float b = (halfExtents[axis] - origin[axis]) / direction[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    if (enter > leave) return std::nullopt;
    return enter;
}

PickedRay pickAlong(const render::Ray& ray, const scene::Simulation& simulation, std::span<const PickTarget> targets,
                    bool throughGeometry) {
    PickedRay found;
    found.distance = kPickReach;
    float most = std::numeric_limits<float>::max();
    if (const auto solid = firstSolid(ray, simulation.world(), throughGeometry)) {
        const physics::RayHit& hit = solid->hit;
        found.distance = most = solid->distance;
        if (hit.doll.isSet()) {
            const Item body{Item::Kind::body, simulation.dollOf(hit.doll), hit.body};
            found.pick = Pick{body, hit.position, hit.normal, body};
        }
    }
    // What the world hit may be the very object: its slab is met at the same distance, and must win.
    constexpr float tie = 0.01F;
    most += tie;
    for (const PickTarget& target : targets) {
        const auto entered = rayBox(ray, target.worldFromBox, target.halfExtents);
        if (!entered || *entered > kPickReach) continue;
        if (found.marker && !target.marker) continue;
        if (found.marker == target.marker && *entered > most) continue;
        const vec3 at = ray.origin + ray.direction * *entered;
        found.pick = Pick{{Item::Kind::object, 0, target.entity}, at, boxNormal(target, at), {}};
        most = *entered;
        found.distance = std::min(found.distance, *entered);
        found.marker = target.marker;
    }
    return found;
}

std::optional<Pick> pick(const render::Ray& ray, const scene::Simulation& simulation,
                         std::span<const PickTarget> targets, bool throughGeometry) {
    return pickAlong(ray, simulation, targets, throughGeometry).pick;
}

std::optional<vec3> surfaceUnder(const render::Ray& ray, const physics::WorldView& world, float height) {
    std::optional<float> nearest;
    if (const auto hit = world.rayTest(ray.origin, ray.origin + ray.direction * kPickReach))
        nearest = hit->fraction * kPickReach;
    if (ray.direction.y < 0.0F && ray.origin.y > height) {
        const float toPlane = (height - ray.origin.y) / ray.direction.y;
        if (toPlane <= kPickReach && (!nearest || toPlane < *nearest)) nearest = toPlane;
    }
    if (!nearest) return std::nullopt;
    return ray.origin + ray.direction * *nearest;
}

}  // namespace lutka::editor
