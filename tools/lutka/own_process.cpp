#include "own_process.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>

#include "interrupt.hpp"

namespace lutka::cli {
namespace {

/// A process that is ended when it is dropped before its end was waited for.
class Forked {
  public:
    Forked(pid_t pid, int output) : pid_(pid), output_(output) {}
    Forked(const Forked&) = delete;
    Forked& operator=(const Forked&) = delete;
    ~Forked() {
        ::close(output_);
        if (pid_ < 0) return;
        ::kill(pid_, SIGKILL);
        static_cast<void>(wait());
    }

    /// All that it writes, until it closes its end. Looks for signals meanwhile.
    [[nodiscard]] std::string read() const {
        constexpr int kLookMs = 100;
        std::string text;
        std::array<char, 4096> piece{};
        while (true) {
            leaveIfInterrupted();
            pollfd waiting{output_, POLLIN, 0};
            if (::poll(&waiting, 1, kLookMs) <= 0) continue;
            const ssize_t got = ::read(output_, piece.data(), piece.size());
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) return text;
            text.append(piece.data(), static_cast<std::size_t>(got));
        }
    }

    /// Its status, once it has ended.
    [[nodiscard]] int wait() {
        int status = 0;
        while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
        }
        pid_ = -1;
        return status;
    }

  private:
    pid_t pid_;
    int output_;
};

[[noreturn]] void serve(const std::function<std::string()>& work, int output) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    int code = 1;
    try {
        const std::string text = work();
        std::size_t at = 0;
        while (at < text.size()) {
            const ssize_t put = ::write(output, text.data() + at, text.size() - at);
            if (put < 0 && errno == EINTR) continue;
            if (put <= 0) break;
            at += static_cast<std::size_t>(put);
        }
        code = at == text.size() ? 0 : 1;
    } catch (const std::exception& unexpected) {
        fmt::print(stderr, "lutka: internal failure: {}\n", unexpected.what());
    }
    ::_exit(code);  // what the other process has in its buffers is its own to write
}

Error lost(const std::string& how) {
    return {ErrorCode::internal, "the process of its own " + how, {}, {}};
}

}  // namespace

Result<std::string> inOwnProcess(const std::function<std::string()>& work) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) return lost(fmt::format("has no pipe: {}", std::strerror(errno)));
    std::fflush(nullptr);
    const pid_t pid = ::fork();
    if (pid == 0) {
        ::close(ends[0]);
        serve(work, ends[1]);
    }
    ::close(ends[1]);
    if (pid < 0) {
        ::close(ends[0]);
        return lost(fmt::format("can't be started: {}", std::strerror(errno)));
    }
    Forked forked(pid, ends[0]);
    std::string text = forked.read();
    const int status = forked.wait();
    if (WIFSIGNALED(status)) return lost(fmt::format("was ended by signal {}", WTERMSIG(status)));
    if (WEXITSTATUS(status) != 0) return lost(fmt::format("ended with {}", WEXITSTATUS(status)));
    return text;
}

}  // namespace lutka::cli
