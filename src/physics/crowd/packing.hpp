#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Packs the contacts of each part of each job (see partTouches()) into blocks of lanes in which no body comes twice.
void packTouches(CrowdState& state);

/// Has the contacts of a block brought near, if there is such a block: they lie far from each other. Always inlined: to
/// GCC a function that only does this has no effect, and it leaves out calls of it.
[[gnu::always_inline]] inline void fetchTouches(const CrowdState& state, std::size_t block) {
    constexpr std::size_t kLine = 64;
    if (block >= state.touchOfLane.size()) return;
    for (const int index : state.touchOfLane[block]) {
        if (index < 0) continue;
        const char* const touch = reinterpret_cast<const char*>(&state.touches[index]);
        __builtin_prefetch(touch);
        __builtin_prefetch(touch + kLine);
    }
}

}  // namespace lutka::physics::crowd
