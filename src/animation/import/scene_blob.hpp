#pragma once

#include <string>
#include <string_view>

#include "animation/import/source_scene.hpp"
#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// What the importing process hands back, the scene or the error, as bytes for a pipe: versioned, for the same machine
/// and build only.
[[nodiscard]] std::string packScene(const Result<SourceScene>& scene);

/// The way back. The bytes are not trusted, as the process that wrote them had read a hostile file: every count, index,
/// size and number is checked. Gives what was packed, or ErrorCode::input with `file` as the place when the bytes are
/// not what packScene() gives.
[[nodiscard]] Result<SourceScene> unpackScene(std::string_view bytes, std::string_view file);

/// The first thing that is wrong with a scene: an index that points nowhere, arrays of unlike sizes, times that go
/// back, sizes of pictures. Empty when it is sound.
[[nodiscard]] std::string problemOf(const SourceScene& scene);

}  // namespace lutka::animation::rig_import
