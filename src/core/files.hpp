#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace lutka {

/// The whole file as bytes. Fails with ErrorCode::input when it is missing, no ordinary file (a folder, a pipe, a
/// device), unreadable or above `maxBytes`.
[[nodiscard]] Result<std::vector<unsigned char>> readFile(const std::filesystem::path& file,
                                                          std::size_t maxBytes = std::size_t{4} << 30U);

/// Whether an output of that name is the process's standard output: `-`, /dev/stdout and its other names.
[[nodiscard]] bool isStandardOutput(const std::filesystem::path& file);

/// The file that an output of that name is written to: a link's target, which may not be there yet, not the link. Fails
/// with ErrorCode::output where links lead in a circle.
[[nodiscard]] Result<std::filesystem::path> outputTarget(const std::filesystem::path& file);

/// Writes the file whole or not at all: `bytes` go to a temporary file in the same folder, which is flushed and renamed
/// over `file`; on failure (ErrorCode::output) the temporary file is removed and an old `file` is left as it was.
/// Missing parent folders are made. Links are followed (outputTarget()); a device, a pipe and the standard output are
/// written straight.
[[nodiscard]] Result<void> writeFileAtomically(const std::filesystem::path& file, std::string_view bytes);

/// The same for a writer that needs a path (an encoder, a third-party library): `write` gets a temporary path beside
/// `file` with the same extension, and the result is renamed when it succeeds. Devices and pipes are refused.
[[nodiscard]] Result<void> writeFileAtomically(const std::filesystem::path& file,
                                               const std::function<Result<void>(const std::filesystem::path&)>& write);

/// Where the assets of an installed or built program lie: $LUTKA_ASSETS, else `assets` beside the executable or in one
/// of its parents, else ../share/lutka/assets. Fails with ErrorCode::input, naming the places looked at.
[[nodiscard]] Result<std::filesystem::path> findAsset(std::string_view relativePath);

}  // namespace lutka
