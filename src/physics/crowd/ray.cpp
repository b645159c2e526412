#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "physics/crowd/narrowphase.hpp"

namespace lutka::physics::crowd {
namespace {

// All in the shape's own space; `along` is the whole ray.
RayTouch raySphere(const vec3& centre, float radius, const vec3& from, const vec3& along) {
    const vec3 m = from - centre;
    const float a = glm::dot(along, along);
    const float b = glm::dot(m, along);
    const float c = glm::dot(m, m) - radius * radius;
    const float discriminant = b * b - a * c;
    if (c < 0.0F || discriminant < 0.0F || a <= 0.0F) return {};
    const float t = (-b - std::sqrt(discriminant)) / a;
    if (t < 0.0F) return {};
    return {t, (m + t * along) / radius};
}

// The side of the cylinder around y between -half and half.
RayTouch rayTube(float half, float radius, const vec3& from, const vec3& along) {
    const float a = along.x * along.x + along.z * along.z;
    const float b = from.x * along.x + from.z * along.z;
    const float c = from.x * from.x + from.z * from.z - radius * radius;
    const float discriminant = b * b - a * c;
    if (c < 0.0F || discriminant < 0.0F || a <= 0.0F) return {};
    const float t = (-b - std::sqrt(discriminant)) / a;
    const vec3 hit = from + t * along;
    if (t < 0.0F || std::abs(hit.y) > half) return {};
    return {t, vec3(hit.x, 0, hit.z) / radius};
}

RayTouch rayCapsule(float half, float radius, const vec3& from, const vec3& along) {
    // A start inside one of the three parts is inside the whole, which is a miss.
    const vec3 onCore(0, std::clamp(from.y, -half, half), 0);
    if (glm::dot(from - onCore, from - onCore) < radius * radius) return {};
    const RayTouch parts[3] = {rayTube(half, radius, from, along), raySphere({0, half, 0}, radius, from, along),
                               raySphere({0, -half, 0}, radius, from, along)};
    return *std::min_element(std::begin(parts), std::end(parts),
                             [](const RayTouch& x, const RayTouch& y) { return x.fraction < y.fraction; });
}

RayTouch rayBox(const vec3& half, const vec3& from, const vec3& along) {
    float enter = -std::numeric_limits<float>::max();
    float leave = std::numeric_limits<float>::max();
    vec3 normal(0);
    for (int axis = 0; axis < 3; ++axis) {
        if (along[axis] == 0.0F) {
            if (std::abs(from[axis]) > half[axis]) return {};
            continue;
        }
        const float side = along[axis] > 0.0F ? 1.0F : -1.0F;
        const float in = (-side * half[axis] - from[axis]) / along[axis];
        const float out = (side * half[axis] - from[axis]) / along[axis];
        if (in > enter) {
            enter = in;
            normal = vec3(0);
            normal[axis] = -side;
        }
        leave = std::min(leave, out);
    }
    if (enter < 0.0F || enter > leave) return {};
    return {enter, normal};
}

RayTouch rayHull(const ConvexHull& hull, const vec3& from, const vec3& along) {
    float enter = -std::numeric_limits<float>::max();
    float leave = std::numeric_limits<float>::max();
    vec3 normal(0);
    for (const ConvexHull::Face& face : hull.faces()) {
        const float above = glm::dot(face.normal, from) - face.offset;
        const float closing = -glm::dot(face.normal, along);
        if (closing == 0.0F && above > 0.0F) return {};
        if (closing > 0.0F && above > enter * closing) {
            enter = above / closing;
            normal = face.normal;
        }
        if (closing < 0.0F) leave = std::min(leave, above / closing);
    }
    if (enter < 0.0F || enter > leave) return {};
    return {enter, normal};
}

RayTouch rayMesh(const TriangleMesh& mesh, const vec3& from, const vec3& along) {
    const TriangleMesh::Ray hit = mesh.rayTest(from, from + along);
    if (hit.triangle < 0) return {};
    return {hit.fraction, mesh.normals()[hit.triangle]};
}

}  // namespace

RayTouch rayAgainst(const PlacedShape& body, const vec3& from, const vec3& to) {
    const vec3 start = (from - body.position) * body.axes;
    const vec3 along = (to - from) * body.axes;
    const PrimitiveShape& shape = *body.shape;
    RayTouch touch;
    if (shape.kind == PrimitiveShape::Kind::sphere) touch = raySphere(vec3(0), shape.radius, start, along);
    if (shape.kind == PrimitiveShape::Kind::capsule) touch = rayCapsule(shape.halfLength, shape.radius, start, along);
    if (shape.kind == PrimitiveShape::Kind::box) touch = rayBox(shape.halfExtents, start, along);
    if (shape.kind == PrimitiveShape::Kind::hull) touch = rayHull(*shape.hull, start, along);
    touch.normal = body.axes * touch.normal;
    return touch;
}

RayTouch rayAgainst(const PlacedStatic& geometry, const vec3& from, const vec3& to) {
    const vec3 start = (from - geometry.shape.worldFromShape.translation) * geometry.axes;
    const vec3 along = (to - from) * geometry.axes;
    RayTouch touch;
    switch (geometry.shape.kind) {
        case StaticShape::Kind::box:
            touch = rayBox(geometry.shape.halfExtents, start, along);
            break;
        case StaticShape::Kind::sphere:
            touch = raySphere(vec3(0), geometry.shape.radius, start, along);
            break;
        case StaticShape::Kind::capsule:
            touch = rayCapsule(geometry.shape.halfLength, geometry.shape.radius, start, along);
            break;
        case StaticShape::Kind::mesh:
            touch = rayMesh(*geometry.shape.mesh, start, along);
            break;
        case StaticShape::Kind::hull:  // of bodies alone
            break;
        case StaticShape::Kind::plane:
            if (start.y >= 0.0F && along.y < 0.0F) touch = {start.y / -along.y, {0, 1, 0}};
            break;
    }
    touch.normal = geometry.axes * touch.normal;
    return touch;
}

}  // namespace lutka::physics::crowd
