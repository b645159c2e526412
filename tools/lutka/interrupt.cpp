#include "interrupt.hpp"

#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <ctime>

#include "core/temporary_file.hpp"
#include "options.hpp"
#include "render/child_process.hpp"

namespace lutka::cli {
namespace {

// A signal handler can reach nothing but globals.
volatile std::sig_atomic_t caughtSignal = 0;
std::atomic<long long> caughtAtMs = 0;
static_assert(std::atomic<long long>::is_always_lock_free, "a signal handler must not wait for a lock");

/// A shell's exit code of a process that a signal ended, less the signal's number.
constexpr int kShellBase = 128;

/// What is left of the second within which a signal ends everything, after the polite way had its chance.
constexpr long long kGraceMs = 700;

/// Signals nearer than this are one request: `timeout` and terminals send one to the process and one to its group.
constexpr long long kOneRequestMs = 500;

long long nowMs() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<long long>(now.tv_sec) * 1000 + now.tv_nsec / 1'000'000;
}

// An encoder first: it would make its file anew, or write on in it.
void leaveNothingBehind() {
    render::ChildProcess::killAll();
    removeTemporaryFiles();
}

// Nothing looked at the flag in time: a long import, a third party that never returns, or a machine with much else to
// do.
void onTimeUp(int /*number*/) {
    leaveNothingBehind();
    ::_exit(kShellBase + static_cast<int>(caughtSignal));
}

void onSignal(int number) {
    if (caughtSignal == 0) {
        caughtSignal = number;
        caughtAtMs = nowMs();
        itimerval grace{};
        grace.it_value.tv_usec = kGraceMs * 1000;
        ::setitimer(ITIMER_REAL, &grace, nullptr);
    } else if (nowMs() - caughtAtMs >= kOneRequestMs) {
        leaveNothingBehind();
        std::signal(number, SIG_DFL);
        std::raise(number);
    }
}

}  // namespace

void installInterruptHandler() {
    struct sigaction timeUp {};
    timeUp.sa_handler = onTimeUp;
    ::sigaction(SIGALRM, &timeUp, nullptr);
    // A reader that closed its end of our output, or a limit on the size of files (ulimit -f), is an output error like
    // a full disk. A handler instead of SIG_IGN, which the programs that we start would inherit.
    struct sigaction outputFails {};
    outputFails.sa_handler = [](int) {};
    outputFails.sa_flags = SA_RESTART;
    for (const int number : {SIGPIPE, SIGXFSZ})
        ::sigaction(number, &outputFails, nullptr);
    struct sigaction action {};
    action.sa_handler = onSignal;
    for (const int number : {SIGINT, SIGTERM, SIGHUP})
        ::sigaction(number, &action, nullptr);
}

bool interrupted() {
    return caughtSignal != 0;
}

void leaveIfInterrupted() {
    if (caughtSignal != 0) throw Exit{kShellBase + caughtSignal};
}

}  // namespace lutka::cli
