#pragma once

/// Further sweeps over the contacts of dolls, each after the dolls have answered the one before.
///
/// A sweep pushes as the masses of single bodies ask. Joints only make a body move less under a push, never more, so
/// that the contacts are not pressed by more than the dolls can bear: each sweep and answer together come nearer to
/// what all contacts ask at once, as long as impulses are gathered and given back where they were too much (a majorized
/// problem that is solved again and again; Hunter and Lange 2004). Pushing harder than that, as if the dolls were
/// heavier, makes energy from nothing where many press at once.

#include "physics/crowd/contact_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

// What a sweep asks of the contacts within dolls.
struct OwnAnswer {
    Mask wrong;
    F mass;   // kg, that they are pressed with
    F bound;  // N s, up to which
};

// Only what would be deep by the substep's end is pressed, and only what was pressed is released. What hangs on the two
// bodies is many times their mass: the last push and what it has changed say how many. For one contact that is a secant
// step; several of one doll show what they do together.
LUTKA_LANES OwnAnswer answerOfOwn(const PairContactLanes& pair, F approach, F off, const SubstepParams& params,
                                  int sweep) {
    const F zero = all(0.0F);
    const F tolerance = all(params.answerSpeed);
    const F before = load(pair.normalImpulse);
    const F mass = load(pair.normalMass);
    const F deep = approach + (load(pair.separation) + all(params.ownDepth)) * all(params.inverseDt);
    const Mask sinks = isOwn(pair) & (deep < zero) & (approach < all(-params.ownSpeed));
    // Two contacts that wedge a limb between them press each other ever harder.
    const F bound = most(before, mass * all(params.ownMass * params.ownBlow));
    if (sweep == 0 || pair.answered != sweep) return {sinks, mass, bound};
    // Zero where only others of its block were pressed: what a lane is told does not depend on these.
    const F pushed = load(pair.carriedNormal);
    const F gained = off - load(pair.carriedTangent[0]);
    const F shown = clampLanes(pushed / most(magnitude(gained), all(1e-6F)), mass, mass * all(params.ownMass));
    const Mask leaves = isOwn(pair) & (pushed != zero) & (before > zero) & (off > tolerance);
    return {sinks | leaves, pushed * gained > zero ? shown : mass, bound};
}

// The lanes in which a contact within a doll was part of a sweep that has given the doll energy: together they were too
// much.
LUTKA_LANES Mask overshoots(const PairContactLanes& pair, const PairBodies& bodies) {
    const F rises = readRows(bodies.frames, pair.bodyA, kPlaceRow).column[kRisesColumn];
    return isOwn(pair) & (rises > all(0.0F)) & (load(pair.carriedNormal) != all(0.0F));
}

// One sweep over what is still wrong by more than a little. Friction waits for the next substep.
static void pressAgain(PairsView& view, const SubstepParams& params, int sweep) {
    const PairBodies& bodies = view.bodies;
    const F zero = all(0.0F);
    const F tolerance = all(params.answerSpeed);
    view.changedCount = 0;
    for (int i = 0; i < view.liveCount; ++i) {
        PairContactLanes& pair = pairAt(view, view.live[i]);
        PairVelocities v = velocitiesOf(pair, bodies);
        const F before = load(pair.normalImpulse);
        const F approach = dot(load(pair.normal), slidingOf(pair, v));
        const F off = approach + contactBias(load(pair.separation), params, 0);
        const Mask wrong = (off < -tolerance) | ((before > zero) & (off > tolerance));
        const bool takesBack = sweep > 0 && sweep < params.ownSweeps && pair.answered == sweep;
        const Mask over = takesBack ? overshoots(pair, bodies) : noLanes();
        if (bits((wrong & isOfDolls(pair)) | over) == 0) continue;
        makeReady(pair, bodies);
        const Mask struck = sweep < params.answerSweeps ? wrong & strikes(pair) : noLanes();
        const OwnAnswer own = answerOfOwn(pair, approach, off, params, sweep);
        const Mask pressed = sweep < params.ownSweeps ? own.wrong : noLanes();
        const F asked = most(before - (pressed ? own.mass : load(pair.normalMass)) * off, zero);
        const F answered = pressed ? least(asked, own.bound) : (struck ? asked : before);
        const F total = over ? most(before - all(0.5F) * load(pair.carriedNormal), zero) : answered;
        if (bits(total != before) == 0) continue;
        view.changed[view.changedCount++] = view.live[i];
        pair.answered = sweep + 1;
        store(pair.normalImpulse, total);
        store(pair.carriedNormal, total - before);  // has been carried, and is free
        store(pair.carriedTangent[0], off);         // likewise
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
        const F by = strikes(pair) ? all(Pressed::byDoll) : all(Pressed::within);
        const F pressed = push != zero ? by : zero;
        writeNoted(bodies, pair.bodyA, kPressedColumn, a, v.velocityA, v.angularA, pressed);
        writeNoted(bodies, pair.bodyB, kPressedColumn, b, v.velocityB, v.angularB, pressed);
    }
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
