#pragma once

#include <filesystem>

#include "animation/import/import_character.hpp"
#include "animation/import/source_scene.hpp"
#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// Reads an FBX file (binary or ASCII, versions 6.1 to 7.7) in its own unit, up axis as stated; a left-handed file is
/// mirrored at its root. Models become nodes below one named "RootNode". Skins hold the bind pose that the clusters
/// state, nodes the pose that the file was saved in. Clips are sampled: see sampleMotions(). docs/import.md tells what
/// is read and what is not.
///
/// Fails with ErrorCode::input (file, reason, mend) when the file is damaged or its counts are absurd.
[[nodiscard]] Result<SourceScene> readFbx(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace lutka::animation::rig_import
