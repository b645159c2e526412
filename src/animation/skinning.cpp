#include "animation/skinning.hpp"

#include <glm/geometric.hpp>

#include "core/assert.hpp"

namespace lutka::animation {
namespace {

SkinMatrix blend(const SkinnedMesh& mesh, std::size_t vertex, std::span<const SkinMatrix> palette) {
    SkinMatrix sum{{vec4(0), vec4(0), vec4(0)}};
    for (int slot = 0; slot < kMaxInfluences; ++slot) {
        const float weight = mesh.weights[vertex][slot];
        if (weight == 0.0F) break;  // strongest first: the rest is zero too
        const SkinMatrix& matrix = palette[mesh.joints[vertex][slot]];
        for (int row = 0; row < 3; ++row)
            sum.rows[row] += weight * matrix.rows[row];
    }
    return sum;
}

vec3 apply(const SkinMatrix& matrix, const vec4& v) {
    return {glm::dot(matrix.rows[0], v), glm::dot(matrix.rows[1], v), glm::dot(matrix.rows[2], v)};
}

}  // namespace

void skinMatrices(std::span<const RigidTransform> bindModelFromJoint, std::span<const RigidTransform> modelFromJoint,
                  std::span<SkinMatrix> palette) {
    LUTKA_ASSERT(bindModelFromJoint.size() == palette.size() && modelFromJoint.size() == palette.size());
    for (std::size_t joint = 0; joint < palette.size(); ++joint) {
        const RigidTransform skin = modelFromJoint[joint] * inverse(bindModelFromJoint[joint]);
        const mat3 r = glm::mat3_cast(skin.rotation);
        for (int row = 0; row < 3; ++row) {
            palette[joint].rows[row] = {r[0][row], r[1][row], r[2][row], skin.translation[row]};
        }
    }
}

void skinVertices(const SkinnedMesh& mesh, std::span<const SkinMatrix> palette, std::span<vec3> positions,
                  std::span<vec3> normals) {
    LUTKA_ASSERT(positions.size() == mesh.positions.size());
    LUTKA_ASSERT(normals.empty() || normals.size() == mesh.normals.size());
    for (std::size_t vertex = 0; vertex < positions.size(); ++vertex) {
        const SkinMatrix matrix = blend(mesh, vertex, palette);
        positions[vertex] = apply(matrix, vec4(mesh.positions[vertex], 1.0F));
        if (!normals.empty()) normals[vertex] = glm::normalize(apply(matrix, vec4(mesh.normals[vertex], 0.0F)));
    }
}

}  // namespace lutka::animation
