#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "animation/character.hpp"
#include "animation/export/reduce_keys.hpp"
#include "core/result.hpp"

namespace lutka::animation {

/// Writes the character (skeleton, meshes with skin, materials, textures) with `clips` as animations to a binary
/// glTF 2.0 file. The nodes stand in the bind pose, wrapped in a root node that carries `worldFromModel`. Written whole
/// or not at all; ErrorCode::output on failure. With a tolerance, keys that it makes needless are left out.
[[nodiscard]] Result<void> writeGlb(const std::filesystem::path& file, const Character& character,
                                    std::span<const Clip> clips, const RigidTransform& worldFromModel = {},
                                    const std::optional<KeyTolerance>& tolerance = {});

/// The same as bytes. Node 0 is the root node, node 1 + j is joint j of the skeleton. Fails as writeGlb() does; `name`
/// stands for the file in messages.
[[nodiscard]] Result<std::string> glbBytes(const std::filesystem::path& name, const Character& character,
                                           std::span<const Clip> clips, const RigidTransform& worldFromModel = {},
                                           const std::optional<KeyTolerance>& tolerance = {});

/// A figure of a crowd, with its part in the animation.
struct GlbFigure {
    const Character* character = nullptr;  ///< Not null; figures that share one share its meshes and materials.
    const Clip* clip = nullptr;            ///< Not null.
    RigidTransform worldFromModel;
};

/// Writes figures that move together, in one animation, to one file: a skinned node each, over shared meshes. Fails as
/// writeGlb() does.
[[nodiscard]] Result<void> writeGlbCrowd(const std::filesystem::path& file, const std::string& clipName,
                                         std::span<const GlbFigure> figures,
                                         const std::optional<KeyTolerance>& tolerance = {});

}  // namespace lutka::animation
