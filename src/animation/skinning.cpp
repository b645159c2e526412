#include "animation/skinning.hpp"

#include "animation/wide/kernels.hpp"
#include "core/assert.hpp"

namespace lutka::animation {
namespace {

// The kernels read arrays of these as floats.
static_assert(sizeof(vec3) == 3 * sizeof(float) && sizeof(vec4) == 4 * sizeof(float));
static_assert(sizeof(SkinMatrix) == wide::kMatrixFloats * sizeof(float));
static_assert(kMaxInfluences == 4);

wide::SkinJob jobOf(const SkinnedMesh& mesh, std::span<const SkinMatrix> palette, std::span<vec3> positions,
                    std::span<vec3> normals, std::span<vec4> tangents) {
    LUTKA_ASSERT(positions.size() == mesh.positions.size());
    LUTKA_ASSERT(normals.empty() || normals.size() == mesh.normals.size());
    LUTKA_ASSERT(tangents.empty() || tangents.size() == mesh.tangents.size());
    wide::SkinJob job{};
    if (positions.empty()) return job;
    job.positions = &mesh.positions[0].x;
    job.joints = mesh.joints[0].data();
    job.weights = mesh.weights[0].data();
    job.palette = &palette[0].rows[0].x;
    job.jointCount = static_cast<long>(palette.size());
    job.outPositions = &positions[0].x;
    if (!normals.empty()) {
        job.normals = &mesh.normals[0].x;
        job.outNormals = &normals[0].x;
    }
    if (!tangents.empty()) {
        job.tangents = &mesh.tangents[0].x;
        job.outTangents = &tangents[0].x;
    }
    job.vertexCount = static_cast<long>(positions.size());
    return job;
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
                  std::span<vec3> normals, std::span<vec4> tangents) {
    skinVertices(bestInstructionSet(), mesh, palette, positions, normals, tangents);
}

void skinVertices(InstructionSet set, const SkinnedMesh& mesh, std::span<const SkinMatrix> palette,
                  std::span<vec3> positions, std::span<vec3> normals, std::span<vec4> tangents) {
    wide::kernelsOf(set).skin(jobOf(mesh, palette, positions, normals, tangents));
}

void skinVerticesByScalars(InstructionSet set, const SkinnedMesh& mesh, std::span<const SkinMatrix> palette,
                           std::span<vec3> positions, std::span<vec3> normals, std::span<vec4> tangents) {
    wide::kernelsOf(set).skinByScalars(jobOf(mesh, palette, positions, normals, tangents));
}

}  // namespace lutka::animation
