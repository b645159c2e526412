#pragma once

namespace lutka {

/// Called with the failed expression and its place. The default prints both to stderr and aborts.
using AssertHandler = void (*)(const char* expression, const char* file, int line);

/// Replaces the handler (null: the default again) and returns the one before. Not thread-safe: set it at start-up.
AssertHandler setAssertHandler(AssertHandler handler);

/// Reports a failed assertion to the handler; what LUTKA_ASSERT calls.
void reportFailedAssertion(const char* expression, const char* file, int line);

}  // namespace lutka

/// Checks what only a caller's bug can break. On in debug and sanitizer builds, compiled out under NDEBUG.
#ifdef NDEBUG
#define LUTKA_ASSERT(expression) static_cast<void>(sizeof(!(expression)))
#else
#define LUTKA_ASSERT(expression) \
    ((expression) ? static_cast<void>(0) : ::lutka::reportFailedAssertion(#expression, __FILE__, __LINE__))
#endif
