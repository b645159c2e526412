#include "core/assert.hpp"

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace lutka {
namespace {

void printAndAbort(const char* expression, const char* file, int line) {
    std::fprintf(stderr, "%s:%d: assertion failed: %s\n", file, line, expression);
    std::abort();
}

// The one piece of process-wide state: an assertion must reach its handler from anywhere.
std::atomic<AssertHandler> currentHandler{&printAndAbort};

}  // namespace

AssertHandler setAssertHandler(AssertHandler handler) {
    return currentHandler.exchange(handler != nullptr ? handler : &printAndAbort);
}

void reportFailedAssertion(const char* expression, const char* file, int line) {
    currentHandler.load()(expression, file, line);
}

}  // namespace lutka
