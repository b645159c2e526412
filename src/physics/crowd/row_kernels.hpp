#pragma once

/// The rows that take part in the tree solver: which of them hold, and what they push. See tree_kernels.hpp.

#include "physics/crowd/static_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_CROWD_KERNELS {

// Which pass this is.
struct Pass {
    bool mending;  ///< Mends errors of position on top of the steady velocities; friction rests and nothing is kept.
    F applied;     ///< 1 where the rows' impulses are already in the velocities, 0 in the substep's first pass.
    /// Lanes whose guesses will not come to rest: rows are only added any more, and those that hold just stop what
    /// comes.
    Mask late;
    F stiction;   ///< Factor on all friction.
    Mask astray;  ///< Gathers the lanes in which a body turns at another rate than its arms were foreseen with.
};

// What rows of a joint ask for: a torque on the child, and a weight matrix of the relative turning.
struct Asked {
    V3 torque;
    Symmetric weight;
};

// The speed that a one-sided row asks to be added. A row ahead of its stop (positive bias) may close in; in late lanes
// a row that holds stops at once instead, which takes energy away whatever the guess was.
LUTKA_LANES F oneSidedBias(F bias, const Mask& held, const Pass& pass) {
    const F zero = all(0.0F);
    const F ahead = most(bias, zero);
    return (held & pass.late) ? zero : ahead;
}

// What a mending pass asks of a one-sided row: one that holds keeps its speed or mends its overrun; one that was run
// over and leaves too slowly joins it. Returns the row's gain and the speed that is to be taken off.
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
    const F kept = impulse * stays(rate, slip);
    return pass.applied > all(0.0F) ? impulse : kept;
}

LUTKA_LANES void askLimit(LimitRow& row, const V3& relative, const Pass& pass, Asked& asked) {
    const F zero = all(0.0F);
    const V3 axis = load(row.axis);
    const F weight = load(row.weight);
    const F bias = load(row.bias);
    const F rate = dot(axis, relative);
    const F impulse = carriedPush(load(row.impulse), rate, kLimitLeaves, pass);
    if (pass.mending) {
        const Mended mended = mendRow(rate, bias, weight, load(row.gain), noLanes());
        asked.torque = asked.torque - axis * (mended.gain * mended.off);
        addSquare(asked.weight, axis, mended.gain);
        return;
    }
    const Mask none = noLanes();
    const Mask reached = impulse - weight * (rate + oneSidedBias(bias, none, pass)) > zero;
    const Mask holds = reached | (pass.late & (load(row.gain) > zero));
    const F wanted = impulse - weight * (rate + oneSidedBias(bias, holds, pass));
    const F gain = holds ? weight : zero;
    store(row.gain, gain);
    store(row.impulse, impulse);
    asked.torque = asked.torque + axis * ((holds ? wanted : zero) - impulse * pass.applied);
    addSquare(asked.weight, axis, gain);
}
LUTKA_LANES Mask updateLimit(LimitRow& row, const V3& relative, const SubstepParams& params, const Pass& pass) {
    const F zero = all(0.0F);
    const F gain = load(row.gain);
    const Mask held = gain > zero;
    const F off = dot(load(row.axis), relative) + oneSidedBias(load(row.bias), held, pass);
    const F total = load(row.impulse) - gain * off;
    store(row.impulse, held ? total : zero);
    // In rad/s: a pull that should not be, or a stop run through.
    const F pull = pass.late ? zero : total * all(params.limitStiffness) / most(gain, all(1e-12F));
    const F tolerance = all(-params.limitTolerance);
    // A row that holds and still turns has not got the load's whole impulse yet.
    const Mask yields = held & (magnitude(off) > -tolerance) & ~pass.late;
    return ((held ? pull : off) < tolerance) | yields;
}

// What is left of an impulse within a bound: 1 inside it.
struct Bounded {
    Mask holds;
    F share;
};
LUTKA_LANES Bounded within(F squared, F limit) {
    const F size = squareRoot(squared);
    const Mask holds = size <= limit;
    return {holds, holds ? all(1.0F) : limit / most(size, all(1e-20F))};
}
LUTKA_LANES V3 choose(const Mask& mask, const V3& a, const V3& b) {
    return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}

// What friction may carry over into this pass. Something that slides or turns already is not held: the part of the
// impulse that would drive it on is dropped, or a hit that comes back the other way is sped up by its own friction.
LUTKA_LANES V3 opposing(const V3& carried, const V3& sliding, float slip) {
    const F speed2 = dot(sliding, sliding);
    const F driving = most(dot(carried, sliding), all(0.0F));
    const F share = all(1.0F) - stays(squareRoot(speed2), slip);
    return carried - sliding * (driving * share / most(speed2, all(1e-12F)));
}

// Friction of a cone-twist: holds while the torque that stops all turning is within the bound, else it is the bound
// against the turning.
LUTKA_LANES void askConeFriction(JointLanes& joint, const V3& relative, F limit, const Pass& pass, Asked& asked) {
    const F weight = load(joint.frictionWeight);
    const V3 before = load(joint.frictionImpulse);
    const V3 kept = opposing(before, relative, kSlipTurn);
    const V3 wanted = kept - relative * weight;
    const Bounded bound = within(dot(wanted, wanted), limit);
    const V3 target = wanted * bound.share;
    const F gain = bound.holds ? weight : all(0.0F);
    store(joint.frictionGain, gain);
    store(joint.frictionImpulse, choose(bound.holds, kept, target));
    asked.torque = asked.torque + (target - before * pass.applied);
    asked.weight.xx += gain;
    asked.weight.yy += gain;
    asked.weight.zz += gain;
}
LUTKA_LANES void askHingeFriction(JointLanes& joint, const V3& relative, F limit, const Pass& pass, Asked& asked) {
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
    asked.torque = asked.torque + axis * (target - before * pass.applied);
    addSquare(asked.weight, axis, gain);
}

LUTKA_LANES V3 hingeOff(const HingeRows& rows, const V3& relative, const Pass& pass) {
    const V3 turning = across(relative, load(rows.axis));
    return pass.mending ? turning + load(rows.bias) : turning;
}
LUTKA_LANES void askHinge(const HingeRows& rows, const V3& relative, const Pass& pass, Asked& asked) {
    const F weight = load(rows.weight);
    const V3 axis = load(rows.axis);
    asked.torque =
        asked.torque + load(rows.impulse) * (all(1.0F) - pass.applied) - hingeOff(rows, relative, pass) * weight;
    asked.weight.xx += weight;
    asked.weight.yy += weight;
    asked.weight.zz += weight;
    addSquare(asked.weight, axis, -weight);
}

// Decides which angular rows of a joint hold, and what they ask for.
LUTKA_LANES Asked askJoint(JointLanes& joint, const JointConstants& constants, const V3& relative, const Pass& pass) {
    const F zero = all(0.0F);
    Asked asked{{zero, zero, zero}, {zero, zero, zero, zero, zero, zero}};
    const bool rubs = constants.frictionNm > 0.0F && !pass.mending;
    const F frictionLimit = load(joint.frictionLimit) * pass.stiction;
    if (constants.isHinge != 0) {
        askHinge(joint.hinge, relative, pass, asked);
        if (rubs) askHingeFriction(joint, relative, frictionLimit, pass, asked);
    } else {
        if (joint.limitActive[1] != 0) askLimit(joint.limit[1], relative, pass, asked);
        if (joint.limitActive[2] != 0) askLimit(joint.limit[2], relative, pass, asked);
        if (rubs) askConeFriction(joint, relative, frictionLimit, pass, asked);
    }
    if (joint.limitActive[0] != 0) askLimit(joint.limit[0], relative, pass, asked);
    return asked;
}

// After the sweep: what the rows that held have gained. Returns the lanes whose guess was wrong.
LUTKA_LANES Mask updateJoint(JointLanes& joint, const JointConstants& constants, const V3& relative,
                             const SubstepParams& params, const Pass& pass) {
    Mask wrong = noLanes();
    const bool rubs = constants.frictionNm > 0.0F;
    if (constants.isHinge != 0) {
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

constexpr float kMendReach = 3.0F;  // m/s that mending moves a point with at most

// Decides which rows of a contact hold, and adds them. A contact that presses in no lane, and did not in the pass
// before, is left out.
LUTKA_LANES void askStatic(const BodyLanes& body, StaticContactLanes& contact, const SubstepParams& params,
                           const Pass& pass, Loaded& loaded) {
    const F zero = all(0.0F);
    const V3 normal = load(contact.normal);
    const V3 arm = load(contact.arm);
    const V3 angular = load(body.steadyAngular);
    const V3 sliding = load(body.steadyVelocity) + cross(angular, arm);
    const F rate = dot(normal, sliding);
    const F weight = load(contact.normalWeight);
    const F bias = load(contact.bias);
    const F impulse = load(contact.normalImpulse);
    if (pass.mending) {
        // What is near and does not press keeps its speed too, or the mending of a limit pushes it in.
        const Mask touches = rate + most(bias, zero) < all(kMendReach);
        const F firm = load(contact.normalMass) * all(params.contactStiffness);
        const Mended mended = mendRow(rate, bias, firm, load(contact.normalGain), touches);
        if (bits(mended.gain > zero) == 0) return;
        const V3 push = normal * (-mended.gain * mended.off);
        loaded.impulse = loaded.impulse + push;
        loaded.torque = loaded.torque + cross(arm, push);
        Symmetric k{zero, zero, zero, zero, zero, zero};
        addSquare(k, normal, mended.gain);
        addPoint(loaded.inertia, arm, k);
        return;
    }
    const Mask none = noLanes();
    const Mask reached = impulse - weight * (rate + oneSidedBias(bias, none, pass)) > zero;
    const Mask holds = reached | (pass.late & (load(contact.normalGain) > zero));
    const int engaged = bits(holds | (impulse != zero)) != 0 ? 1 : 0;
    if (engaged == 0 && contact.engaged == 0) return;
    contact.engaged = engaged;
    const F wanted = impulse - weight * (rate + oneSidedBias(bias, holds, pass));
    const F gain = holds ? weight : zero;
    store(contact.normalGain, gain);
    store(contact.normalImpulse, impulse);
    V3 push = normal * ((holds ? wanted : zero) - impulse * pass.applied);

    const F pressing = most(impulse, zero) * pass.stiction;
    const F gripWeight = load(contact.tangentWeight);
    const V3 before = load(contact.frictionImpulse);
    const V3 slip = sliding - normal * rate;
    const V3 kept = opposing(before, slip, kSlipSpeed);
    const V3 rubbing = kept - slip * gripWeight;
    const Bounded grips = within(dot(rubbing, rubbing), load(contact.friction) * pressing);
    const V3 rubbed = rubbing * grips.share;
    const F grip = grips.holds ? gripWeight : zero;
    store(contact.tangentGain, grip);
    store(contact.frictionImpulse, choose(grips.holds, kept, rubbed));
    push = push + (rubbed - before * pass.applied);

    // Rolling resistance: a torque against any turning, of at most the normal force times a lever.
    const F rollWeight = load(contact.rollWeight);
    const V3 rolled = load(contact.rollImpulse);
    const V3 keptRoll = opposing(rolled, angular, kSlipTurn);
    const V3 rolling = keptRoll - angular * rollWeight;
    const Bounded stops = within(dot(rolling, rolling), pressing * all(params.rollingLever));
    const V3 resisted = rolling * stops.share;
    const F roll = stops.holds ? rollWeight : zero;
    store(contact.rollGain, roll);
    store(contact.rollImpulse, choose(stops.holds, keptRoll, resisted));

    loaded.impulse = loaded.impulse + push;
    loaded.torque = loaded.torque + (cross(arm, push) + (resisted - rolled * pass.applied));
    Symmetric k{grip, grip, grip, zero, zero, zero};
    addSquare(k, normal, gain - grip);
    addPoint(loaded.inertia, arm, k);
    loaded.inertia.turning.xx += roll;
    loaded.inertia.turning.yy += roll;
    loaded.inertia.turning.zz += roll;
}

LUTKA_LANES Mask updateStatic(const BodyLanes& body, StaticContactLanes& contact, const SubstepParams& params,
                              const Pass& pass) {
    const F zero = all(0.0F);
    const V3 normal = load(contact.normal);
    const V3 angular = load(body.steadyAngular);
    const V3 sliding = load(body.steadyVelocity) + cross(angular, load(contact.arm));
    const F rate = dot(normal, sliding);
    const F gain = load(contact.normalGain);  // 0 in all lanes of a contact that is not engaged
    const Mask held = gain > zero;
    const F off = rate + oneSidedBias(load(contact.bias), held, pass);
    if (contact.engaged == 0) return off < all(-params.contactTolerance);
    const F total = load(contact.normalImpulse) - gain * off;
    store(contact.normalImpulse, held ? total : zero);
    store(contact.frictionImpulse,
          load(contact.frictionImpulse) - (sliding - normal * rate) * load(contact.tangentGain));
    store(contact.rollImpulse, load(contact.rollImpulse) - angular * load(contact.rollGain));
    const F tolerance = all(-params.contactTolerance);
    // A whole doll may stand on what a body's own mass was to hold: a row that gives way becomes stiffer.
    const F weight = load(contact.normalWeight);
    const F stiffest = load(contact.normalMass) * all(params.stiffest);
    const Mask yields = held & (magnitude(off) > -tolerance) & ~pass.late;
    store(contact.normalWeight, yields ? least(weight * all(params.stiffen), stiffest) : weight);
    // In m/s: a pull that should not be, or a surface run through.
    const F pull = pass.late ? zero : total * all(params.contactStiffness) / most(gain, all(1e-12F));
    return ((held ? pull : off) < tolerance) | (yields & (weight < stiffest));
}

}  // namespace lutka::physics::crowd::LUTKA_CROWD_KERNELS
