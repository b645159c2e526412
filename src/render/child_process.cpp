#include "render/child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <utility>

#include "core/spawn_arguments.hpp"

namespace lutka::render {
namespace {

// The last of what the program said, on one line.
std::string tailOf(int file) {
    constexpr off_t kMost = 600;
    const off_t size = ::lseek(file, 0, SEEK_END);
    const off_t from = std::max<off_t>(0, size - kMost);
    std::string text(static_cast<std::size_t>(std::max<off_t>(0, size - from)), '\0');
    const ssize_t got = ::pread(file, text.data(), text.size(), from);
    text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r'))
        text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

// A file in memory: no folder that has to be writable, and no pipe that could fill and block the program.
int openErrorFile() {
    return ::memfd_create("lutka-errors", MFD_CLOEXEC);
}

// Where a signal handler finds the programs that run; 0: none. More at a time are not started.
std::array<std::atomic<pid_t>, 16> running;
static_assert(std::atomic<pid_t>::is_always_lock_free, "a signal handler must not wait for a lock");

// Puts `to` in the place of `from`, wherever that stands.
void exchangeRunning(pid_t from, pid_t to) {
    for (std::atomic<pid_t>& one : running) {
        pid_t expected = from;
        if (one.compare_exchange_strong(expected, to)) return;
    }
}

int spawn(const std::vector<std::string>& arguments, int input, int errors, pid_t& pid) {
    const std::vector<char*> argv = spawnArguments(arguments);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
    const int failed = ::posix_spawnp(&pid, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    return failed;
}

}  // namespace

Result<ChildProcess> ChildProcess::start(const std::vector<std::string>& arguments) {
    const auto fail = [&](int why) {
        return Error{ErrorCode::output, "the program can't be started: " + std::string(std::strerror(why)),
                     arguments[0], "check that it is installed and on the PATH"};
    };
    // A socket instead of a pipe: send() can then be told not to raise SIGPIPE when the program has died.
    int ends[2] = {-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return fail(errno);
    const int errors = openErrorFile();
    pid_t pid = -1;
    const int failed = errors < 0 ? errno : spawn(arguments, ends[1], errors, pid);
    ::close(ends[1]);
    if (failed != 0) {
        ::close(ends[0]);
        if (errors >= 0) ::close(errors);
        return fail(failed);
    }
    exchangeRunning(0, pid);
    return ChildProcess(pid, ends[0], errors);
}

bool ChildProcess::isOnPath(const std::string& program) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        if (::access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
    }
    return false;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      input_(std::exchange(other.input_, -1)),
      errors_(std::exchange(other.errors_, -1)) {}

ChildProcess::~ChildProcess() {
    if (pid_ < 0) return;
    ::kill(pid_, SIGKILL);
    static_cast<void>(finish());
}

bool ChildProcess::write(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(sent));
    }
    return true;
}

void ChildProcess::killAll() noexcept {
    for (std::atomic<pid_t>& one : running) {
        const pid_t pid = one.exchange(0);
        if (pid <= 0) continue;
        ::kill(pid, SIGKILL);
        while (::waitpid(pid, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
}

ChildProcess::Ended ChildProcess::finish() {
    Ended ended;
    if (input_ >= 0) ::close(std::exchange(input_, -1));
    // Its number is struck off before it is given back: a signal handler that came in between would end whoever has it
    // by then.
    siginfo_t end{};
    while (::waitid(P_PID, static_cast<id_t>(pid_), &end, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
    }
    exchangeRunning(pid_, 0);
    int status = 0;
    pid_t waited = -1;
    while ((waited = ::waitpid(pid_, &status, 0)) < 0 && errno == EINTR) {
    }
    const bool isKnown = waited == pid_;  // not where the caller has children reaped unseen (SIGCHLD ignored)
    pid_ = -1;
    ended.succeeded = isKnown && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    ended.errorText = tailOf(errors_);
    ::close(std::exchange(errors_, -1));
    return ended;
}

}  // namespace lutka::render
