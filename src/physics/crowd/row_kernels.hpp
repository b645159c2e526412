#pragma once

/// The rows that take part in the tree solver: which of them hold, and what they push. See tree_kernels.hpp.
///
/// A row is one equation J v + bias = 0 between velocities: a joint's stop, a contact's normal, friction. Three numbers
/// belong to each: its `impulse` (N s or N m s, kept from substep to substep), its `weight` (by how much a speed that
/// is wrong changes the impulse: N s per m/s, N m s per rad/s) and its `gain`, which is the weight while the row holds
/// and 0 while it does not. ask…() comes on the way up the tree: it decides whether the row holds and adds it to the
/// equations. update…() comes on the way down: it takes the impulse that came of it and tells where the decision was
/// wrong. All of it happens in eight lanes at once, so decisions are masks, not branches.

#include "physics/crowd/static_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

// Which pass over the tree this is: a substep makes several until the guess of which rows hold is right.
struct Pass {
    bool mending;  ///< Mends errors of position on top of the steady velocities; friction rests and nothing is kept.
    F applied;     ///< 1 where the rows' impulses are already in the velocities, else 0.
    bool begun;    ///< Whether a pass of this substep has been made before.
    /// Lanes whose guesses will not come to rest: rows are only added any more, and those that hold just stop what
    /// comes.
    Mask late;
    F stiction;   ///< Factor on all friction.
    Mask astray;  ///< Gathers the lanes in which a body turns at another rate than its arms were foreseen with.
    Mask alone;   ///< Lanes in which no other doll pushes, where the job is no heap.
    F firmness = all(1.0F);  ///< Mending, factor on the stiffness of static contacts.
    bool probes = false;     ///< Mending, to see what comes of it: what it runs through does not hold.
};

// What the rows of a joint add to the equations: a torque on the child, and a weight matrix of the relative turning.
struct JointTerms {
    V3 torque;
    Symmetric weight;
};

// The speed (m/s or rad/s) with which a one-sided row may still go towards its stop. Ahead of the stop (positive bias)
// that is what just reaches it in this substep. In late lanes, where passes did not agree on what holds, a row that
// holds allows nothing: that can only take energy away, whether or not it should have held.
LUTKA_LANES F oneSidedBias(F bias, const Mask& held, const Pass& pass) {
    const F zero = all(0.0F);
    const F ahead = most(bias, zero);
    return (held & pass.late) ? zero : ahead;
}

// What a mending pass asks of a one-sided row. One that holds keeps its speed, or leaves with the speed that mends its
// overrun. One that is overrun, did not hold and leaves more slowly than that holds from now on. Returns the row's gain
// and the speed that is to be taken off.
struct Mended {
    F gain, off;
};
LUTKA_LANES Mended mendRow(F rate, F bias, F weight, F gain, const Mask& kept) {
    const F zero = all(0.0F);
    const F slow = least(rate + bias, zero);
    const Mask over = bias < zero;
    const Mask mends = over & ((gain > zero) | (slow < zero));
    const Mask holds = mends | (gain > zero) | kept;
    return {holds ? weight : zero, mends ? rate + bias : zero};
}

// Speeds above which what is carried from the substep before must not push along with the motion: it would no longer
// hold a load but speed up what leaves.
constexpr float kSlipSpeed = 0.05F;   // m/s
constexpr float kSlipTurn = 0.2F;     // rad/s, friction
constexpr float kLimitLeaves = 0.5F;  // rad/s

// 1 for what moves by less than `slip`, 0 from twice that on.
LUTKA_LANES F stays(F speed, float slip) {
    return clampLanes(all(2.0F) - speed * all(1.0F / slip), all(0.0F), all(1.0F));
}

// What a one-sided row carries into the substep; later passes correct it as they find it.
LUTKA_LANES F carriedPush(F impulse, F rate, float slip, const Pass& pass) {
    return pass.begun ? impulse : impulse * stays(rate, slip);
}

// What a one-sided row decides in a pass: where it holds, and the impulse that is added to what the velocities have.
struct OneSided {
    Mask holds;
    F gain, change;
};
LUTKA_LANES OneSided decideOneSided(F impulse, F rate, F bias, F weight, F gain, const Pass& pass) {
    const F zero = all(0.0F);
    // The row was solved with the weight of the pass before, and whether it still presses is judged with that one. Its
    // weight may have grown since (updateStatic). With the new one, which can be many times the mass behind the row, a
    // contact that parts slowly would look as if it had to pull.
    const F solved = gain > zero ? gain : weight;
    const Mask reached = impulse - solved * (rate + oneSidedBias(bias, noLanes(), pass)) > zero;
    const Mask holds = reached | (pass.late & (gain > zero));
    const F wanted = impulse - weight * (rate + oneSidedBias(bias, holds, pass));
    return {holds, holds ? weight : zero, (holds ? wanted : zero) - impulse * pass.applied};
}

LUTKA_LANES void askLimit(LimitRow& row, const V3& relative, const Pass& pass, JointTerms& terms) {
    const V3 axis = load(row.axis);
    const F weight = load(row.weight);
    const F bias = load(row.bias);
    const F rate = dot(axis, relative);
    const F impulse = carriedPush(load(row.impulse), rate, kLimitLeaves, pass);
    if (pass.mending) {
        const Mended mended = mendRow(rate, bias, weight, load(row.gain), noLanes());
        terms.torque = terms.torque - axis * (mended.gain * mended.off);
        addSquare(terms.weight, axis, mended.gain);
        return;
    }
    const OneSided decided = decideOneSided(impulse, rate, bias, weight, load(row.gain), pass);
    store(row.gain, decided.gain);
    store(row.impulse, impulse);
    terms.torque = terms.torque + axis * decided.change;
    addSquare(terms.weight, axis, decided.gain);
}
LUTKA_LANES Mask updateLimit(LimitRow& row, const V3& relative, const SubstepParams& params, const Pass& pass) {
    const F zero = all(0.0F);
    const F gain = load(row.gain);
    const Mask held = gain > zero;
    const F off = dot(load(row.axis), relative) + oneSidedBias(load(row.bias), held, pass);
    const F total = load(row.impulse) - gain * off;
    store(row.impulse, held ? total : zero);
    const F tolerance = all(-params.limitTolerance);
    // A pull that should not be, of more than the tolerance, or a stop run through.
    const Mask pulls = (total * all(params.limitStiffness) < tolerance * gain) & ~pass.late;
    // A row that holds and still turns has not got the load's whole impulse yet.
    const Mask yields = held & (magnitude(off) > -tolerance) & ~pass.late;
    return (held & pulls) | (~held & (off < tolerance)) | yields;
}

// Limits that mending would run through hold in its next pass. Returns the lanes that have any.
LUTKA_LANES Mask holdPassed(JointLanes& joint, const V3& relative, const SubstepParams& params) {
    const F zero = all(0.0F);
    Mask wrong = noLanes();
    for (int i = 0; i < kLimitRows; ++i) {
        if (joint.limitActive[i] == 0) continue;
        LimitRow& row = joint.limit[i];
        const F gain = load(row.gain);
        const F left = dot(load(row.axis), relative) + most(load(row.bias), zero);
        const Mask passed = left < all(-params.limitTolerance);
        if (bits(passed) == 0) continue;
        // One that holds and gives way has more behind it than its two bodies: it becomes stiffer.
        const F weight = load(row.weight);
        const Mask held = gain > zero;
        store(row.weight, (passed & held) ? weight * all(params.stiffen) : weight);
        store(row.gain, (passed & ~held) ? weight : gain);
        wrong |= passed;
    }
    return wrong;
}

// What is left of an impulse within a bound: 1 inside it.
struct Bounded {
    Mask holds;
    F share;
};
LUTKA_LANES Bounded within(F squared, F limit) {
    const F one = all(1.0F);
    const Mask holds = squared <= limit * limit;
    if (bits(~holds) == 0) return {holds, one};  // what lies still: without the root and the division
    return {holds, holds ? one : limit / most(squareRoot(squared), all(1e-20F))};
}

// What friction may carry over into this pass. Something that slides or turns already is not held: the part of the
// impulse that would drive it on is dropped, or a hit that comes back the other way is sped up by its own friction.
LUTKA_LANES V3 opposing(const V3& carried, const V3& sliding, float slip) {
    const F zero = all(0.0F);
    const F speed2 = dot(sliding, sliding);
    const F driving = dot(carried, sliding);
    const Mask slips = (driving > zero) & (speed2 > all(slip * slip));
    if (bits(slips) == 0) return carried;
    const F share = all(1.0F) - stays(squareRoot(speed2), slip);
    const F dropped = driving * share / most(speed2, all(1e-12F));
    return carried - sliding * (slips ? dropped : zero);
}

// Dry friction against any motion (m/s or rad/s): holds while the impulse that stops it is within `bound`, else it is
// the bound against the motion. Keeps both in the record; returns what is added to what the velocities have.
struct Friction {
    V3 change;
    F gain;
};
LUTKA_LANES Friction decideFriction(Wide3& impulse, Wide& gain, const V3& motion, F weight, F bound, float slip,
                                    const Pass& pass) {
    const V3 before = load(impulse);
    const V3 kept = opposing(before, motion, slip);
    const V3 wanted = kept - motion * weight;
    const Bounded bounded = within(dot(wanted, wanted), bound);
    const V3 target = wanted * bounded.share;
    const F held = bounded.holds ? weight : all(0.0F);
    store(gain, held);
    store(impulse, choose(bounded.holds, kept, target));
    return {target - before * pass.applied, held};
}

LUTKA_LANES void askConeFriction(JointLanes& joint, const V3& relative, F limit, const Pass& pass, JointTerms& terms) {
    const Friction decided = decideFriction(joint.frictionImpulse, joint.frictionGain, relative,
                                            load(joint.frictionWeight), limit, kSlipTurn, pass);
    terms.torque = terms.torque + decided.change;
    terms.weight.xx += decided.gain;
    terms.weight.yy += decided.gain;
    terms.weight.zz += decided.gain;
}
LUTKA_LANES void askHingeFriction(JointLanes& joint, const V3& relative, F limit, const Pass& pass, JointTerms& terms) {
    const V3 axis = load(joint.hinge.axis);
    const F weight = load(joint.frictionWeight);
    const F before = load(joint.frictionImpulse.x);
    const F rate = dot(axis, relative);
    const F kept = (before * rate > magnitude(before) * all(kSlipTurn)) ? all(0.0F) : before;
    const F wanted = kept - weight * rate;
    const F target = clampLanes(wanted, -limit, limit);
    const Mask holds = wanted == target;
    const F gain = holds ? weight : all(0.0F);
    store(joint.frictionGain, gain);
    store(joint.frictionImpulse.x, holds ? kept : target);
    terms.torque = terms.torque + axis * (target - before * pass.applied);
    addSquare(terms.weight, axis, gain);
}

LUTKA_LANES V3 hingeOff(const HingeRows& rows, const V3& relative, const Pass& pass) {
    const V3 turning = across(relative, load(rows.axis));
    return pass.mending ? turning + load(rows.bias) : turning;
}
LUTKA_LANES void askHinge(const HingeRows& rows, const V3& relative, const Pass& pass, JointTerms& terms) {
    const F weight = load(rows.weight);
    const V3 axis = load(rows.axis);
    terms.torque =
        terms.torque + load(rows.impulse) * (all(1.0F) - pass.applied) - hingeOff(rows, relative, pass) * weight;
    terms.weight.xx += weight;
    terms.weight.yy += weight;
    terms.weight.zz += weight;
    addSquare(terms.weight, axis, -weight);
}

// Decides which angular rows of a joint hold, and what they ask for.
LUTKA_LANES JointTerms askJoint(JointLanes& joint, const JointConstants& constants, const V3& relative,
                                const Pass& pass) {
    const F zero = all(0.0F);
    JointTerms terms{{zero, zero, zero}, {zero, zero, zero, zero, zero, zero}};
    const bool rubs = constants.frictionNm > 0.0F && !pass.mending;
    const F frictionLimit = load(joint.frictionLimit) * pass.stiction;
    if (constants.isHinge != 0 || constants.isLocked != 0) {
        askHinge(joint.hinge, relative, pass, terms);
        if (rubs) askHingeFriction(joint, relative, frictionLimit, pass, terms);
    } else {
        if (joint.limitActive[1] != 0) askLimit(joint.limit[1], relative, pass, terms);
        if (joint.limitActive[2] != 0) askLimit(joint.limit[2], relative, pass, terms);
        if (rubs) askConeFriction(joint, relative, frictionLimit, pass, terms);
    }
    if (joint.limitActive[0] != 0) askLimit(joint.limit[0], relative, pass, terms);
    return terms;
}

// After the sweep: what the rows that held have gained. Returns the lanes whose guess was wrong.
LUTKA_LANES Mask updateJoint(JointLanes& joint, const JointConstants& constants, const V3& relative,
                             const SubstepParams& params, const Pass& pass) {
    Mask wrong = noLanes();
    const bool rubs = constants.frictionNm > 0.0F;
    if (constants.isHinge != 0 || constants.isLocked != 0) {
        HingeRows& rows = joint.hinge;
        store(rows.impulse, load(rows.impulse) - hingeOff(rows, relative, pass) * load(rows.weight));
        if (rubs) {
            const F slip = dot(load(rows.axis), relative);
            store(joint.frictionImpulse.x, load(joint.frictionImpulse.x) - load(joint.frictionGain) * slip);
        }
    } else {
        if (joint.limitActive[1] != 0) wrong |= updateLimit(joint.limit[1], relative, params, pass);
        if (joint.limitActive[2] != 0) wrong |= updateLimit(joint.limit[2], relative, params, pass);
        if (rubs) store(joint.frictionImpulse, load(joint.frictionImpulse) - relative * load(joint.frictionGain));
    }
    if (joint.limitActive[0] != 0) wrong |= updateLimit(joint.limit[0], relative, params, pass);
    return wrong;
}

// A body's inertia with all that holds it, and what pushes it.
struct Loaded {
    Spatial inertia;
    V3 impulse, torque;
};

// A spring whose impulse is bounded, of a pull or a motor: what it is to give in this pass. Its direction stays for the
// substep, since what the bound itself has moved says nothing about it.
LUTKA_LANES V3 springTarget(const V3& before, const V3& wanted, F bound, F gain, const Pass& pass) {
    const F zero = all(0.0F);
    const V3 along = pass.begun ? before : wanted;
    const V3 bounded = along * within(dot(along, along), bound).share;
    return choose(gain > zero, wanted, bounded);
}
// The same after the sweep: what it gives, the gain for the next pass and the next substep, and the lanes in which it
// was guessed wrong whether the impulse is within its bound. A bound that throws a light limb past its target is one.
struct SpringCheck {
    V3 impulse;
    F gain;
    Mask wrong;
};
LUTKA_LANES SpringCheck checkSpring(const V3& before, const V3& wanted, F bound, F weight, F gain, const Pass& pass) {
    const F zero = all(0.0F);
    const Mask held = gain > zero;
    const V3 impulse = choose(held, wanted, before);
    const F size = squareRoot(dot(impulse, impulse));
    const Mask tooStrong = held & (size > bound * all(1.05F));
    const Mask tooWeak = ~held & (dot(wanted, impulse) < size * bound * all(0.95F)) & (weight > zero) & ~pass.late;
    return {impulse, tooStrong ? zero : (tooWeak ? weight : gain), tooStrong | tooWeak};
}

// How a body moves at a static contact.
struct StaticMotion {
    V3 normal, arm;
    V3 angular;  // rad/s
    V3 sliding;  // m/s, of the contact's point
    F rate;      // m/s, out of the solid
};
LUTKA_LANES StaticMotion motionAt(const StaticContactLanes& contact, const BodyLanes& body) {
    const V3 normal = load(contact.normal);
    const V3 arm = load(contact.arm);
    const V3 angular = load(body.steadyAngular);
    const V3 sliding = load(body.steadyVelocity) + cross(angular, arm);
    return {normal, arm, angular, sliding, dot(normal, sliding)};
}

LUTKA_LANES void mendStatic(const StaticContactLanes& contact, const StaticMotion& motion, const SubstepParams& params,
                            const Pass& pass, Loaded& loaded) {
    const F zero = all(0.0F);
    const F bias = load(contact.bias);
    // What is near and does not press keeps its speed too, or the mending of a limit pushes it in.
    const Mask touches = motion.rate + most(bias, zero) < all(kMendReach);
    const F firm = load(contact.normalMass) * all(params.contactStiffness) * pass.firmness;
    const Mended mended = mendRow(motion.rate, bias, firm, load(contact.normalGain), touches);
    if (bits(mended.gain > zero) == 0) return;
    const V3 push = motion.normal * (-mended.gain * mended.off);
    loaded.impulse = loaded.impulse + push;
    loaded.torque = loaded.torque + cross(motion.arm, push);
    Symmetric k{zero, zero, zero, zero, zero, zero};
    addSquare(k, motion.normal, mended.gain);
    addPoint(loaded.inertia, motion.arm, k);
}

// As holdPassed(): static contacts that mending would run through hold in its next pass.
LUTKA_LANES Mask holdMet(const BodyLanes& body, StaticContactLanes& contact, const SubstepParams& params) {
    const V3 moving = load(body.velocity) + cross(load(body.angular), load(contact.arm));
    const F left = dot(load(contact.normal), moving) + most(load(contact.bias), all(0.0F));
    const F gain = load(contact.normalGain);
    const Mask met = (left < all(-params.contactTolerance)) & ~(gain > all(0.0F));
    if (bits(met) != 0) store(contact.normalGain, met ? load(contact.normalWeight) : gain);
    return met;
}

// What a contact presses with as its friction sees it, where it presses with `impulse`, and the most that friction may
// be.
LUTKA_LANES F pressingOf(F impulse, const Pass& pass) {
    return most(impulse, all(0.0F)) * pass.stiction;
}
LUTKA_LANES F frictionBound(const StaticContactLanes& contact, F pressing) {
    return load(contact.friction) * pressing;
}

// Decides which rows of a contact hold, and adds them. A contact that presses in no lane, and did not in the pass
// before, is left out.
LUTKA_LANES void askStatic(const BodyLanes& body, StaticContactLanes& contact, const SubstepParams& params,
                           const Pass& pass, Loaded& loaded) {
    const F zero = all(0.0F);
    const StaticMotion motion = motionAt(contact, body);
    if (pass.mending) {
        mendStatic(contact, motion, params, pass, loaded);
        return;
    }
    const F impulse = load(contact.normalImpulse);
    // A point that comes slowly (contactTolerance) to a surface ahead, and did not press before, may meet it or not. To
    // guess that it does would pull the whole doll down to the surface. So the first pass takes it for one that misses;
    // if it meets the surface after all, the next pass or substep holds it.
    const F bias = load(contact.bias);
    const Mask mayMiss = pass.alone & (bias > zero) & (impulse <= zero) & (motion.rate > all(-params.contactTolerance));
    const F rate = pass.begun ? motion.rate : (mayMiss ? zero : motion.rate);
    const OneSided presses =
        decideOneSided(impulse, rate, bias, load(contact.normalWeight), load(contact.normalGain), pass);
    const int engaged = bits(presses.holds | (impulse != zero)) != 0 ? 1 : 0;
    if (engaged == 0 && contact.engaged == 0) return;
    contact.engaged = engaged;
    store(contact.normalGain, presses.gain);
    store(contact.normalImpulse, impulse);

    const F pressing = pressingOf(impulse, pass);
    const Friction grips =
        decideFriction(contact.frictionImpulse, contact.tangentGain, motion.sliding - motion.normal * motion.rate,
                       load(contact.tangentWeight), frictionBound(contact, pressing), kSlipSpeed, pass);
    // Rolling resistance: a torque against any turning, of at most the normal force times a lever.
    const Friction rolls =
        decideFriction(contact.rollImpulse, contact.rollGain, motion.angular, load(contact.rollWeight),
                       pressing * all(params.rollingLever), kSlipTurn, pass);

    const V3 push = motion.normal * presses.change + grips.change;
    loaded.impulse = loaded.impulse + push;
    loaded.torque = loaded.torque + (cross(motion.arm, push) + rolls.change);
    Symmetric k{grips.gain, grips.gain, grips.gain, zero, zero, zero};
    addSquare(k, motion.normal, presses.gain - grips.gain);
    addPoint(loaded.inertia, motion.arm, k);
    loaded.inertia.turning.xx += rolls.gain;
    loaded.inertia.turning.yy += rolls.gain;
    loaded.inertia.turning.zz += rolls.gain;
}

LUTKA_LANES Mask updateStatic(const BodyLanes& body, StaticContactLanes& contact, const SubstepParams& params,
                              const Pass& pass) {
    const F zero = all(0.0F);
    const StaticMotion motion = motionAt(contact, body);
    const F gain = load(contact.normalGain);  // 0 in all lanes of a contact that is not engaged
    const Mask held = gain > zero;
    const F off = motion.rate + oneSidedBias(load(contact.bias), held, pass);
    if (contact.engaged == 0) return off < all(-params.contactTolerance);
    const F total = load(contact.normalImpulse) - gain * off;
    store(contact.normalImpulse, held ? total : zero);
    const V3 friction =
        load(contact.frictionImpulse) - (motion.sliding - motion.normal * motion.rate) * load(contact.tangentGain);
    store(contact.frictionImpulse, friction);
    store(contact.rollImpulse, load(contact.rollImpulse) - motion.angular * load(contact.rollGain));
    const F tolerance = all(-params.contactTolerance);
    // A whole doll may stand on what a body's own mass was to hold: a row that gives way becomes stiffer.
    const F weight = load(contact.normalWeight);
    const F stiffest = load(contact.normalMass) * all(params.stiffest);
    const Mask yields = held & (magnitude(off) > -tolerance) & ~pass.late;
    store(contact.normalWeight, yields ? least(weight * all(params.stiffen), stiffest) : weight);
    // A pull that should not be, of more than the tolerance, or a surface run through.
    const Mask pulls = (total * all(params.contactStiffness) < tolerance * gain) & ~pass.late;
    // Friction of a blow that is over, with which what rolls or rests by now would be driven on: of more than what
    // presses now allows, by more than the tolerance.
    const F allowed = frictionBound(contact, pressingOf(held ? total : zero, pass)) +
                      load(contact.tangentWeight) * all(params.contactTolerance);
    const Mask drives = (dot(friction, friction) > allowed * allowed) & ~pass.late;
    return (held & pulls) | (~held & (off < tolerance)) | (yields & (weight < stiffest)) | drives;
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
