#include "core/confined_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <utility>

#include "core/spawn_arguments.hpp"
#include "core/syscall_filter.hpp"

namespace lutka {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kPollMs = 100;
// The address sanitizer maps terabytes beside what the program asks for.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kShadowed = true;
#else
constexpr bool kShadowed = false;
#endif
constexpr std::size_t kPiece = std::size_t{1} << 16U;

/// A handle that closes itself.
class Handle {
  public:
    explicit Handle(int number) : number_(number) {}
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() { close(); }
    void close() {
        if (number_ >= 0) ::close(std::exchange(number_, -1));
    }
    [[nodiscard]] int get() const { return number_; }

  private:
    int number_;
};

/// A child that is killed and waited for when it is dropped.
class Child {
  public:
    explicit Child(pid_t pid) : pid_(pid) {}
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        if (pid_ < 0) return;
        ::kill(pid_, SIGKILL);
        while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
    /// Whether it has ended; its status then.
    bool ended(int& status) {
        const pid_t got = ::waitpid(pid_, &status, WNOHANG);
        if (got == 0 || (got < 0 && errno == EINTR)) return false;
        pid_ = -1;
        return true;
    }

  private:
    pid_t pid_;
};

Error cannotStart(const std::string& program, int why) {
    return {ErrorCode::internal, std::string("can't be started: ") + std::strerror(why), program, ""};
}

int spawn(const std::vector<std::string>& arguments, int output, pid_t& pid) {
    const std::vector<char*> argv = spawnArguments(arguments);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    // What third parties print is no fact of ours: it goes where the log goes.
    posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, kConfinedOutput);
    const int failed = ::posix_spawn(&pid, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    return failed;
}

// Reads what is there; false at the end of the stream.
bool readSome(int handle, std::string& out) {
    const std::size_t size = out.size();
    out.resize(size + kPiece);
    const ssize_t got = ::read(handle, out.data() + size, kPiece);
    out.resize(size + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    return got > 0 || (got < 0 && (errno == EINTR || errno == EAGAIN));
}

ProcessEnd endOf(int status, std::string output) {
    ProcessEnd end;
    end.output = std::move(output);
    if (WIFEXITED(status)) {
        end.exitCode = WEXITSTATUS(status);
        return end;
    }
    end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    end.kind = end.signal == SIGXCPU ? ProcessEnd::Kind::outOfTime : ProcessEnd::Kind::crashed;
    return end;
}

// Until the child has closed its end and ended, or has to be ended.
ProcessEnd attend(Child& child, const Handle& output, const ProcessLimits& limits, const std::function<bool()>& stop) {
    const Clock::time_point deadline = Clock::now() + std::chrono::seconds(limits.seconds);
    std::string said;
    bool open = true;
    int status = 0;
    for (int wait = 1;;) {
        if (stop && stop()) return {ProcessEnd::Kind::stopped, 0, 0, {}};
        if (Clock::now() >= deadline) return {ProcessEnd::Kind::outOfTime, 0, 0, {}};
        if (said.size() > limits.memoryBytes) return {ProcessEnd::Kind::tooMuchSaid, 0, 0, {}};
        if (open) {
            pollfd handle{output.get(), POLLIN, 0};
            if (::poll(&handle, 1, kPollMs) > 0) open = readSome(output.get(), said);
            continue;
        }
        if (child.ended(status)) return endOf(status, std::move(said));
        ::poll(nullptr, 0, wait);  // it has closed its end and is about to go
        wait = std::min(wait * 2, kPollMs);
    }
}

void limit(__rlimit_resource resource, std::size_t soft, std::size_t hard) {
    rlimit wanted{};
    if (::getrlimit(resource, &wanted) != 0) return;
    wanted.rlim_max = std::min<rlim_t>(wanted.rlim_max, hard);
    wanted.rlim_cur = std::min<rlim_t>(wanted.rlim_max, soft);
    ::setrlimit(resource, &wanted);
}

}  // namespace

Result<ProcessEnd> runConfined(const std::vector<std::string>& arguments, const ProcessLimits& limits,
                               const std::function<bool()>& stop) {
    std::array<int, 2> ends{-1, -1};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return cannotStart(arguments[0], errno);
    const Handle ours(ends[0]);
    Handle theirs(ends[1]);
    pid_t pid = -1;
    if (const int failed = spawn(arguments, theirs.get(), pid); failed != 0) return cannotStart(arguments[0], failed);
    theirs.close();
    Child child(pid);
    return attend(child, ours, limits, stop);
}

void confineThisProcess(const ProcessLimits& limits) {
    constexpr int hardMore = 2;  // seconds between the signal that can be told apart and the one that can't be refused
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::syscall(SYS_close_range, kConfinedOutput + 1, ~0U, 0);
    const auto seconds = static_cast<std::size_t>(limits.seconds);
    limit(RLIMIT_CPU, seconds, seconds + hardMore);
    if (!kShadowed) limit(RLIMIT_AS, limits.memoryBytes, limits.memoryBytes);
    limit(RLIMIT_STACK, limits.stackBytes, limits.stackBytes);
    limit(RLIMIT_NOFILE, static_cast<std::size_t>(limits.openFiles), static_cast<std::size_t>(limits.openFiles));
    limit(RLIMIT_FSIZE, 0, 0);
    limit(RLIMIT_CORE, 0, 0);
    forbidSideEffects();
}

}  // namespace lutka
