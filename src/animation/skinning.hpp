#pragma once

#include <span>
#include <vector>

#include "animation/character.hpp"
#include "core/instruction_set.hpp"

namespace lutka::animation {

/// A 3 × 4 matrix by rows, as a shader reads it from three RGBA32F texels: p ↦ (dot(row0, (p, 1)), …).
struct SkinMatrix {
    vec4 rows[3] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
};

/// The palette: modelFromJoint · bindModelFromJoint⁻¹ for every joint. All spans hold jointCount() elements.
/// For many instances PoseBatch is several times faster.
void skinMatrices(std::span<const RigidTransform> bindModelFromJoint, std::span<const RigidTransform> modelFromJoint,
                  std::span<SkinMatrix> palette);

/// Linear blend skinning on the CPU, the reference of the GPU's: `positions`, `normals` and `tangents` hold as many
/// elements as the mesh has vertices; the last two may be empty to skip them. Normals and tangents come out with unit
/// length (the same matrix turns them: palettes are rigid), a tangent's w as it was. Allocates nothing.
///
/// Eight vertices at a time where the processor has AVX2, else four; every
/// set gives the bits of skinVerticesByScalars(). The outputs share no memory with the mesh.
void skinVertices(const SkinnedMesh& mesh, std::span<const SkinMatrix> palette, std::span<vec3> positions,
                  std::span<vec3> normals, std::span<vec4> tangents = {});
/// The same for an instruction set that the processor has.
void skinVertices(InstructionSet set, const SkinnedMesh& mesh, std::span<const SkinMatrix> palette,
                  std::span<vec3> positions, std::span<vec3> normals, std::span<vec4> tangents = {});

/// The plain loop, one vertex after the other, compiled with the set's flags: what the wide code is measured with.
void skinVerticesByScalars(InstructionSet set, const SkinnedMesh& mesh, std::span<const SkinMatrix> palette,
                           std::span<vec3> positions, std::span<vec3> normals, std::span<vec4> tangents = {});

}  // namespace lutka::animation
