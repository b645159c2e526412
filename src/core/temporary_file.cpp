#include "core/temporary_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <system_error>
#include <utility>

namespace lutka {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = ".lutka-";
constexpr int kMostTries = 100;
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

/// Names of the files that the process has, where a signal handler finds them: it can take no lock and reach nothing
/// but globals. Whoever has a note in another state than `free` has it alone.
struct Note {
    enum State : int { free, ours, removed };
    std::atomic<int> state{free};
    std::array<char, PATH_MAX> path{};
};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler must not wait for a lock");
// As many as are written at a time, and more; a file beyond them is found by the next run alone.
std::array<Note, 24> notes;

// A name that nobody else has. The process's number would not do: two containers that share a folder may have the same,
// and a handler would remove the other's file by the name that is noted here.
std::string ownName(std::string_view extension) {
    std::array<std::uint64_t, 2> random{};
    if (::getrandom(random.data(), sizeof random, 0) != static_cast<ssize_t>(sizeof random)) {
        // Without the kernel's randomness: no two processes of a machine are alike in all of these.
        static std::atomic<std::uint64_t> count = 0;
        timespec now{};
        ::clock_gettime(CLOCK_REALTIME, &now);
        random = {static_cast<std::uint64_t>(::getpid()) << 32U | ++count,
                  static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000U + static_cast<std::uint64_t>(now.tv_nsec)};
    }
    return fmt::format("{}{:016x}{:016x}{}", kPrefix, random[0], random[1], extension);
}

// The name is noted before there is a file of it: nobody else can have one.
int noteDown(const fs::path& path) {
    if (path.native().size() >= PATH_MAX) return -1;
    for (std::size_t i = 0; i < notes.size(); ++i) {
        int state = Note::free;
        // Filled as `removed`: a handler that comes meanwhile leaves it alone.
        if (!notes[i].state.compare_exchange_strong(state, Note::removed)) continue;
        std::memcpy(notes[i].path.data(), path.c_str(), path.native().size() + 1);
        notes[i].state = Note::ours;
        return static_cast<int>(i);
    }
    return -1;
}

void strikeOut(int note) {
    if (note < 0) return;
    int state = Note::ours;
    notes[static_cast<std::size_t>(note)].state.compare_exchange_strong(state, Note::free);
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
        path.replace_filename(ownName(extension));
        const int note = noteDown(path);
        const int handle = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
        const int failed = errno;
        if (handle >= 0 && lockOwn(handle)) return TemporaryFile(std::move(path), handle, note);
        strikeOut(note);
        if (handle >= 0)
            ::close(handle);
        else if (failed != EEXIST)
            return unwritable(target, "can't be written", failed);
    }
    return Error{ErrorCode::output, "can't be written: the folder is full of temporary files", target.string(),
                 fmt::format("remove the files {}* from it", kPrefix)};
}

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept
    : path_(std::exchange(other.path_, {})),
      lock_(std::exchange(other.lock_, -1)),
      note_(std::exchange(other.note_, -1)) {}

TemporaryFile::~TemporaryFile() {
    if (lock_ < 0) return;
    ::unlink(path_.c_str());
    strikeOut(note_);
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
    strikeOut(std::exchange(note_, -1));
    ::close(std::exchange(lock_, -1));
    return {};
}

void removeTemporaryFiles() noexcept {
    for (Note& note : notes) {
        int state = Note::ours;
        if (note.state.compare_exchange_strong(state, Note::removed)) ::unlink(note.path.data());
    }
}

}  // namespace lutka
