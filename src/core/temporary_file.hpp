#pragma once

#include <filesystem>
#include <string_view>

#include "core/result.hpp"

namespace lutka {

/// A file that is being written beside the one it will replace. Nobody else's: it is created exclusively and locked for
/// as long as this object lives, so that what a killed process left behind is known by its lock being free. Removed
/// when it is dropped before replace().
class TemporaryFile {
  public:
    /// An empty file in the target's folder, named `.lutka-….EXTENSION` whatever the length of the target's own name
    /// (`extension` with its dot, as encoders choose their format by it; one of more than 16 bytes is left out).
    /// Removes the leftovers of dead processes in that folder first. Fails with ErrorCode::output.
    [[nodiscard]] static Result<TemporaryFile> beside(const std::filesystem::path& target, std::string_view extension);

    TemporaryFile(TemporaryFile&& other) noexcept;
    TemporaryFile& operator=(TemporaryFile&&) = delete;
    ~TemporaryFile();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// Flushes the data to the disk, then gives the file the target's name, in one step: a crash at any time leaves the
    /// old file or the new one. The permissions of an old file stay. Fails with ErrorCode::output, the target being as
    /// it was.
    [[nodiscard]] Result<void> replace(const std::filesystem::path& target);

  private:
    TemporaryFile(std::filesystem::path path, int lock, int note) : path_(std::move(path)), lock_(lock), note_(note) {}

    std::filesystem::path path_;
    int lock_ = -1;  ///< Open for as long as the file is ours.
    int note_ = -1;  ///< Where removeTemporaryFiles() finds its name; -1: nowhere.
};

/// Removes the names of all temporary files that this process has, for one that is about to end by a signal: safe in a
/// signal handler, also while another thread makes, drops or replaces one. Nothing may be written after it.
void removeTemporaryFiles() noexcept;

}  // namespace lutka
