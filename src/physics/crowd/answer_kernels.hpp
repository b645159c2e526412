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
static void pressAgain(PairsView& view, const SubstepParams& params) {
    const PairBodies& bodies = view.bodies;
    const F zero = all(0.0F);
    const F tolerance = all(params.answerSpeed);
    view.changedCount = 0;
    for (int i = 0; i < view.liveCount; ++i) {
        PairContactLanes& pair = pairAt(view, view.live[i]);
        PairVelocities v = velocitiesOf(pair, bodies);
        const F before = load(pair.normalImpulse);
        const F off = dot(load(pair.normal), slidingOf(pair, v)) + contactBias(load(pair.separation), params, 0);
        const Mask wrong = (strikes(pair)) & ((off < -tolerance) | ((before > zero) & (off > tolerance)));
        if (bits(wrong) == 0) continue;
        makeReady(pair, bodies);
        const F total = wrong ? most(before - load(pair.normalMass) * off, zero) : before;
        if (bits(total != before) == 0) continue;
        view.changed[view.changedCount++] = view.live[i];
        store(pair.normalImpulse, total);
        store(pair.carriedNormal, total - before);  // has been carried, and is free
        pressPair(pair, v, total - before);
        storeVelocities(pair, bodies, v);
    }
}

// Supports get what was held back from them, as in carryPairs().
static void pressRest(const PairsView& view) {
    const PairBodies& bodies = view.bodies;
    const F zero = all(0.0F);
    for (int i = 0; i < view.changedCount; ++i) {
        const PairContactLanes& pair = pairAt(view, view.changed[i]);
        const F push = load(pair.carriedNormal);
        const Columns a = readRows(bodies.motions, pair.bodyA, 0);
        const Columns b = readRows(bodies.motions, pair.bodyB, 0);
        PairVelocities v{first3(a), second3(a), first3(b), second3(b)};
        pushRest(pair, bodies, v, load(pair.normal) * push, push);
        // Their dolls have to answer.
        writeNoted(bodies, pair.bodyA, kPressedColumn, a, v.velocityA, v.angularA, push != zero);
        writeNoted(bodies, pair.bodyB, kPressedColumn, b, v.velocityB, v.angularB, push != zero);
    }
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
