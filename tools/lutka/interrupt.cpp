#include "interrupt.hpp"

#include <atomic>
#include <csignal>
#include <ctime>

#include "options.hpp"

namespace lutka::cli {
namespace {

// A signal handler can reach nothing but globals.
volatile std::sig_atomic_t caughtSignal = 0;
std::atomic<long long> caughtAtMs = 0;
static_assert(std::atomic<long long>::is_always_lock_free, "a signal handler must not wait for a lock");

/// Signals nearer than this are one request: `timeout` and terminals send one to the process and one to its group.
constexpr long long kOneRequestMs = 500;

long long nowMs() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<long long>(now.tv_sec) * 1000 + now.tv_nsec / 1'000'000;
}

void onSignal(int number) {
    if (caughtSignal == 0) {
        caughtSignal = number;
        caughtAtMs = nowMs();
    } else if (nowMs() - caughtAtMs >= kOneRequestMs) {
        std::signal(number, SIG_DFL);
        std::raise(number);
    }
}

}  // namespace

void installInterruptHandler() {
    struct sigaction action {};
    action.sa_handler = onSignal;
    for (const int number : {SIGINT, SIGTERM, SIGHUP})
        ::sigaction(number, &action, nullptr);
}

bool interrupted() {
    return caughtSignal != 0;
}

void leaveIfInterrupted() {
    constexpr int kShellBase = 128;
    if (caughtSignal != 0) throw Exit{kShellBase + caughtSignal};
}

}  // namespace lutka::cli
