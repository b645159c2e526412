#include "render/bounds.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/aabb.hpp"
#include "core/assert.hpp"

namespace lutka::render {
namespace {

BoundingSphere sphereAround(const Aabb& box) {
    if (box.empty()) return {};
    return {box.middle(), 0.5F * box.diagonal()};
}

}  // namespace

BoundingSphere enclosing(const BoundingSphere& a, const BoundingSphere& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    const float apart = glm::length(b.center - a.center);
    if (apart + b.radius <= a.radius) return a;
    if (apart + a.radius <= b.radius) return b;
    const float radius = 0.5F * (apart + a.radius + b.radius);
    const vec3 towards = apart > 0.0F ? (b.center - a.center) / apart : vec3(0);
    return {a.center + towards * (radius - a.radius), radius};
}

std::vector<BoundingSphere> jointBounds(const animation::Character& character) {
    std::vector<Aabb> boxes(character.skeleton.parents.size());
    for (const animation::SkinnedMesh& mesh : character.meshes) {
        for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
            for (int slot = 0; slot < animation::kMaxInfluences; ++slot) {
                if (mesh.weights[vertex][slot] > 0.0F) boxes[mesh.joints[vertex][slot]].add(mesh.positions[vertex]);
            }
        }
    }
    std::vector<BoundingSphere> spheres;
    spheres.reserve(boxes.size());
    for (const Aabb& box : boxes)
        spheres.push_back(sphereAround(box));
    return spheres;
}

BoundingSphere posedBounds(std::span<const BoundingSphere> joints, std::span<const animation::SkinMatrix> palette,
                           const RigidTransform& worldFromModel) {
    LUTKA_ASSERT(joints.size() == palette.size());
    Aabb box;
    for (std::size_t joint = 0; joint < joints.size(); ++joint) {
        if (joints[joint].empty()) continue;
        const vec4 bind(joints[joint].center, 1.0F);
        const vec4* rows = palette[joint].rows;
        const vec3 center(glm::dot(rows[0], bind), glm::dot(rows[1], bind), glm::dot(rows[2], bind));
        box.add(center - joints[joint].radius);
        box.add(center + joints[joint].radius);
    }
    BoundingSphere sphere = sphereAround(box);
    if (!sphere.empty()) sphere.center = worldFromModel * sphere.center;
    return sphere;
}

BoundingSphere boundsOf(const PropItem& prop) {
    float radius = prop.radius;
    if (prop.kind == ShapeKind::capsule) radius += prop.halfLength;
    if (prop.kind == ShapeKind::box) radius = glm::length(prop.halfExtents);
    if (prop.kind == ShapeKind::plane) radius = glm::length(vec2(prop.halfExtents.x, prop.halfExtents.z));
    return {prop.worldFromShape.translation, radius};
}

bool mayBeSeen(const BoundingSphere& sphere, const mat4& clipFromWorld) {
    if (sphere.empty()) return false;
    const auto row = [&](int i) {
        return vec4(clipFromWorld[0][i], clipFromWorld[1][i], clipFromWorld[2][i], clipFromWorld[3][i]);
    };
    const vec4 w = row(3);
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {-1.0F, 1.0F}) {
            const vec4 plane = w + sign * row(axis);
            const float distance = glm::dot(plane, vec4(sphere.center, 1.0F));
            if (distance < -sphere.radius * glm::length(vec3(plane))) return false;
        }
    }
    return true;
}

}  // namespace lutka::render
