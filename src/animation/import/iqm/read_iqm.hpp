#pragma once

#include <filesystem>

#include "animation/import/source_scene.hpp"
#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// Reads an Inter-Quake Model: its joints and a node a mesh as nodes, the skin that all meshes share, a clip an
/// animation. The format states neither unit nor up axis; Z is given as up, as nearly all
/// files have it. Assimp 5.2.5 reads its meshes alone.
[[nodiscard]] Result<SourceScene> readIqm(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace lutka::animation::rig_import
