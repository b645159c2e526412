#pragma once

#include <span>

#include "animation/skinning.hpp"

namespace lutka::animation {

/// How the joints' motions are blended into a vertex's.
enum class SkinningMethod {
    linear,         ///< Matrices are averaged: fast, the engines' default; a twisted forearm gets thin.
    dualQuaternion  ///< Rigid motions are averaged: volume is kept under twist; bends bulge a little outwards.
};

/// A rigid motion as a unit dual quaternion real + ε dual, components x, y, z, w: `real` is the rotation q, `dual` is
/// ½ t q for the translation t as a pure quaternion. In a shader: two RGBA32F texels.
struct DualQuaternion {
    vec4 real{0, 0, 0, 1};
    vec4 dual{0, 0, 0, 0};
};

/// The same motion; `matrix` must be rigid, as skinMatrices() makes them. One of the two signs, always the same for
/// the same matrix.
[[nodiscard]] DualQuaternion dualQuaternion(const SkinMatrix& matrix);

/// Dual quaternion skinning on the CPU, the reference of the GPU's, with the sizes of skinVertices(): the joints' dual
/// quaternions are weighted, summed and normalised (dual quaternion linear blending: Kavan, Collins, Žára, O'Sullivan
/// 2007). q and -q are the same rotation: each is taken in the half space of the strongest joint's.
void skinVerticesDual(const SkinnedMesh& mesh, std::span<const SkinMatrix> palette, std::span<vec3> positions,
                      std::span<vec3> normals);

/// The one of both that `method` names.
void skinVertices(SkinningMethod method, const SkinnedMesh& mesh, std::span<const SkinMatrix> palette,
                  std::span<vec3> positions, std::span<vec3> normals);

}  // namespace lutka::animation
