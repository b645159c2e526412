#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "scene/description/entity_scene.hpp"

namespace lutka::scene {

/// Whether a name on the command line or a dropped file means a scene file: it ends in ".scene.json".
[[nodiscard]] bool isSceneFile(const std::filesystem::path& file);

/// The scene as a document (docs/scene.md): the same scene gives the same bytes, and reading them gives the same scene.
/// `folder` is where the file will lie: paths of models and profiles are told from there.
[[nodiscard]] std::string sceneToJson(const EntityScene& scene, const std::filesystem::path& folder = {});

/// Reads what sceneToJson() writes. Fails with ErrorCode::input and all problems at once, each with the JSON pointer of
/// its place and what is expected there. `source` names the document in the error; paths in it start at `folder`.
[[nodiscard]] Result<EntityScene> sceneFromJson(std::string_view text, std::string_view source,
                                                const std::filesystem::path& folder = {});

/// Written whole or not at all. Fails with ErrorCode::output.
[[nodiscard]] Result<void> saveScene(const std::filesystem::path& file, const EntityScene& scene);
[[nodiscard]] Result<EntityScene> loadScene(const std::filesystem::path& file);

}  // namespace lutka::scene
