#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lutka::editor {

/// The model that comes `step` after `file` in its folder, by name; the first follows the last. Empty when there is no
/// other.
[[nodiscard]] std::filesystem::path fileBeside(const std::filesystem::path& file, int step);

/// Which of the files and folders that were dropped together is opened: the first scene, else the first model, in a
/// folder too (pictures and buffers come along with theirs), else the first of them. `dropped` holds one at least.
[[nodiscard]] std::filesystem::path fileToOpen(const std::vector<std::string>& dropped);

}  // namespace lutka::editor
