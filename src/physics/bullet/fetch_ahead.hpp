#pragma once

#include <cstddef>

namespace lutka::physics {

/// Asks for the memory of what comes next while something else is worked on: Bullet's objects lie scattered, and a
/// substep of many dolls touches more of them than the caches hold.
inline void fetchAhead(const void* start, std::size_t bytes) {
    constexpr std::size_t kLine = 64;
    for (std::size_t i = 0; i < bytes; i += kLine)
        __builtin_prefetch(static_cast<const char*>(start) + i);
}

}  // namespace lutka::physics
