#include "core/input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

namespace lutka {
namespace {

Error inputError(const std::filesystem::path& file, std::string message) {
    return {ErrorCode::input, std::move(message), file.string(), ""};
}

Error unreadable(const std::filesystem::path& file, int why) {
    const char* const mend = why == EACCES || why == EPERM ? "check the permissions of the file and its folders" : "";
    return {ErrorCode::input, fmt::format("can't be read: {}", std::strerror(why)), file.string(), mend};
}

}  // namespace

InputFile::InputFile(std::filesystem::path file, int handle, std::size_t size)
    : file_(std::move(file)), handle_(handle), size_(size) {}

InputFile::InputFile(InputFile&& other) noexcept
    : file_(std::move(other.file_)), handle_(std::exchange(other.handle_, -1)), size_(other.size_) {}

InputFile::~InputFile() {
    if (handle_ >= 0) ::close(handle_);
}

Result<InputFile> InputFile::open(const std::filesystem::path& file) {
    // Without O_NONBLOCK a FIFO that nobody writes to would hold us for ever before we could see what it is.
    const int handle = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (handle < 0) return unreadable(file, errno);
    InputFile in(file, handle, 0);
    struct stat status {};
    if (::fstat(handle, &status) != 0) return unreadable(file, errno);
    if (S_ISDIR(status.st_mode)) return inputError(file, "is a folder, not a file");
    if (!S_ISREG(status.st_mode)) return inputError(file, "is no ordinary file but a pipe or a device");
    in.size_ = static_cast<std::size_t>(status.st_size);
    return in;
}

Result<void> InputFile::read(std::size_t offset, std::span<unsigned char> out) const {
    while (!out.empty()) {
        const ssize_t got = ::pread(handle_, out.data(), out.size(), static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return unreadable(file_, errno);
        if (got == 0) return inputError(file_, "can't be read to its end");
        out = out.subspan(static_cast<std::size_t>(got));
        offset += static_cast<std::size_t>(got);
    }
    return {};
}

}  // namespace lutka
