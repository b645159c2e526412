#pragma once

#include "physics/crowd/contact_lanes.hpp"
#include "physics/crowd/substep_params.hpp"

/// Rules for contacts between two bodies that hold alike for one contact (`float`) and for one a lane of the kernels.
/// Always inlined, so that the linker has no copy of them that one instruction set alone can run.
#define LUTKA_RULE [[gnu::always_inline]] static inline

namespace lutka::physics::crowd {

/// What a contact that presses with `pressed` N s carries into the next substep, N s. Within a doll, and between bodies
/// without joints, a load builds up and a blow is over: what answers pressed with to stop a blow would drive the bodies
/// apart. Of dolls that touch others each load goes on. `load`: what it carried into this substep, N s; `mass`: of the
/// two bodies along the normal, kg; `speed`: SubstepTuning::ownLoad.
template <class Number>
LUTKA_RULE Number carriedLoad(const Number& kind, const Number& pressed, const Number& load, const Number& mass,
                              float speed) {
    const Number grown = 2.0F * load + mass * speed;
    const auto grows = (kind == PairKind::own) | (kind == PairKind::other);
    return grows ? (pressed < grown ? pressed : grown) : pressed;
}

/// Whether two bodies whose surfaces are `separation` metres apart overlap by enough to be mended.
template <class Number>
LUTKA_RULE auto overlaps(const Number& separation, const SubstepParams& params) {
    return separation < -params.slop - params.mendGap;
}

/// The speed that they are to part with when errors of position are mended, m/s. What overlaps is pushed apart, with
/// `fastest` m/s at most, and `haste` times that. What does not may come no nearer than touching.
template <class Number>
LUTKA_RULE Number mendSpeed(const Number& separation, const Number& fastest, const Number& haste,
                            const SubstepParams& params) {
    const Number apart = -(separation + params.slop) * params.contactRate;
    const Number pushed = (apart < fastest ? apart : fastest) * haste;
    const Number zero{};
    const Number gap = separation > zero ? separation : zero;
    return overlaps(separation, params) ? pushed : -gap * params.inverseDt;
}

}  // namespace lutka::physics::crowd

#undef LUTKA_RULE
