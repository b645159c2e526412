#pragma once

/// Rows of pulls on bodies, solved with the joints (tree_kernels.hpp): a hand that is pulled feels the whole doll that
/// hangs on it. Spring and damper are taken at the substep's end, so that no stiffness makes them unstable.

#include "physics/crowd/row_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

LUTKA_LANES void aimDrag(DragLanes& drag, const BodyLanes& body, const SubstepParams& params) {
    store(drag.arm, halfWay(body, axesOf(body) * load(drag.localPoint), all(0.5F * params.dt)));
}

LUTKA_LANES void beginDrag(DragLanes& drag, const BatchView& batch, const SubstepParams& params) {
    const BodyLanes& body = batch.bodies[drag.body];
    const F zero = all(0.0F);
    const V3 core = axesOf(body) * load(drag.localPoint);
    aimDrag(drag, body, params);
    // The target moves back from where it will be at the step's end.
    const V3 rate = load(drag.rate);
    const V3 ahead = load(body.position) + core - load(drag.target) + rate * all(params.remaining);
    store(drag.bias, ahead * load(drag.pull) - rate);
    store(drag.impulse, {zero, zero, zero});
}

// The impulse that the spring asks for at the body's steady velocities.
LUTKA_LANES V3 pullOf(const BodyLanes& body, const DragLanes& drag) {
    const V3 velocity = load(body.steadyVelocity) + cross(load(body.steadyAngular), load(drag.arm));
    return (velocity + load(drag.bias)) * -load(drag.weight);
}

LUTKA_LANES void askDrag(const BodyLanes& body, DragLanes& drag, const Pass& pass, Loaded& loaded) {
    const F zero = all(0.0F);
    const V3 arm = load(drag.arm);
    const F gain = load(drag.gain);
    if (!pass.mending) {
        const V3 before = load(drag.impulse);
        const V3 wanted = pullOf(body, drag);
        // Its direction stays for the substep: what the bound itself has moved says nothing about it.
        const V3 along = choose(pass.applied > zero, before, wanted);
        const V3 bounded = along * within(dot(along, along), load(drag.bound)).share;
        const V3 target = choose(gain > zero, wanted, bounded);
        const V3 push = target - before * pass.applied;
        store(drag.impulse, target);
        loaded.impulse = loaded.impulse + push;
        loaded.torque = loaded.torque + cross(arm, push);
    }
    addPoint(loaded.inertia, arm, {gain, gain, gain, zero, zero, zero});
}

// Guesses for the next pass, and the next substep, whether the force is within its bound; returns the lanes in which it
// was guessed wrong. A bound that throws a light hand past its target is one of them.
LUTKA_LANES Mask updateDrag(const BodyLanes& body, DragLanes& drag, const Pass& pass) {
    const F zero = all(0.0F);
    const V3 wanted = pullOf(body, drag);
    const Mask held = load(drag.gain) > zero;
    const V3 impulse = choose(held, wanted, load(drag.impulse));
    store(drag.impulse, impulse);
    const F bound = load(drag.bound);
    const F size = squareRoot(dot(impulse, impulse));
    const Mask tooStrong = held & (size > bound * all(1.05F));
    const Mask tooWeak =
        ~held & (dot(wanted, impulse) < size * bound * all(0.95F)) & (load(drag.weight) > zero) & ~pass.late;
    store(drag.gain, tooStrong ? zero : (tooWeak ? load(drag.weight) : load(drag.gain)));
    return tooStrong | tooWeak;
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
