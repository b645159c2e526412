#pragma once

/// Rows of pulls on bodies, solved with the joints (tree_kernels.hpp): a hand that is pulled feels the whole doll that
/// hangs on it. Spring and damper are taken at the substep's end, so that no stiffness makes them unstable.

#include "physics/crowd/row_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

LUTKA_LANES void aimDrag(DragLanes& drag, const BodyLanes& body) {
    store(drag.arm, halfWay(body, axesOf(body) * load(drag.localPoint)));
}

LUTKA_LANES void beginDrag(DragLanes& drag, const BatchView& batch, const SubstepParams& params) {
    const BodyLanes& body = batch.bodies[drag.body];
    const F zero = all(0.0F);
    const V3 core = axesOf(body) * load(drag.localPoint);
    aimDrag(drag, body);
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
        const V3 target = springTarget(before, pullOf(body, drag), load(drag.bound), gain, pass);
        const V3 push = target - before * pass.applied;
        store(drag.impulse, target);
        loaded.impulse = loaded.impulse + push;
        loaded.torque = loaded.torque + cross(arm, push);
    }
    addPoint(loaded.inertia, arm, {gain, gain, gain, zero, zero, zero});
}

// Returns the lanes in which it was guessed wrong whether the force is within its bound.
LUTKA_LANES Mask updateDrag(const BodyLanes& body, DragLanes& drag, const Pass& pass) {
    const SpringCheck check =
        checkSpring(load(drag.impulse), pullOf(body, drag), load(drag.bound), load(drag.weight), load(drag.gain), pass);
    store(drag.impulse, check.impulse);
    store(drag.gain, check.gain);
    return check.wrong;
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
