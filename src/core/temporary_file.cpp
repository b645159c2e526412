#include "core/temporary_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

namespace lutka {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = ".lutka-";
constexpr int kMostTries = 1000;
constexpr std::size_t kLongestExtension = 16;

Error unwritable(const fs::path& file, const std::string& what, int errorNumber) {
    return {ErrorCode::output, fmt::format("{}: {}", what, std::strerror(errorNumber)), file.string(),
            "check that the folder is writable and that the disk has room"};
}

fs::path folderOf(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

bool isOurs(const struct stat& status) {
    return S_ISREG(status.st_mode) && status.st_uid == ::geteuid();
}

// Removes the file when the process that wrote it is gone: the kernel has freed its lock then.
void removeIfAbandoned(const fs::path& file) {
    const int handle = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (handle < 0) return;
    struct stat status {};
    if (::fstat(handle, &status) == 0 && isOurs(status) && ::flock(handle, LOCK_EX | LOCK_NB) == 0)
        ::unlink(file.c_str());
    ::close(handle);
}

void removeLeftovers(const fs::path& folder) {
    std::error_code failed;
    for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
        const std::string name = entry->path().filename().string();
        if (name.compare(0, kPrefix.size(), kPrefix) == 0) removeIfAbandoned(entry->path());
    }
}

// Whether the file is locked by us and still there: another process may have taken it for a leftover in between.
bool lockOwn(int handle) {
    struct stat status {};
    return ::flock(handle, LOCK_EX | LOCK_NB) == 0 && ::fstat(handle, &status) == 0 && status.st_nlink > 0;
}

}  // namespace

Result<TemporaryFile> TemporaryFile::beside(const fs::path& target, std::string_view extension) {
    const fs::path folder = folderOf(target);
    removeLeftovers(folder);
    if (extension.size() > kLongestExtension) extension = {};
    for (int number = 0; number < kMostTries; ++number) {
        fs::path path = target;
        path.replace_filename(fmt::format("{}{}-{}{}", kPrefix, ::getpid(), number, extension));
        const int handle = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (handle < 0 && errno == EEXIST) continue;
        if (handle < 0) return unwritable(target, "can't be written", errno);
        if (lockOwn(handle)) return TemporaryFile(std::move(path), handle);
        ::close(handle);
    }
    return Error{ErrorCode::output, "can't be written: the folder is full of temporary files", target.string(),
                 fmt::format("remove the files {}* from it", kPrefix)};
}

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept
    : path_(std::exchange(other.path_, {})), lock_(std::exchange(other.lock_, -1)) {}

TemporaryFile::~TemporaryFile() {
    if (lock_ < 0) return;
    ::unlink(path_.c_str());
    ::close(lock_);
}

Result<void> TemporaryFile::replace(const fs::path& target) {
    // What was kept from others stays so.
    struct stat old {};
    if (::lstat(target.c_str(), &old) == 0 && S_ISREG(old.st_mode) && ::fchmod(lock_, old.st_mode & 07777U) != 0)
        return unwritable(target, "can't be written", errno);
    // Data first, name second: without this a crash after the rename can leave an empty file under the final name.
    if (::fsync(lock_) != 0 && errno != EINVAL) return unwritable(target, "can't be written", errno);
    if (std::rename(path_.c_str(), target.c_str()) != 0) return unwritable(target, "can't be written", errno);
    ::close(std::exchange(lock_, -1));
    return {};
}

}  // namespace lutka
