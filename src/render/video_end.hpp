#pragma once

#include <filesystem>

namespace lutka::render {

/// Whether the file, an MP4 or a GIF by its content, was written to its end: an MP4's boxes fill the file exactly and
/// an index (`moov`) is among them; a GIF ends with its trailer. A disk that fills up cuts either off.
[[nodiscard]] bool isWholeVideo(const std::filesystem::path& file);

}  // namespace lutka::render
