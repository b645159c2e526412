#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "core/result.hpp"

namespace lutka {

/// An ordinary file that is open for reading: of what may be large, the start can be judged before memory is taken.
class InputFile {
  public:
    /// Fails with ErrorCode::input when it is missing, no ordinary file (a folder, a pipe, a device) or unreadable.
    [[nodiscard]] static Result<InputFile> open(const std::filesystem::path& file);

    InputFile(InputFile&& other) noexcept;
    InputFile& operator=(InputFile&&) = delete;
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;
    ~InputFile();

    /// Bytes it had when it was opened.
    [[nodiscard]] std::size_t size() const { return size_; }
    /// Fills `out` with the bytes from `offset` on. Fails with ErrorCode::input when there are fewer, or the disk does.
    [[nodiscard]] Result<void> read(std::size_t offset, std::span<unsigned char> out) const;

  private:
    InputFile(std::filesystem::path file, int handle, std::size_t size);

    std::filesystem::path file_;
    int handle_ = -1;
    std::size_t size_ = 0;
};

}  // namespace lutka
