#pragma once

#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <filesystem>
#include <memory>
#include <string>

#include "animation/import/assimp/confined_files.hpp"
#include "animation/import/model_folder.hpp"
#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// A file as Assimp read it: triangles only, normals made where there were none, FBX pivots kept as helper nodes.
struct SceneFile {
    std::unique_ptr<Assimp::Importer> importer;  ///< Owns `scene`.
    const aiScene* scene = nullptr;
    std::shared_ptr<LeftOut> leftOut;  ///< What it names and Assimp did not get.
};

/// Fails with the importer's own message, and when the counts in the file are absurd.
[[nodiscard]] Result<SceneFile> readScene(const std::filesystem::path& file, const ModelFolder& folder);

}  // namespace lutka::animation::rig_import
