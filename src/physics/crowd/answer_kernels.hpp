#pragma once

/// Further sweeps over the contacts between dolls, each after the dolls have answered the one before.
///
/// A sweep pushes as the masses of single bodies ask. Joints only make a body move less under a push, never more, so
/// that the contacts are not pressed by more than the dolls can bear: each sweep and answer together come nearer to
/// what all contacts ask at once, as long as impulses are gathered and given back where they were too much (a majorized
/// problem that is solved again and again; Hunter and Lange 2004). Pushing harder than that, as if the dolls were
/// heavier, makes energy from nothing where many press at once.

#include "physics/crowd/contact_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

// One sweep over what is still wrong by more than a little. Friction waits for the next substep.
static int pressAgain(PairContactLanes* pairs, int count, const SubstepParams& params) {
    const F zero = all(0.0F);
    const F tolerance = all(params.answerSpeed);
    int changed = 0;
    for (int i = 0; i < count; ++i) {
        PairContactLanes& pair = pairs[i];
        pair.changed = 0;
        PairVelocities v = velocitiesOf(pair);
        const F before = load(pair.normalImpulse);
        const F off = dot(load(pair.normal), slidingOf(pair, v)) + contactBias(load(pair.separation), params, 0);
        const Mask wrong = (load(pair.strikes) > zero) & ((off < -tolerance) | ((before > zero) & (off > tolerance)));
        if (bits(wrong) == 0) continue;
        makeReady(pair);
        const F total = wrong ? most(before - load(pair.normalMass) * off, zero) : before;
        pair.changed = static_cast<int>(bits(total != before));
        if (pair.changed == 0) continue;
        ++changed;
        store(pair.normalImpulse, total);
        store(pair.carriedNormal, total - before);  // has been carried, and is free
        pressPair(pair, v, total - before);
        storeVelocities(pair, v);
    }
    if (changed == 0) return 0;
    // Supports get what was held back from them, as in carryPairs().
    for (int i = 0; i < count; ++i) {
        const PairContactLanes& pair = pairs[i];
        if (pair.changed == 0) continue;
        const F push = load(pair.carriedNormal);
        PairVelocities v = velocitiesOf(pair);
        pushRest(pair, v, load(pair.normal) * push, push);
        storeVelocities(pair, v);
    }
    return changed;
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
