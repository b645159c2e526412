#pragma once

/// Rows that lead bodies to frames in motion, solved with the joints (tree_kernels.hpp): a led body carries the doll
/// that hangs on it. Spring and damper are taken at the substep's end, as in motor_kernels.hpp. A kinematic body's row
/// is as heavy as many dolls, and what it is still off by after a pass is added to its impulse (method of multipliers).

#include "physics/crowd/motor_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

LUTKA_LANES void beginTarget(TargetLanes& target, const BodyLanes& body, const SubstepParams& params) {
    const F zero = all(0.0F);
    // The target moves back from where it will be at the step's end.
    const V3 rate = load(target.rate);
    const V3 ahead = load(body.position) - load(target.position) + rate * all(params.remaining);
    store(target.goal, rate - ahead * load(target.pull));
    const V3 turnRate = load(target.turnRate);
    const V3 turned =
        rotationVector(load(body.rotation) * conjugate(load(target.rotation))) + turnRate * all(params.remaining);
    store(target.turnGoal, turnRate - turned * load(target.pull));
    store(target.before, load(body.velocity));
    store(target.turnBefore, load(body.angular));
    store(target.impulse, {zero, zero, zero});
    store(target.torque, {zero, zero, zero});
    store(target.work, zero);
}

struct TargetTerms {
    V3 impulse, torque;
    F weight, turnWeight;
};
// Not inlined, and so are the next ones: the sweeps of dolls without targets have their registers for themselves.
static __attribute__((noinline)) TargetTerms askTarget(const BodyLanes& body, const TargetLanes& target,
                                                       const Pass& pass) {
    const F zero = all(0.0F);
    TargetTerms terms{{zero, zero, zero}, {zero, zero, zero}, load(target.weight), load(target.turnWeight)};
    if (pass.mending) return terms;
    const F springs = pass.applied * (all(1.0F) - load(target.kinematic));
    terms.impulse = (load(target.goal) - load(body.steadyVelocity)) * terms.weight - load(target.impulse) * springs;
    terms.torque =
        (load(target.turnGoal) - load(body.steadyAngular)) * terms.turnWeight - load(target.torque) * springs;
    return terms;
}
LUTKA_LANES void addTarget(const TargetTerms& terms, Loaded& loaded) {
    loaded.impulse = loaded.impulse + terms.impulse;
    loaded.torque = loaded.torque + terms.torque;
    loaded.inertia.linear.xx += terms.weight;
    loaded.inertia.linear.yy += terms.weight;
    loaded.inertia.linear.zz += terms.weight;
    loaded.inertia.turning.xx += terms.turnWeight;
    loaded.inertia.turning.yy += terms.turnWeight;
    loaded.inertia.turning.zz += terms.turnWeight;
}

// After the sweep: what the row has given, and its work.
static __attribute__((noinline)) void updateTarget(const BodyLanes& body, TargetLanes& target) {
    const F kinematic = load(target.kinematic);
    const V3 velocity = load(body.steadyVelocity);
    const V3 angular = load(body.steadyAngular);
    const V3 impulse = load(target.impulse) * kinematic + (load(target.goal) - velocity) * load(target.weight);
    const V3 torque = load(target.torque) * kinematic + (load(target.turnGoal) - angular) * load(target.turnWeight);
    store(target.impulse, impulse);
    store(target.torque, torque);
    store(target.work,
          (dot(impulse, velocity + load(target.before)) + dot(torque, angular + load(target.turnBefore))) * all(0.5F));
}

// 0 in the lanes in which both bodies of a joint are kinematic, else 1: what the joint would hold there is held.
LUTKA_LANES F freeToTurn(const BatchView& batch, const JointConstants& constants) {
    return all(1.0F) - load(batch.targets[constants.parent].kinematic) * load(batch.targets[constants.child].kinematic);
}
LUTKA_LANES JointTerms scaled(const JointTerms& terms, F factor) {
    const Symmetric& w = terms.weight;
    return {terms.torque * factor,
            {w.xx * factor, w.yy * factor, w.zz * factor, w.xy * factor, w.xz * factor, w.yz * factor}};
}
LUTKA_LANES void scale(Wide3& v, F factor) {
    store(v, load(v) * factor);
}
// What such a joint's rows have gathered must not act when a body is let go of.
static __attribute__((noinline)) void forgetHeld(JointLanes& joint, const JointConstants& constants, F free) {
    scale(joint.frictionImpulse, free);
    if (constants.isHinge != 0 || constants.isLocked != 0) scale(joint.hinge.impulse, free);
    for (LimitRow& limit : joint.limit)
        store(limit.impulse, load(limit.impulse) * free);
}

// Nor has a motor there done any work.
LUTKA_LANES void drivesOnly(MotorLanes& motor, F free) {
    store(motor.work, load(motor.work) * free);
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
