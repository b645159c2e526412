#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "animation/character.hpp"
#include "core/result.hpp"

namespace lutka::animation {

/// Writes the character (skeleton, meshes with skin, materials, textures) with `clips` as animations to a binary
/// glTF 2.0 file. The nodes stand in the bind pose, wrapped in a root node that carries `worldFromModel`. Written whole
/// or not at all; ErrorCode::output on failure.
[[nodiscard]] Result<void> writeGlb(const std::filesystem::path& file, const Character& character,
                                    std::span<const Clip> clips, const RigidTransform& worldFromModel = {});

/// The same as bytes. Node 0 is the root node, node 1 + j is joint j of the skeleton. Fails as writeGlb() does; `name`
/// stands for the file in messages.
[[nodiscard]] Result<std::string> glbBytes(const std::filesystem::path& name, const Character& character,
                                           std::span<const Clip> clips, const RigidTransform& worldFromModel = {});

}  // namespace lutka::animation
