#pragma once

#include <filesystem>
#include <functional>

#include "animation/import/source_scene.hpp"
#include "core/confined_process.hpp"
#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// How a file is read by another process.
struct Isolation {
    std::filesystem::path program;  ///< Calls serveReading() when its first argument is kReadingCommand.
    ProcessLimits limits;
    std::function<bool()> stop;  ///< Asked ten times a second; true gives the reading up.
    /// Told each line that readers print; unset: to standard error.
    std::function<void(const std::string& line)> printed;
};

/// What reads a file in the end, in the process that serves.
using Reader = std::function<Result<SourceScene>(const std::filesystem::path& file, const ImportOptions& options)>;

inline constexpr const char* kReadingCommand = "import-worker";

/// Reads the file in a process of its own, which can crash, hang or run out of memory without harm: each is an error
/// like any other (ErrorCode::input, what happened, the limit, the mend). Only ordinary files are read. Of the options
/// those of reading count (pictures, files outside).
[[nodiscard]] Result<SourceScene> readIsolated(const std::filesystem::path& file, const ImportOptions& options,
                                               const Isolation& isolation);

/// The other side, for main(): takes away from this process all but reading, reads as `arguments` ask, and hands the
/// scene or the error back. `arguments` begins with kReadingCommand. Returns the process's exit code.
[[nodiscard]] int serveReading(const std::vector<std::string>& arguments, const Reader& reader);

}  // namespace lutka::animation::rig_import
