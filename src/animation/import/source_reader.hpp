#pragma once

#include <filesystem>

#include "animation/import/source_scene.hpp"
#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// Reads a file by the reader that its content asks for, whatever its name ends in: our own for glTF, FBX, BVH and
/// IQM, Assimp for the rest. This is the half of an import that touches untrusted bytes: files are opened and pictures
/// decoded here, and nowhere after. Fails with ErrorCode::input (file, reason, mend).
[[nodiscard]] Result<SourceScene> readSource(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace lutka::animation::rig_import
