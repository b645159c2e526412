#pragma once

/// A second push of the contacts between bodies that were hit: after the dolls have answered the first one.
///
/// A contact pushes as the masses of its two bodies alone ask. The dolls that these belong to set more against it, so
/// that a part of the approach is left once the joints are solved. What share of the asked change was reached says how
/// much heavier the dolls are at this point than the two bodies, whatever else pushes them at the same time: the second
/// push is so much stronger, within a bound (the secant method; Aitken's extrapolation of a fixed point).

#include "physics/crowd/contact_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

// Gives back what supports held of the push, as carryPairs() does after the first sweep.
LUTKA_LANES void passToSupports(const PairContactLanes& pair, F push) {
    PairVelocities v = velocitiesOf(pair);
    pushRest(pair, v, load(pair.normal) * push, push);
    storeVelocities(pair, v);
}

static int solveHits(PairContactLanes* pairs, int count, const SubstepParams& params) {
    const F zero = all(0.0F), one = all(1.0F);
    int struck = 0;
    for (int i = 0; i < count; ++i) {
        PairContactLanes& pair = pairs[i];
        if (pair.hit == 0) continue;
        PairVelocities v = velocitiesOf(pair);
        const F off = dot(load(pair.normal), slidingOf(pair, v)) + contactBias(load(pair.separation), params, 0);
        const F asked = load(pair.asked);
        const Mask comes = (off < all(-params.hitSpeed)) & (asked < zero);
        pair.hit = static_cast<int>(bits(comes));
        if (pair.hit == 0) continue;
        ++struck;
        // The share of the asked change that was reached.
        const F reached = (asked - off) / least(asked, all(-1e-6F));
        const F heavier = clampLanes(one / most(reached, all(1e-3F)), one, all(params.hitRate));
        const F push = comes ? load(pair.normalMass) * -off * heavier : zero;
        store(pair.struck, load(pair.struck) + push);
        store(pair.asked, off);
        store(pair.carriedNormal, push);  // has been carried, and is free
        pressPair(pair, v, push);
        storeVelocities(pair, v);
    }
    if (struck == 0) return 0;
    for (int i = 0; i < count; ++i) {
        if (pairs[i].hit != 0) passToSupports(pairs[i], load(pairs[i].carriedNormal));
    }
    return struck;
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
