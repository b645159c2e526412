#pragma once

/// The doll's solver. All joints of a doll form a tree, so that their equations together can be solved exactly in one
/// sweep from the leaves to the root and one back, at a cost linear in the number of bodies. Rows that hold (a limit at
/// its stop, a contact that presses, friction that grips) take part as weights: with J v + bias = 0 to be reached and
/// an accumulated impulse, a row adds weight · J Jᵀ to the inertia and -weight · (J v + bias) to the right-hand side,
/// the method of multipliers. Which rows hold is guessed from the sign of (impulse - weight · (J v + bias)) before each
/// sweep, which makes the passes a Newton method on the contact problem (primal-dual active set; Hintermüller, Ito and
/// Kunisch 2002). Rows that do not hold have their impulse taken back.
///
/// The guess is only good on velocities with which all joints hold: those that the last sweep left (`steady`). What has
/// been done to single bodies since (pushes of pair contacts and drags) comes in as impulses of the right-hand side,
/// and so do, in a substep's first pass, the impulses of the substep before.
///
/// Elimination of a child c with inertia [H C; Cᵀ B] about its anchor, right-hand side (f, t), rows D with right-hand
/// side g on the relative rotation, and anchor velocity to change by r against the parent's (x, y):
///     E = (B + D)⁻¹        turn of the child = E (t + g - Cᵀ r) - E Cᵀ x + E D y
///     what the parent feels:   [H - C E Cᵀ   C E D;  D E Cᵀ   B E D],   (f - H r - C e,  t - Cᵀ r - B e)
/// with e = E (t + g - Cᵀ r).

#include "physics/crowd/static_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_CROWD_KERNELS {

struct Matrix {
    V3 row[3];
};
LUTKA_LANES Matrix load(const WideMatrix& m) {
    return {{load(m.row[0]), load(m.row[1]), load(m.row[2])}};
}
LUTKA_LANES void store(WideMatrix& to, const Matrix& m) {
    for (int i = 0; i < 3; ++i)
        store(to.row[i], m.row[i]);
}
LUTKA_LANES V3 operator*(const Matrix& m, const V3& v) {
    return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
}
LUTKA_LANES V3 transposed(const Matrix& m, const V3& v) {
    return m.row[0] * v.x + m.row[1] * v.y + m.row[2] * v.z;
}
// m times a symmetric matrix: its rows are images under it.
LUTKA_LANES Matrix operator*(const Matrix& m, const Symmetric& s) {
    return {{s * m.row[0], s * m.row[1], s * m.row[2]}};
}
LUTKA_LANES Matrix product(const Symmetric& a, const Symmetric& b) {
    return Matrix{{V3{a.xx, a.xy, a.xz}, V3{a.xy, a.yy, a.yz}, V3{a.xz, a.yz, a.zz}}} * b;
}
// m [v]: the matrix that crosses with v first. Row i times [v] is row i × v.
LUTKA_LANES Matrix timesCross(const Matrix& m, const V3& v) {
    return {{cross(m.row[0], v), cross(m.row[1], v), cross(m.row[2], v)}};
}
LUTKA_LANES Matrix operator+(const Matrix& a, const Matrix& b) {
    return {{a.row[0] + b.row[0], a.row[1] + b.row[1], a.row[2] + b.row[2]}};
}
LUTKA_LANES Matrix operator-(const Matrix& a, const Matrix& b) {
    return {{a.row[0] - b.row[0], a.row[1] - b.row[1], a.row[2] - b.row[2]}};
}
LUTKA_LANES Symmetric operator-(const Symmetric& a, const Symmetric& b) {
    return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.xz - b.xz, a.yz - b.yz};
}
LUTKA_LANES Matrix rowsOf(const Symmetric& s) {
    return {{V3{s.xx, s.xy, s.xz}, V3{s.xy, s.yy, s.yz}, V3{s.xz, s.yz, s.zz}}};
}
// a bᵀ, of which the caller knows that it is symmetric.
LUTKA_LANES Symmetric symmetricProduct(const Matrix& a, const Matrix& b) {
    return {dot(a.row[0], b.row[0]), dot(a.row[1], b.row[1]), dot(a.row[2], b.row[2]),
            dot(a.row[0], b.row[1]), dot(a.row[0], b.row[2]), dot(a.row[1], b.row[2])};
}
// weight · a aᵀ added.
LUTKA_LANES void addSquare(Symmetric& to, const V3& a, F weight) {
    const V3 scaled = a * weight;
    to.xx += scaled.x * a.x;
    to.yy += scaled.y * a.y;
    to.zz += scaled.z * a.z;
    to.xy += scaled.x * a.y;
    to.xz += scaled.x * a.z;
    to.yz += scaled.y * a.z;
}

// A body's inertia about some point, and its right-hand side.
struct Spatial {
    Symmetric linear;
    Matrix mixed;
    Symmetric turning;
    V3 impulse, torque;
};
LUTKA_LANES Spatial loadSpatial(const TreeLanes& tree) {
    return {load(tree.linear), load(tree.mixed), load(tree.turning), load(tree.impulse), load(tree.torque)};
}
LUTKA_LANES void storeSpatial(TreeLanes& tree, const Spatial& s) {
    store(tree.linear, s.linear);
    store(tree.mixed, s.mixed);
    store(tree.turning, s.turning);
    store(tree.impulse, s.impulse);
    store(tree.torque, s.torque);
}
// The turning block under a shift of the point, which needs the mixed block before and after: B - [r] C' + Cᵀ [r] for
// C' = C + H [r]. Both terms by their columns.
LUTKA_LANES Symmetric shiftTurning(const Symmetric& b, const Matrix& before, const Matrix& after, const V3& r) {
    // [r] C' has columns r × (column of C'); Cᵀ [r] has rows (column of C) × r.
    const V3 a0{after.row[0].x, after.row[1].x, after.row[2].x};
    const V3 a1{after.row[0].y, after.row[1].y, after.row[2].y};
    const V3 a2{after.row[0].z, after.row[1].z, after.row[2].z};
    const V3 c0{before.row[0].x, before.row[1].x, before.row[2].x};
    const V3 c1{before.row[0].y, before.row[1].y, before.row[2].y};
    const V3 left0 = cross(r, a0), left1 = cross(r, a1), left2 = cross(r, a2);
    const V3 right0 = cross(c0, r), right1 = cross(c1, r);
    const V3 c2{before.row[0].z, before.row[1].z, before.row[2].z};
    const V3 right2 = cross(c2, r);
    return {b.xx - left0.x + right0.x, b.yy - left1.y + right1.y, b.zz - left2.z + right2.z,
            b.xy - left1.x + right0.y, b.xz - left2.x + right0.z, b.yz - left2.y + right1.z};
}
// From the centre of mass to a point at `r` from it.
LUTKA_LANES Spatial movedTo(const Spatial& s, const V3& r) {
    const Matrix mixed = s.mixed + timesCross(rowsOf(s.linear), r);
    return {s.linear, mixed, shiftTurning(s.turning, s.mixed, mixed, r), s.impulse, s.torque - cross(r, s.impulse)};
}

// Which pass this is. `applied` is 1 where the rows' impulses are already in the velocities, 0 in the first pass.
struct Pass {
    int useBias;
    F applied;
};

// A one-sided or bounded row's part in the angular block of a joint, or of a body that rolls.
struct AngularRows {
    Symmetric weight;
    V3 torque;
};
LUTKA_LANES void addRow(AngularRows& rows, const V3& axis, F gain, F torque) {
    addSquare(rows.weight, axis, gain);
    rows.torque = rows.torque + axis * torque;
}

LUTKA_LANES F limitBias(const LimitRow& row, const SubstepParams& params, int useBias) {
    const F room = load(row.room);
    const F zero = all(0.0F);
    const F mend = useBias != 0 ? most(room * all(params.limit.biasRate), all(-params.limitSpeed)) : zero;
    return room > zero ? room * all(params.inverseDt) : mend;  // may turn as far as the limit
}

LUTKA_LANES void addLimit(AngularRows& rows, LimitRow& row, const V3& relative, const SubstepParams& params,
                          const Pass& pass) {
    const V3 axis = load(row.axis);
    const F weight = load(row.weight);
    const F impulse = load(row.impulse);
    const F wanted = impulse - weight * (dot(axis, relative) + limitBias(row, params, pass.useBias));
    const F zero = all(0.0F);
    const Mask holds = wanted > zero;
    const F gain = holds ? weight : zero;
    store(row.gain, gain);
    addRow(rows, axis, gain, (holds ? wanted : zero) - impulse * pass.applied);
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
LUTKA_LANES void addConeFriction(AngularRows& rows, JointLanes& joint, const V3& relative, F limit, const Pass& pass) {
    const F weight = load(joint.frictionWeight);
    const V3 before = load(joint.frictionImpulse);
    const V3 wanted = before - relative * weight;
    const F size = squareRoot(dot(wanted, wanted));
    const Mask holds = size <= limit;
    const F gain = holds ? weight : all(0.0F);
    const V3 target = wanted * (holds ? all(1.0F) : limit / most(size, all(1e-20F)));
    store(joint.frictionGain, gain);
    rows.weight.xx += gain;
    rows.weight.yy += gain;
    rows.weight.zz += gain;
    rows.torque = rows.torque + (target - before * pass.applied);
    store(joint.frictionImpulse,
          V3{holds ? before.x : target.x, holds ? before.y : target.y, holds ? before.z : target.z});
}
LUTKA_LANES void addHingeFriction(AngularRows& rows, JointLanes& joint, const V3& relative, F limit, const Pass& pass) {
    const V3 axis = load(joint.hingeAxis);
    const F weight = load(joint.frictionWeight);
    const F before = load(joint.frictionImpulse.x);
    const F wanted = before - weight * dot(axis, relative);
    const F target = clampLanes(wanted, -limit, limit);
    const Mask holds = wanted == target;
    const F gain = holds ? weight : all(0.0F);
    store(joint.frictionGain, gain);
    addRow(rows, axis, gain, target - before * pass.applied);
    store(joint.frictionImpulse.x, holds ? before : target);
}

LUTKA_LANES AngularRows angularRows(JointLanes& joint, const JointConstants& constants, const V3& relative,
                                    const SubstepParams& params, const Pass& pass) {
    const F zero = all(0.0F);
    AngularRows rows{{zero, zero, zero, zero, zero, zero}, {zero, zero, zero}};
    const F frictionLimit = all(constants.frictionNm * params.dt);
    if (constants.isHinge != 0) {
        const F weight = load(joint.acrossWeight);
        const F rate = all(pass.useBias != 0 ? params.joint.biasRate : 0.0F);
        for (int i = 0; i < 2; ++i) {
            const V3 axis = load(joint.across[i]);
            const F carried = load(joint.hingeImpulse[i]) * (all(1.0F) - pass.applied);
            addRow(rows, axis, weight, carried - weight * (dot(axis, relative) + rate * load(joint.acrossError[i])));
        }
        if (constants.frictionNm > 0.0F) addHingeFriction(rows, joint, relative, frictionLimit, pass);
    } else {
        if (joint.limitActive[1] != 0) addLimit(rows, joint.limit[1], relative, params, pass);
        if (constants.frictionNm > 0.0F) addConeFriction(rows, joint, relative, frictionLimit, pass);
    }
    if (joint.limitActive[0] != 0) addLimit(rows, joint.limit[0], relative, params, pass);
    return rows;
}

// After the sweep: what the rows that held have gained. Returns the lanes whose guess was wrong.
LUTKA_LANES Mask updateRows(JointLanes& joint, const JointConstants& constants, const V3& relative,
                            const SubstepParams& params, int useBias) {
    Mask wrong = all(0.0F) > all(0.0F);
    const F friction = load(joint.frictionGain);
    if (constants.isHinge != 0) {
        const F weight = load(joint.acrossWeight);
        const F rate = all(useBias != 0 ? params.joint.biasRate : 0.0F);
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
    return contactBias(load(contact.separation), params.staticContact, params, useBias).speed;
}

// weight · J Jᵀ of a direction at an arm.
LUTKA_LANES void addDirection(Spatial& s, const V3& arm, const V3& direction, F gain, F push) {
    const V3 lever = cross(arm, direction);
    const V3 scaled = lever * gain;
    addSquare(s.linear, direction, gain);
    addSquare(s.turning, lever, gain);
    s.mixed.row[0] = s.mixed.row[0] + scaled * direction.x;
    s.mixed.row[1] = s.mixed.row[1] + scaled * direction.y;
    s.mixed.row[2] = s.mixed.row[2] + scaled * direction.z;
    s.impulse = s.impulse + direction * push;
    s.torque = s.torque + lever * push;
}

LUTKA_LANES void addStaticFriction(Spatial& s, StaticContactLanes& contact, const V3& sliding, F limit,
                                   const Pass& pass) {
    const V3 arm = load(contact.arm);
    const V3 t1 = load(contact.tangent[0]);
    const V3 t2 = load(contact.tangent[1]);
    const F weight = load(contact.tangentWeight);
    const F before1 = load(contact.tangentImpulse[0]);
    const F before2 = load(contact.tangentImpulse[1]);
    const F wanted1 = before1 - weight * dot(t1, sliding);
    const F wanted2 = before2 - weight * dot(t2, sliding);
    const F size = squareRoot(wanted1 * wanted1 + wanted2 * wanted2);
    const Mask holds = size <= limit;
    const F gain = holds ? weight : all(0.0F);
    const F cut = holds ? all(1.0F) : limit / most(size, all(1e-20F));
    store(contact.tangentGain, gain);
    addDirection(s, arm, t1, gain, wanted1 * cut - before1 * pass.applied);
    addDirection(s, arm, t2, gain, wanted2 * cut - before2 * pass.applied);
    store(contact.tangentImpulse[0], holds ? before1 : wanted1 * cut);
    store(contact.tangentImpulse[1], holds ? before2 : wanted2 * cut);
}

// Rolling resistance: a torque against any turning, of at most the normal force times a lever.
LUTKA_LANES void addRolling(Spatial& s, StaticContactLanes& contact, const V3& angular, F limit, const Pass& pass) {
    const F weight = load(contact.rollWeight);
    const V3 before = load(contact.rollImpulse);
    const V3 wanted = before - angular * weight;
    const F size = squareRoot(dot(wanted, wanted));
    const Mask holds = size <= limit;
    const F gain = holds ? weight : all(0.0F);
    const V3 target = wanted * (holds ? all(1.0F) : limit / most(size, all(1e-20F)));
    store(contact.rollGain, gain);
    s.turning.xx += gain;
    s.turning.yy += gain;
    s.turning.zz += gain;
    s.torque = s.torque + (target - before * pass.applied);
    store(contact.rollImpulse,
          V3{holds ? before.x : target.x, holds ? before.y : target.y, holds ? before.z : target.z});
}

LUTKA_LANES void addStatic(const BatchView& batch, StaticContactLanes& contact, const SubstepParams& params,
                           const Pass& pass) {
    const BodyLanes& body = batch.bodies[contact.body];
    TreeLanes& tree = batch.tree[contact.body];
    const F zero = all(0.0F);
    const V3 arm = load(contact.arm);
    const V3 normal = load(contact.normal);
    const V3 angular = load(body.angular);
    const V3 sliding = load(body.velocity) + cross(angular, arm);
    Spatial s = loadSpatial(tree);
    const F weight = load(contact.normalWeight);
    const F impulse = load(contact.normalImpulse);
    const F wanted = impulse - weight * (dot(normal, sliding) + staticBias(contact, params, pass.useBias));
    const Mask holds = wanted > zero;
    const F gain = holds ? weight : zero;
    store(contact.normalGain, gain);
    addDirection(s, arm, normal, gain, (holds ? wanted : zero) - impulse * pass.applied);
    const F pressing = most(impulse, zero);
    addStaticFriction(s, contact, sliding, load(contact.friction) * pressing, pass);
    addRolling(s, contact, angular, pressing * all(params.rollingLever), pass);
    storeSpatial(tree, s);
}

LUTKA_LANES Mask updateStatic(const BatchView& batch, StaticContactLanes& contact, const SubstepParams& params,
                              int useBias) {
    const BodyLanes& body = batch.bodies[contact.body];
    const V3 angular = load(body.angular);
    const V3 sliding = load(body.velocity) + cross(angular, load(contact.arm));
    const F gain = load(contact.normalGain);
    const F off = dot(load(contact.normal), sliding) + staticBias(contact, params, useBias);
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

LUTKA_LANES void startTree(const BatchView& batch) {
    const F zero = all(0.0F);
    const V3 none{zero, zero, zero};
    for (int b = 0; b < batch.bodyCount; ++b) {
        BodyLanes& body = batch.bodies[b];
        const BodyConstants& constants = batch.bodyConstants[b];
        const F mass = all(1.0F / constants.inverseMass);
        const Symmetric inertia = onAxes(axesOf(body), constants.inertia);
        const V3 steadyVelocity = load(body.steadyVelocity);
        const V3 steadyAngular = load(body.steadyAngular);
        const V3 pushed = (load(body.velocity) - steadyVelocity) * mass;
        const V3 turned = inertia * (load(body.angular) - steadyAngular);
        storeSpatial(batch.tree[b],
                     {{mass, mass, mass, zero, zero, zero}, {{none, none, none}}, inertia, pushed, turned});
        store(body.velocity, steadyVelocity);
        store(body.angular, steadyAngular);
    }
}

LUTKA_LANES void eliminate(const BatchView& batch, int index, const SubstepParams& params, const Pass& pass) {
    JointLanes& joint = batch.joints[index];
    const JointConstants& constants = batch.jointConstants[index];
    const BodyLanes& parent = batch.bodies[constants.parent];
    const BodyLanes& child = batch.bodies[constants.child];
    TreeLanes& tree = batch.tree[constants.child];
    const V3 parentArm = load(joint.parentArm);
    const V3 childArm = load(joint.childArm);
    const V3 parentAngular = load(parent.angular);
    const V3 childAngular = load(child.angular);
    const AngularRows rows = angularRows(joint, constants, childAngular - parentAngular, params, pass);
    V3 r = (load(parent.velocity) + cross(parentAngular, parentArm)) -
           (load(child.velocity) + cross(childAngular, childArm));
    if (pass.useBias != 0) r = r - load(joint.error) * all(params.joint.biasRate);

    const Spatial s = movedTo(loadSpatial(tree), childArm);
    const Symmetric e = inverse(s.turning + rows.weight);
    const Matrix ce = s.mixed * e;              // C E
    const Matrix ed = product(e, rows.weight);  // E D
    const V3 turn = e * (s.torque + rows.torque - transposed(s.mixed, r));
    store(tree.compliance, e);
    store(tree.fromAngular, ed);
    store(tree.fromLinear, ce);
    store(tree.anchorChange, r);
    store(tree.freeTurn, turn);

    const Symmetric linear = s.linear - symmetricProduct(ce, s.mixed);
    const Matrix mixed = ce * rows.weight;  // C E D
    const Matrix bed = rowsOf(s.turning);
    // B E D by rows: row i of B times E D.
    const auto rowTimes = [&](const V3& row) { return ed.row[0] * row.x + ed.row[1] * row.y + ed.row[2] * row.z; };
    const V3 b0 = rowTimes(bed.row[0]), b1 = rowTimes(bed.row[1]), b2 = rowTimes(bed.row[2]);
    const Symmetric turning{b0.x, b1.y, b2.z, b0.y, b0.z, b1.z};
    const V3 impulse = s.impulse - s.linear * r - s.mixed * turn;
    const V3 torque = s.torque - transposed(s.mixed, r) - s.turning * turn;

    TreeLanes& above = batch.tree[constants.parent];
    const V3 back = -parentArm;
    const Spatial moved = movedTo({linear, mixed, turning, impulse, torque}, back);
    Spatial sum = loadSpatial(above);
    sum.linear = sum.linear + moved.linear;
    sum.mixed = sum.mixed + moved.mixed;
    sum.turning = sum.turning + moved.turning;
    sum.impulse = sum.impulse + moved.impulse;
    sum.torque = sum.torque + moved.torque;
    storeSpatial(above, sum);
}

struct Motion {
    V3 velocity, angular;
};
LUTKA_LANES Motion solveRoot(const TreeLanes& tree) {
    const Spatial s = loadSpatial(tree);
    const Symmetric linear = inverse(s.linear);
    // Rows of Cᵀ H⁻¹ are images of the columns of C.
    const Matrix columns{{V3{s.mixed.row[0].x, s.mixed.row[1].x, s.mixed.row[2].x},
                          V3{s.mixed.row[0].y, s.mixed.row[1].y, s.mixed.row[2].y},
                          V3{s.mixed.row[0].z, s.mixed.row[1].z, s.mixed.row[2].z}}};
    const Matrix ch = columns * linear;
    const Symmetric turning = inverse(s.turning - symmetricProduct(ch, columns));
    const V3 angular = turning * (s.torque - ch * s.impulse);
    return {linear * (s.impulse - s.mixed * angular), angular};
}

LUTKA_LANES void addMotion(BodyLanes& body, const Motion& change) {
    const V3 velocity = load(body.velocity) + change.velocity;
    const V3 angular = load(body.angular) + change.angular;
    store(body.velocity, velocity);
    store(body.angular, angular);
    store(body.steadyVelocity, velocity);
    store(body.steadyAngular, angular);
}

// The way back: a body's change is kept where its right-hand side was, for its children.
LUTKA_LANES void substitute(const BatchView& batch, int index) {
    const JointLanes& joint = batch.joints[index];
    const JointConstants& constants = batch.jointConstants[index];
    TreeLanes& tree = batch.tree[constants.child];
    const TreeLanes& above = batch.tree[constants.parent];
    const V3 parentTurn = load(above.torque);
    const V3 anchor = load(above.impulse) + cross(parentTurn, load(joint.parentArm));
    const V3 turn =
        load(tree.freeTurn) - transposed(load(tree.fromLinear), anchor) + load(tree.fromAngular) * parentTurn;
    const V3 velocity = anchor + load(tree.anchorChange) - cross(turn, load(joint.childArm));
    store(tree.impulse, velocity);
    store(tree.torque, turn);
    addMotion(batch.bodies[constants.child], {velocity, turn});
}

// One Newton pass; returns whether the guess of some lane was wrong.
static bool sweep(const BatchView& batch, const SubstepParams& params, const Pass& pass) {
    startTree(batch);
    for (int i = 0; i < batch.contactCount; ++i)
        addStatic(batch, batch.contacts[i], params, pass);
    for (int j = batch.jointCount - 1; j >= 0; --j)
        eliminate(batch, j, params, pass);
    const Motion root = solveRoot(batch.tree[0]);
    store(batch.tree[0].impulse, root.velocity);
    store(batch.tree[0].torque, root.angular);
    addMotion(batch.bodies[0], root);
    for (int j = 0; j < batch.jointCount; ++j)
        substitute(batch, j);
    Mask wrong = all(0.0F) > all(0.0F);
    for (int j = 0; j < batch.jointCount; ++j) {
        const JointConstants& constants = batch.jointConstants[j];
        const V3 relative = load(batch.bodies[constants.child].angular) - load(batch.bodies[constants.parent].angular);
        wrong |= updateRows(batch.joints[j], constants, relative, params, pass.useBias);
    }
    for (int i = 0; i < batch.contactCount; ++i)
        wrong |= updateStatic(batch, batch.contacts[i], params, pass.useBias);
    return bits(wrong) != 0;
}

static void solve(const BatchView& batch, const SubstepParams& params, int useBias, int first) {
    const int passes = useBias != 0 ? params.passes : params.relaxPasses;
    for (int i = 0; i < passes; ++i) {
        const Pass pass{useBias, all(first != 0 && i == 0 ? 0.0F : 1.0F)};
        if (!sweep(batch, params, pass)) return;
    }
}

}  // namespace lutka::physics::crowd::LUTKA_CROWD_KERNELS
