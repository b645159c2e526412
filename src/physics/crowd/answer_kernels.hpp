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

// Notes for the dolls of both bodies that they have to answer.
LUTKA_LANES void storePressed(const PairContactLanes& pair, const PairBodies& bodies, const PairVelocities& v,
                              const Mask& pressed) {
    const F one = all(1.0F);
    Columns a = columnsOf(v.velocityA, v.angularA);
    Columns b = columnsOf(v.velocityB, v.angularB);
    a.column[6] = pressed ? one : readRows(bodies.motions, pair.bodyA, 0).column[6];
    b.column[6] = pressed ? one : readRows(bodies.motions, pair.bodyB, 0).column[6];
    writeRows(bodies.motions, pair.bodyA, 0, a);
    writeRows(bodies.motions, pair.bodyB, 0, b);
}

// One sweep over what is still wrong by more than a little. Friction waits for the next substep.
static int pressAgain(const PairsView& view, const SubstepParams& params) {
    const PairBodies& bodies = view.bodies;
    const F zero = all(0.0F);
    const F tolerance = all(params.answerSpeed);
    int found = 0;
    for (int i = 0; i < view.liveCount; ++i) {
        PairContactLanes& pair = view.pairs[view.live[i]];
        PairVelocities v = velocitiesOf(pair, bodies);
        const F before = load(pair.normalImpulse);
        const F off = dot(load(pair.normal), slidingOf(pair, v)) + contactBias(load(pair.separation), params, 0);
        const Mask wrong = (load(pair.strikes) > zero) & ((off < -tolerance) | ((before > zero) & (off > tolerance)));
        if (bits(wrong) == 0) continue;
        makeReady(pair, bodies);
        const F total = wrong ? most(before - load(pair.normalMass) * off, zero) : before;
        if (bits(total != before) == 0) continue;
        view.changed[found++] = view.live[i];
        store(pair.normalImpulse, total);
        store(pair.carriedNormal, total - before);  // has been carried, and is free
        pressPair(pair, v, total - before);
        storeVelocities(pair, bodies, v);
    }
    // Supports get what was held back from them, as in carryPairs().
    for (int i = 0; i < found; ++i) {
        const PairContactLanes& pair = view.pairs[view.changed[i]];
        const F push = load(pair.carriedNormal);
        PairVelocities v = velocitiesOf(pair, bodies);
        pushRest(pair, bodies, v, load(pair.normal) * push, push);
        storePressed(pair, bodies, v, push != zero);
    }
    return found;
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
