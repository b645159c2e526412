#pragma once

#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <filesystem>
#include <memory>
#include <optional>

#include "animation/import/gltf_document.hpp"
#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// A file as Assimp read it: triangles only, normals made where there were none, FBX pivots kept as helper nodes.
struct SceneFile {
    std::unique_ptr<Assimp::Importer> importer;  ///< Owns `scene`.
    const aiScene* scene = nullptr;
    std::optional<GltfDocument> gltf;  ///< For glTF, by content (`.gltf`, `.glb`, `.vrm` …).
};

/// Fails with the importer's own message; also when a glTF requires an extension that Assimp ignores, and when the
/// counts in the file are absurd.
[[nodiscard]] Result<SceneFile> readScene(const std::filesystem::path& file);

}  // namespace lutka::animation::rig_import
