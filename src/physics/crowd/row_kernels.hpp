#pragma once

/// The rows that take part in the tree solver: which of them hold, and what they push. See tree_kernels.hpp.

#include "physics/crowd/static_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_CROWD_KERNELS {

// Which pass this is. `applied` is 1 where the rows' impulses are already in the velocities, 0 in the first pass.
// `changed` gathers the lanes in which another set of rows holds than before.
struct Pass {
    int useBias;
    F applied;
    Mask changed;
};

LUTKA_LANES F holding(const Mask& holds, F weight, Wide& gain, Pass& pass) {
    const F now = holds ? weight : all(0.0F);
    pass.changed |= now != load(gain);
    store(gain, now);
    return now;
}

LUTKA_LANES F limitBias(const LimitRow& row, const SubstepParams& params, int useBias) {
    const F room = load(row.room);
    const F zero = all(0.0F);
    const F mend = useBias != 0 ? most(room * all(params.limitRate), all(-params.limitSpeed)) : zero;
    return room > zero ? room * all(params.inverseDt) : mend;  // may turn as far as the limit
}

LUTKA_LANES V3 limitTorque(LimitRow& row, const V3& relative, const SubstepParams& params, Pass& pass) {
    const V3 axis = load(row.axis);
    const F weight = load(row.weight);
    const F impulse = load(row.impulse);
    const F zero = all(0.0F);
    const F wanted = impulse - weight * (dot(axis, relative) + limitBias(row, params, pass.useBias));
    holding(wanted > zero, weight, row.gain, pass);
    return axis * (most(wanted, zero) - impulse * pass.applied);
}
LUTKA_LANES Mask updateLimit(LimitRow& row, const V3& relative, const SubstepParams& params, int useBias) {
    const F zero = all(0.0F);
    const F gain = load(row.gain);
    const F off = dot(load(row.axis), relative) + limitBias(row, params, useBias);
    const F total = load(row.impulse) - gain * off;
    const Mask held = gain > zero;
    store(row.impulse, held ? total : zero);
    // In rad/s: a pull that should not be, or a stop run through.
    const F wrong = held ? total * all(params.limitStiffness) / most(gain, all(1e-12F)) : off;
    return wrong < all(-params.limitTolerance);
}

// Friction of a cone-twist: holds while the torque that stops all turning is within the bound, else it is the bound
// against the turning.
LUTKA_LANES V3 coneFriction(JointLanes& joint, const V3& relative, F limit, Pass& pass) {
    const F weight = load(joint.frictionWeight);
    const V3 before = load(joint.frictionImpulse);
    const V3 wanted = before - relative * weight;
    const F size = squareRoot(dot(wanted, wanted));
    const Mask holds = size <= limit;
    const V3 target = wanted * (holds ? all(1.0F) : limit / most(size, all(1e-20F)));
    holding(holds, weight, joint.frictionGain, pass);
    store(joint.frictionImpulse,
          V3{holds ? before.x : target.x, holds ? before.y : target.y, holds ? before.z : target.z});
    return target - before * pass.applied;
}
LUTKA_LANES V3 hingeFriction(JointLanes& joint, const V3& relative, F limit, Pass& pass) {
    const V3 axis = load(joint.hingeAxis);
    const F weight = load(joint.frictionWeight);
    const F before = load(joint.frictionImpulse.x);
    const F wanted = before - weight * dot(axis, relative);
    const F target = clampLanes(wanted, -limit, limit);
    const Mask holds = wanted == target;
    holding(holds, weight, joint.frictionGain, pass);
    store(joint.frictionImpulse.x, holds ? before : target);
    return axis * (target - before * pass.applied);
}

// Decides which angular rows of a joint hold and gathers their torque on the child.
LUTKA_LANES void decideJoint(JointLanes& joint, const JointConstants& constants, const V3& relative,
                             const SubstepParams& params, Pass& pass) {
    const F zero = all(0.0F);
    V3 torque{zero, zero, zero};
    const F frictionLimit = all(constants.frictionNm * params.dt);
    if (constants.isHinge != 0) {
        const F weight = load(joint.acrossWeight);
        const F rate = all(pass.useBias != 0 ? params.jointRate : 0.0F);
        for (int i = 0; i < 2; ++i) {
            const V3 axis = load(joint.across[i]);
            const F carried = load(joint.hingeImpulse[i]) * (all(1.0F) - pass.applied);
            const F off = dot(axis, relative) + rate * load(joint.acrossError[i]);
            torque = torque + axis * (carried - weight * off);
        }
        if (constants.frictionNm > 0.0F) torque = torque + hingeFriction(joint, relative, frictionLimit, pass);
    } else {
        if (joint.limitActive[1] != 0) torque = torque + limitTorque(joint.limit[1], relative, params, pass);
        if (constants.frictionNm > 0.0F) torque = torque + coneFriction(joint, relative, frictionLimit, pass);
    }
    if (joint.limitActive[0] != 0) torque = torque + limitTorque(joint.limit[0], relative, params, pass);
    store(joint.rowTorque, torque);
}

// The weight matrix of the angular rows that hold.
LUTKA_LANES Symmetric angularWeight(const JointLanes& joint, const JointConstants& constants) {
    const F zero = all(0.0F);
    Symmetric weight{zero, zero, zero, zero, zero, zero};
    const bool rubs = constants.frictionNm > 0.0F;
    const F friction = rubs ? load(joint.frictionGain) : zero;
    if (constants.isHinge != 0) {
        addSquare(weight, load(joint.across[0]), load(joint.acrossWeight));
        addSquare(weight, load(joint.across[1]), load(joint.acrossWeight));
        if (rubs) addSquare(weight, load(joint.hingeAxis), friction);
    } else {
        weight.xx = weight.yy = weight.zz = friction;
        if (joint.limitActive[1] != 0) addSquare(weight, load(joint.limit[1].axis), load(joint.limit[1].gain));
    }
    if (joint.limitActive[0] != 0) addSquare(weight, load(joint.limit[0].axis), load(joint.limit[0].gain));
    return weight;
}

// After the sweep: what the rows that held have gained. Returns the lanes whose guess was wrong.
LUTKA_LANES Mask updateRows(JointLanes& joint, const JointConstants& constants, const V3& relative,
                            const SubstepParams& params, int useBias) {
    Mask wrong = noLanes();
    const F friction = load(joint.frictionGain);
    if (constants.isHinge != 0) {
        const F weight = load(joint.acrossWeight);
        const F rate = all(useBias != 0 ? params.jointRate : 0.0F);
        for (int i = 0; i < 2; ++i) {
            const F off = dot(load(joint.across[i]), relative) + rate * load(joint.acrossError[i]);
            store(joint.hingeImpulse[i], load(joint.hingeImpulse[i]) - weight * off);
        }
        if (constants.frictionNm > 0.0F) {
            const F slip = dot(load(joint.hingeAxis), relative);
            store(joint.frictionImpulse.x, load(joint.frictionImpulse.x) - friction * slip);
        }
    } else {
        if (joint.limitActive[1] != 0) wrong |= updateLimit(joint.limit[1], relative, params, useBias);
        if (constants.frictionNm > 0.0F)
            store(joint.frictionImpulse, load(joint.frictionImpulse) - relative * friction);
    }
    if (joint.limitActive[0] != 0) wrong |= updateLimit(joint.limit[0], relative, params, useBias);
    return wrong;
}

LUTKA_LANES F staticBias(const StaticContactLanes& contact, const SubstepParams& params, int useBias) {
    return contactBias(load(contact.separation), params, useBias);
}

LUTKA_LANES void decideSliding(StaticContactLanes& contact, const V3& sliding, F limit, Pass& pass) {
    const F weight = load(contact.tangentWeight);
    const F before1 = load(contact.tangentImpulse[0]);
    const F before2 = load(contact.tangentImpulse[1]);
    const F wanted1 = before1 - weight * dot(load(contact.tangent[0]), sliding);
    const F wanted2 = before2 - weight * dot(load(contact.tangent[1]), sliding);
    const F size = squareRoot(wanted1 * wanted1 + wanted2 * wanted2);
    const Mask holds = size <= limit;
    const F cut = holds ? all(1.0F) : limit / most(size, all(1e-20F));
    holding(holds, weight, contact.tangentGain, pass);
    store(contact.tangentPush[0], wanted1 * cut - before1 * pass.applied);
    store(contact.tangentPush[1], wanted2 * cut - before2 * pass.applied);
    store(contact.tangentImpulse[0], holds ? before1 : wanted1 * cut);
    store(contact.tangentImpulse[1], holds ? before2 : wanted2 * cut);
}

// Rolling resistance: a torque against any turning, of at most the normal force times a lever.
LUTKA_LANES void decideRolling(StaticContactLanes& contact, const V3& angular, F limit, Pass& pass) {
    const F weight = load(contact.rollWeight);
    const V3 before = load(contact.rollImpulse);
    const V3 wanted = before - angular * weight;
    const F size = squareRoot(dot(wanted, wanted));
    const Mask holds = size <= limit;
    const V3 target = wanted * (holds ? all(1.0F) : limit / most(size, all(1e-20F)));
    holding(holds, weight, contact.rollGain, pass);
    store(contact.rollPush, target - before * pass.applied);
    store(contact.rollImpulse,
          V3{holds ? before.x : target.x, holds ? before.y : target.y, holds ? before.z : target.z});
}

// Decides which rows of a contact hold. A contact that presses in no lane, and did not in the pass before, is left out.
LUTKA_LANES void decideStatic(const BatchView& batch, StaticContactLanes& contact, const SubstepParams& params,
                              Pass& pass) {
    const BodyLanes& body = batch.bodies[contact.body];
    const F zero = all(0.0F);
    const V3 angular = load(body.angular);
    const V3 sliding = load(body.velocity) + cross(angular, load(contact.arm));
    const F weight = load(contact.normalWeight);
    const F impulse = load(contact.normalImpulse);
    const F off = dot(load(contact.normal), sliding) + staticBias(contact, params, pass.useBias);
    const F wanted = impulse - weight * off;
    const Mask holds = wanted > zero;
    const int engaged = bits(holds | (impulse != zero)) != 0 ? 1 : 0;
    if (engaged == 0 && contact.engaged == 0) return;
    contact.engaged = engaged;
    holding(holds, weight, contact.normalGain, pass);
    store(contact.normalPush, most(wanted, zero) - impulse * pass.applied);
    const F pressing = most(impulse, zero);
    decideSliding(contact, sliding, load(contact.friction) * pressing, pass);
    decideRolling(contact, angular, pressing * all(params.rollingLever), pass);
}

LUTKA_LANES void addStaticWeight(const BatchView& batch, const StaticContactLanes& contact) {
    TreeLanes& tree = batch.tree[contact.body];
    Spatial s = loadSpatial(tree);
    const V3 arm = load(contact.arm);
    const F grip = load(contact.tangentGain);
    const F roll = load(contact.rollGain);
    addDirection(s, arm, load(contact.normal), load(contact.normalGain));
    addDirection(s, arm, load(contact.tangent[0]), grip);
    addDirection(s, arm, load(contact.tangent[1]), grip);
    s.turning.xx += roll;
    s.turning.yy += roll;
    s.turning.zz += roll;
    storeSpatial(tree, s);
}

LUTKA_LANES void addStaticPush(const BatchView& batch, const StaticContactLanes& contact) {
    TreeLanes& tree = batch.tree[contact.body];
    const V3 push = load(contact.normal) * load(contact.normalPush) +
                    load(contact.tangent[0]) * load(contact.tangentPush[0]) +
                    load(contact.tangent[1]) * load(contact.tangentPush[1]);
    store(tree.impulse, load(tree.impulse) + push);
    store(tree.torque, load(tree.torque) + (cross(load(contact.arm), push) + load(contact.rollPush)));
}

LUTKA_LANES Mask updateStatic(const BatchView& batch, StaticContactLanes& contact, const SubstepParams& params,
                              int useBias) {
    const BodyLanes& body = batch.bodies[contact.body];
    const V3 angular = load(body.angular);
    const V3 sliding = load(body.velocity) + cross(angular, load(contact.arm));
    const F gain = load(contact.normalGain);  // 0 in all lanes of a contact that is not engaged
    const F off = dot(load(contact.normal), sliding) + staticBias(contact, params, useBias);
    if (contact.engaged == 0) return off < all(-params.contactTolerance);
    const F total = load(contact.normalImpulse) - gain * off;
    const F zero = all(0.0F);
    const Mask held = gain > zero;
    store(contact.normalImpulse, held ? total : zero);
    // In m/s: a pull that should not be, or a surface run through.
    const F wrong = held ? total * all(params.contactStiffness) / most(gain, all(1e-12F)) : off;
    const F grip = load(contact.tangentGain);
    for (int i = 0; i < 2; ++i) {
        const F slip = dot(load(contact.tangent[i]), sliding);
        store(contact.tangentImpulse[i], load(contact.tangentImpulse[i]) - grip * slip);
    }
    const F roll = load(contact.rollGain);
    store(contact.rollImpulse, load(contact.rollImpulse) - angular * roll);
    return wrong < all(-params.contactTolerance);
}

}  // namespace lutka::physics::crowd::LUTKA_CROWD_KERNELS
