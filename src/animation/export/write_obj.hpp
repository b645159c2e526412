#pragma once

#include <filesystem>
#include <span>

#include "animation/character.hpp"
#include "animation/skinning.hpp"
#include "core/result.hpp"

namespace lutka::animation {

/// Writes the meshes skinned by `palette` (CPU reference) and moved by `worldFromModel` to a Wavefront OBJ file:
/// positions, normals, UVs, one `o` a mesh, vertices in the character's order. Written whole or not at all.
[[nodiscard]] Result<void> writeObj(const std::filesystem::path& file, const Character& character,
                                    std::span<const SkinMatrix> palette, const RigidTransform& worldFromModel = {});

}  // namespace lutka::animation
