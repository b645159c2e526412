#include "interrupt.hpp"

#include <csignal>

#include "options.hpp"

namespace lutka::cli {
namespace {

// A signal handler can reach nothing but globals.
volatile std::sig_atomic_t caughtSignal = 0;

}  // namespace

void installInterruptHandler() {
    struct sigaction action {};
    action.sa_handler = [](int number) { caughtSignal = number; };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    for (const int number : {SIGINT, SIGTERM, SIGHUP})
        ::sigaction(number, &action, nullptr);
}

void leaveIfInterrupted() {
    constexpr int kShellBase = 128;
    if (caughtSignal != 0) throw Exit{kShellBase + caughtSignal};
}

}  // namespace lutka::cli
