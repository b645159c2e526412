#pragma once

#include <filesystem>
#include <optional>

#include "animation/import/source_scene.hpp"
#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// What is wrong with a scene's indices, sizes and numbers; nothing when the rest of import can trust it. `location` is
/// the file it came from.
[[nodiscard]] std::optional<Error> validate(const SourceScene& scene, const std::string& location);

/// Settles a scene as a Character: bind pose, units and axes, rigid joints, clean meshes, clips. Opens no file; `file`
/// is where the scene came from. The scene may be anybody's: validate() is called first.
[[nodiscard]] Result<Character> buildCharacter(SourceScene scene, const std::filesystem::path& file,
                                               const ImportOptions& options);

}  // namespace lutka::animation::rig_import
