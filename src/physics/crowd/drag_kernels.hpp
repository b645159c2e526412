#pragma once

/// Rows of pulls on bodies, solved with the joints (tree_kernels.hpp): a hand that is pulled feels the whole doll that
/// hangs on it. Spring and damper are taken at the substep's end, so that no stiffness makes them unstable.

#include "physics/crowd/row_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_CROWD_KERNELS {

LUTKA_LANES void beginDrag(DragLanes& drag, const BatchView& batch, const SubstepParams& params) {
    const BodyLanes& body = batch.bodies[drag.body];
    const F zero = all(0.0F);
    const V3 core = axesOf(body) * load(drag.localPoint);
    store(drag.arm, halfWay(body, core, all(0.5F * params.dt)));
    store(drag.bias, (load(body.position) + core - load(drag.target)) * load(drag.pull));
    store(drag.impulse, {zero, zero, zero});
    store(drag.gain, zero);
}

// The impulse that the spring asks for at the body's steady velocities.
LUTKA_LANES V3 pullOf(const BodyLanes& body, const DragLanes& drag) {
    const V3 velocity = load(body.steadyVelocity) + cross(load(body.steadyAngular), load(drag.arm));
    return (velocity + load(drag.bias)) * -load(drag.weight);
}

LUTKA_LANES void askDrag(const BodyLanes& body, DragLanes& drag, const Pass& pass, Loaded& loaded) {
    const F zero = all(0.0F);
    const V3 arm = load(drag.arm);
    if (!pass.mending) {
        const V3 wanted = pullOf(body, drag);
        const Bounded bound = within(dot(wanted, wanted), load(drag.bound));
        const Mask holds = bound.holds | (pass.late & (load(drag.gain) > zero));
        const V3 target = choose(holds, wanted, wanted * bound.share);
        const V3 push = target - load(drag.impulse) * pass.applied;
        store(drag.gain, holds ? load(drag.weight) : zero);
        store(drag.impulse, target);
        loaded.impulse = loaded.impulse + push;
        loaded.torque = loaded.torque + cross(arm, push);
    }
    const F gain = load(drag.gain);
    addPoint(loaded.inertia, arm, {gain, gain, gain, zero, zero, zero});
}

// Returns the lanes in which the force was wrongly guessed to be within its bound, or not to be.
LUTKA_LANES Mask updateDrag(const BodyLanes& body, DragLanes& drag, const Pass& pass) {
    const V3 wanted = pullOf(body, drag);
    const Mask held = load(drag.gain) > all(0.0F);
    store(drag.impulse, choose(held, wanted, load(drag.impulse)));
    const F size = squareRoot(dot(wanted, wanted));
    const F bound = load(drag.bound);
    const Mask wrong = held ? size > bound * all(1.05F) : size < bound * all(0.95F);
    return wrong & ~pass.late;
}

}  // namespace lutka::physics::crowd::LUTKA_CROWD_KERNELS
