#pragma once

#include <filesystem>

namespace lutka::editor {

/// The model that comes `step` after `file` in its folder, by name; the first follows the last. Empty when there is no
/// other.
[[nodiscard]] std::filesystem::path fileBeside(const std::filesystem::path& file, int step);

}  // namespace lutka::editor
