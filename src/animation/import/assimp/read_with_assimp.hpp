#pragma once

#include <filesystem>

#include "animation/import/source_scene.hpp"
#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// Reads any format that Assimp 5.2.5 knows. Bones and channels, which Assimp names, are bound to nodes here; an FBX
/// node with pivots becomes a chain of helpers that ends in the node. Fails with ErrorCode::input and the importer's
/// own message, and when there are more nodes, or nodes nested deeper, than a character can have.
[[nodiscard]] Result<SourceScene> readWithAssimp(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace lutka::animation::rig_import
