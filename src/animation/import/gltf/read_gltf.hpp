#pragma once

#include <filesystem>

#include "animation/import/source_scene.hpp"
#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// Reads glTF 2.0 (.gltf, .glb, .vrm) by its own specification: docs/import.md tells what is read and what is not.
/// Joints and channels are bound by node index, never by name. Fails with ErrorCode::input (file, reason, mend) when
/// the file is damaged, when its counts are absurd, and when it requires an extension that changes its shape and can't
/// be read.
[[nodiscard]] Result<SourceScene> readGltf(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace lutka::animation::rig_import
