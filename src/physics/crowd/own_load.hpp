#pragma once

#include "physics/crowd/layout.hpp"

namespace lutka::physics::crowd {

/// What a contact between two bodies of one doll may carry into the next substep, N s. A load builds up, a blow is
/// over: what answers pressed with to stop a blow would drive the bodies apart. `load`: what it carried into this
/// substep, N s; `mass`: of the two bodies along the normal, kg; `speed`: SubstepTuning::ownLoad. For one contact or
/// for one a lane. Always inlined, so that the linker has no copy of it that one instruction set alone can run.
template <class Number>
[[gnu::always_inline]] static inline Number grownLoad(const Number& load, const Number& mass, float speed) {
    return 2.0F * load + mass * speed;
}

/// Whether what it carries is bound by that, by what kind of contact it is (PairKind): of dolls that touch others each
/// load goes on. Likewise for one contact or for one a lane.
template <class Number>
[[gnu::always_inline]] static inline auto growsLoad(const Number& kind) {
    return (kind == PairKind::own) | (kind == PairKind::other);
}

}  // namespace lutka::physics::crowd
