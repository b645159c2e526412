#pragma once

#include <filesystem>

namespace lutka::animation {

/// Whether the file's name ends, in letters of any case, like a format that can hold a skeleton: what a folder is
/// looked through for. importCharacter() reads others, too, when they are named.
[[nodiscard]] bool hasModelEnding(const std::filesystem::path& file);

}  // namespace lutka::animation
