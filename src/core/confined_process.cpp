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
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "core/spawn_arguments.hpp"
#include "core/syscall_filter.hpp"

namespace lutka {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kPollMs = 100;
// The address sanitizer maps terabytes beside what the program asks for. Clang has no macro that tells of it.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kShadowed = true;
#elif defined(__has_feature)
constexpr bool kShadowed = __has_feature(address_sanitizer);
#else
constexpr bool kShadowed = false;
#endif
constexpr std::size_t kPiece = std::size_t{1} << 16U;

/// A handle that closes itself.
class Handle {
  public:
    Handle() = default;
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() { close(); }
    void take(int number) {
        close();
        number_ = number;
    }
    void close() {
        if (number_ >= 0) ::close(std::exchange(number_, -1));
    }
    [[nodiscard]] int get() const { return number_; }

  private:
    int number_ = -1;
};

/// A pipe from a program that is started.
struct Pipe {
    Handle ours, theirs;

    /// 0, or what was wrong (errno). `flags` are those of its ends.
    int open(int flags) {
        std::array<int, 2> ends{-1, -1};
        if (::pipe2(ends.data(), O_CLOEXEC | flags) != 0) return errno;
        ours.take(ends[0]);
        theirs.take(ends[1]);
        // Where our standard streams are closed a pipe gets their numbers, which are to be the program's own.
        for (Handle* end : {&ours, &theirs}) {
            if (end->get() > kConfinedOutput) continue;
            const int above = ::fcntl(end->get(), F_DUPFD_CLOEXEC, kConfinedOutput + 1);
            if (above < 0) return errno;
            end->take(above);
        }
        return 0;
    }
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
    return {ErrorCode::internal, std::string("can't be started: ") + std::strerror(why), program,
            "raise the limits on open files and processes, or end other programs"};
}

int spawn(const std::vector<std::string>& arguments, int output, int printed, pid_t& pid) {
    const std::vector<char*> argv = spawnArguments(arguments);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    // Not our own streams: a limit on written files ends a process that prints to one.
    posix_spawn_file_actions_adddup2(&actions, printed, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, printed, STDERR_FILENO);
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

// Keeps the last of what is printed; false at the end of the stream.
bool readPrinted(int handle, std::string& printed) {
    const bool open = readSome(handle, printed);
    if (printed.size() > kMostPrinted) printed.erase(0, printed.size() - kMostPrinted);
    return open;
}

void setStatus(int status, ProcessEnd& end) {
    if (WIFEXITED(status)) {
        end.exitCode = WEXITSTATUS(status);
        return;
    }
    end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    end.kind = end.signal == SIGXCPU ? ProcessEnd::Kind::outOfTime : ProcessEnd::Kind::crashed;
}

// Whether it must not go on, and as what that counts.
bool hasToEnd(const ProcessLimits& limits, Clock::time_point deadline, const std::function<bool()>& stop,
              ProcessEnd& end) {
    using Kind = ProcessEnd::Kind;
    if (stop && stop())
        end.kind = Kind::stopped;
    else if (Clock::now() >= deadline)
        end.kind = Kind::outOfTime;
    else if (end.output.size() > limits.memoryBytes)
        end.kind = Kind::tooMuchSaid;
    else
        return false;
    end.output.clear();
    return true;
}

// Until the child has closed its result's end and ended, or has to be ended.
ProcessEnd attend(Child& child, const Handle& output, const Handle& printed, const ProcessLimits& limits,
                  const std::function<bool()>& stop) {
    const Clock::time_point deadline = Clock::now() + std::chrono::seconds(limits.seconds);
    ProcessEnd end;
    std::array<pollfd, 2> handles{{{output.get(), POLLIN, 0}, {printed.get(), POLLIN, 0}}};
    int wait = 1;
    while (!hasToEnd(limits, deadline, stop, end)) {
        const bool open = handles[0].fd >= 0;
        int status = 0;
        if (!open && child.ended(status)) {
            setStatus(status, end);
            break;
        }
        // Once it has closed its end it is about to go.
        const int ms = open ? kPollMs : std::exchange(wait, std::min(wait * 2, kPollMs));
        if (::poll(handles.data(), handles.size(), ms) <= 0) continue;
        // A handle below zero is left alone from then on.
        if (handles[0].revents != 0 && !readSome(handles[0].fd, end.output)) handles[0].fd = -1;
        if (handles[1].revents != 0 && !readPrinted(handles[1].fd, end.printed)) handles[1].fd = -1;
    }
    if (handles[1].fd >= 0)
        readPrinted(handles[1].fd, end.printed);  // what is there yet; the pipe doesn't wait for more
    return end;
}

void limit(__rlimit_resource resource, std::size_t soft, std::size_t hard) {
    rlimit wanted{};
    if (::getrlimit(resource, &wanted) != 0) return;
    wanted.rlim_max = std::min<rlim_t>(wanted.rlim_max, hard);
    wanted.rlim_cur = std::min<rlim_t>(wanted.rlim_max, soft);
    ::setrlimit(resource, &wanted);
}

// The address sanitizer makes an exit of a crash, which is to be told as one, and looks for leaks at the end by means
// that are forbidden by then.
void restrainSanitizer() {
    for (const int crash : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
        ::signal(crash, SIG_DFL);
    ::on_exit(
        [](int status, void* /*unused*/) {
            std::fflush(nullptr);
            ::_exit(status);
        },
        nullptr);
}

}  // namespace

Result<ProcessEnd> runConfined(const std::vector<std::string>& arguments, const ProcessLimits& limits,
                               const std::function<bool()>& stop) {
    Pipe output;
    Pipe printed;
    int failed = output.open(0);
    if (failed == 0) failed = printed.open(O_NONBLOCK);
    pid_t pid = -1;
    if (failed == 0) failed = spawn(arguments, output.theirs.get(), printed.theirs.get(), pid);
    if (failed != 0) return cannotStart(arguments[0], failed);
    output.theirs.close();
    printed.theirs.close();
    Child child(pid);
    return attend(child, output.ours, printed.ours, limits, stop);
}

void confineThisProcess(const ProcessLimits& limits) {
    constexpr int hardMore = 2;  // seconds between the signal that can be told apart and the one that can't be refused
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::syscall(SYS_close_range, kConfinedOutput + 1, ~0U, 0);
    const auto seconds = static_cast<std::size_t>(limits.seconds);
    limit(RLIMIT_CPU, seconds, seconds + hardMore);
    if (kShadowed)
        restrainSanitizer();
    else
        limit(RLIMIT_AS, limits.memoryBytes, limits.memoryBytes);
    limit(RLIMIT_STACK, limits.stackBytes, limits.stackBytes);
    limit(RLIMIT_NOFILE, static_cast<std::size_t>(limits.openFiles), static_cast<std::size_t>(limits.openFiles));
    ::signal(SIGXFSZ, SIG_IGN);  // started by hand it may print to a file: that fails then, and no more
    limit(RLIMIT_FSIZE, 0, 0);
    limit(RLIMIT_CORE, 0, 0);
    forbidSideEffects();
}

}  // namespace lutka
