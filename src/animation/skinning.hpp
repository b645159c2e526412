#pragma once

#include <span>
#include <vector>

#include "animation/character.hpp"

namespace lutka::animation {

/// A 3 × 4 matrix by rows, as a shader reads it from three RGBA32F texels: p ↦ (dot(row0, (p, 1)), …).
struct SkinMatrix {
    vec4 rows[3] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
};

/// The palette: modelFromJoint · bindModelFromJoint⁻¹ for every joint. All spans hold jointCount() elements.
void skinMatrices(std::span<const RigidTransform> bindModelFromJoint, std::span<const RigidTransform> modelFromJoint,
                  std::span<SkinMatrix> palette);

/// Linear blend skinning on the CPU, the reference of the GPU's: `positions` and `normals` hold as many elements as the
/// mesh has vertices; `normals` may be empty to skip them (they come out with unit length).
void skinVertices(const SkinnedMesh& mesh, std::span<const SkinMatrix> palette, std::span<vec3> positions,
                  std::span<vec3> normals);

}  // namespace lutka::animation
