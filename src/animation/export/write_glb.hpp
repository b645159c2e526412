#pragma once

#include <filesystem>
#include <span>

#include "animation/character.hpp"
#include "core/result.hpp"

namespace lutka::animation {

/// Writes the character (skeleton, meshes with skin, materials, textures) with `clips` as animations to a binary
/// glTF 2.0 file. The nodes stand in the bind pose, wrapped in a root node that carries `worldFromModel`. Written whole
/// or not at all; ErrorCode::output on failure.
[[nodiscard]] Result<void> writeGlb(const std::filesystem::path& file, const Character& character,
                                    std::span<const Clip> clips, const RigidTransform& worldFromModel = {});

}  // namespace lutka::animation
