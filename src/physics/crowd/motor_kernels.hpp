#pragma once

/// Rows of motors in joints, solved with the joints (tree_kernels.hpp): a motor feels all that hangs on it. Spring and
/// damper are taken at the substep's end, so that no stiffness makes them unstable: with stiffness k, damping d, a
/// substep h, the angle e from the target at its start and the target's rate v, the impulse is
///     -h (k (e + h (w - v)) + d (w - v)) = -weight (w - v + pull e),   weight = h (d + h k),   pull = k / (d + h k)
/// at the joint's new rate w.

#include "physics/crowd/row_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

// The rotation vector of a unit quaternion along its shorter arc, radians.
LUTKA_LANES V3 rotationVector(const Q& q) {
    const F zero = all(0.0F);
    const F flip = q.w < zero ? all(-1.0F) : all(1.0F);
    const F sinHalf = squareRoot(q.x * q.x + q.y * q.y + q.z * q.z);
    const F angle = all(2.0F) * angleOf(sinHalf, q.w * flip);
    const F scale = flip * (sinHalf > all(1e-6F) ? angle / most(sinHalf, all(1e-6F)) : all(2.0F));
    return V3{q.x, q.y, q.z} * scale;
}

LUTKA_LANES void beginMotor(MotorLanes& motor, JointLanes& joint, const JointConstants& constants,
                            const BatchView& batch, const SubstepParams& params) {
    const F zero = all(0.0F);
    const BodyLanes& parent = batch.bodies[constants.parent];
    const BodyLanes& child = batch.bodies[constants.child];
    const Q parentFrame = load(parent.rotation) * allTurns(constants.parentFrame);
    const Q relative = conjugate(parentFrame) * (load(child.rotation) * allTurns(constants.childFrame));
    const V3 rate = load(motor.rate);
    // The target turns back from where it will be at the step's end.
    const V3 error = rotationVector(relative * conjugate(load(motor.target))) + rate * all(params.remaining);
    V3 bias = error * load(motor.pull) - rate;
    if (constants.isHinge != 0) bias = {zero, zero, bias.z};
    bias = axesOf(parentFrame) * bias;
    store(motor.bias, bias);
    const V3 before = load(child.angular) - load(parent.angular);
    store(motor.before, before);
    // The two bodies alone would take so much of the spring, the doll more: a torque that is past its bound already is
    // not guessed to be within it, or it throws the limb until the next pass.
    const F weight = load(motor.weight);
    const Symmetric k = load(parent.inverseInertia) + load(child.inverseInertia);
    const F give = most(most(k.xx, k.yy), k.zz) + all(1.0F) / most(weight, all(1e-12F));
    const V3 off = before + bias;
    const F most2 = load(motor.bound) * give;
    store(motor.gain, dot(off, off) > most2 * most2 ? zero : load(motor.gain));
    // What is driven does not stick (see beginJoint): its damper brings it to rest.
    store(joint.frictionLimit, weight > zero ? all(constants.frictionNm * params.dt) : load(joint.frictionLimit));
    store(motor.impulse, {zero, zero, zero});
    store(motor.work, zero);
}

// The part of a joint's turning that its motor acts on, and the impulse that the spring asks for.
LUTKA_LANES V3 drivenTurning(const JointLanes& joint, const JointConstants& constants, const V3& relative) {
    if (constants.isHinge == 0) return relative;
    const V3 axis = load(joint.hinge.axis);
    return axis * dot(axis, relative);
}
LUTKA_LANES V3 driveOf(const MotorLanes& motor, const V3& turning) {
    return (turning + load(motor.bias)) * -load(motor.weight);
}

// Not inlined, and so is updateMotor(): the sweeps of dolls without motors have their registers for themselves.
static __attribute__((noinline)) JointTerms askMotor(MotorLanes& motor, const JointLanes& joint,
                                                     const JointConstants& constants, const V3& relative,
                                                     const Pass& pass) {
    const F zero = all(0.0F);
    const F gain = load(motor.gain);
    JointTerms terms{{zero, zero, zero}, {zero, zero, zero, zero, zero, zero}};
    if (!pass.mending) {
        const V3 before = load(motor.impulse);
        const V3 wanted = driveOf(motor, drivenTurning(joint, constants, relative));
        const V3 target = springTarget(before, wanted, load(motor.bound), gain, pass);
        terms.torque = target - before * pass.applied;
        store(motor.impulse, target);
    }
    if (constants.isHinge != 0) {
        addSquare(terms.weight, load(joint.hinge.axis), gain);
    } else {
        terms.weight.xx = terms.weight.yy = terms.weight.zz = gain;
    }
    return terms;
}

// Returns the lanes in which it was guessed wrong whether the torque is within its bound.
static __attribute__((noinline)) Mask updateMotor(MotorLanes& motor, const JointLanes& joint,
                                                  const JointConstants& constants, const V3& relative,
                                                  const Pass& pass) {
    const V3 wanted = driveOf(motor, drivenTurning(joint, constants, relative));
    const SpringCheck check =
        checkSpring(load(motor.impulse), wanted, load(motor.bound), load(motor.weight), load(motor.gain), pass);
    store(motor.impulse, check.impulse);
    store(motor.gain, check.gain);
    store(motor.work, dot(check.impulse, load(motor.before) + relative) * all(0.5F));
    return check.wrong;
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
