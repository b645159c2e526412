#include "animation/dual_quaternion_skinning.hpp"

#include <glm/geometric.hpp>

#include "core/assert.hpp"

namespace lutka::animation {
namespace {

quat quaternion(const vec4& v) {
    return {v.w, v.x, v.y, v.z};
}

vec4 components(const quat& q) {
    return {q.x, q.y, q.z, q.w};
}

RigidTransform blend(const SkinnedMesh& mesh, std::size_t vertex, std::span<const DualQuaternion> palette) {
    const vec4 strongest = palette[mesh.joints[vertex][0]].real;
    DualQuaternion sum{vec4(0), vec4(0)};
    for (int slot = 0; slot < kMaxInfluences; ++slot) {
        const float weight = mesh.weights[vertex][slot];
        if (weight == 0.0F) break;  // strongest first: the rest is zero too
        const DualQuaternion& joint = palette[mesh.joints[vertex][slot]];
        const float signedWeight = glm::dot(joint.real, strongest) < 0.0F ? -weight : weight;
        sum.real += signedWeight * joint.real;
        sum.dual += signedWeight * joint.dual;
    }
    // Never near zero: all parts lie in the half space of the strongest, whose weight is at least a quarter.
    const float scale = 1.0F / glm::length(sum.real);
    const quat rotation = quaternion(sum.real * scale);
    const quat translation = quaternion(sum.dual * (2.0F * scale)) * glm::conjugate(rotation);
    return {rotation, vec3(translation.x, translation.y, translation.z)};
}

}  // namespace

DualQuaternion dualQuaternion(const SkinMatrix& matrix) {
    const vec4* rows = matrix.rows;
    const mat3 r(rows[0].x, rows[1].x, rows[2].x, rows[0].y, rows[1].y, rows[2].y, rows[0].z, rows[1].z, rows[2].z);
    const quat rotation = glm::normalize(glm::quat_cast(r));
    const quat translation(0.0F, rows[0].w, rows[1].w, rows[2].w);
    return {components(rotation), components(translation * rotation * 0.5F)};
}

void skinVerticesDual(const SkinnedMesh& mesh, std::span<const SkinMatrix> palette, std::span<vec3> positions,
                      std::span<vec3> normals) {
    LUTKA_ASSERT(positions.size() == mesh.positions.size());
    LUTKA_ASSERT(normals.empty() || normals.size() == mesh.normals.size());
    std::vector<DualQuaternion> joints(palette.size());
    for (std::size_t joint = 0; joint < palette.size(); ++joint)
        joints[joint] = dualQuaternion(palette[joint]);
    for (std::size_t vertex = 0; vertex < positions.size(); ++vertex) {
        const RigidTransform motion = blend(mesh, vertex, joints);
        positions[vertex] = motion * mesh.positions[vertex];
        if (!normals.empty()) normals[vertex] = glm::normalize(motion.rotation * mesh.normals[vertex]);
    }
}

void skinVertices(SkinningMethod method, const SkinnedMesh& mesh, std::span<const SkinMatrix> palette,
                  std::span<vec3> positions, std::span<vec3> normals) {
    if (method == SkinningMethod::dualQuaternion) {
        skinVerticesDual(mesh, palette, positions, normals);
    } else {
        skinVertices(mesh, palette, positions, normals);
    }
}

}  // namespace lutka::animation
