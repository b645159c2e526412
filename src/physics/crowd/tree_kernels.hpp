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

///
/// The matrices are kept from one pass to the next while the same rows hold.

#include "physics/crowd/row_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_CROWD_KERNELS {

LUTKA_LANES void resetInertia(const BatchView& batch, int index) {
    const F zero = all(0.0F);
    const V3 none{zero, zero, zero};
    const F mass = all(1.0F / batch.bodyConstants[index].inverseMass);
    TreeLanes& tree = batch.tree[index];
    storeSpatial(tree, {{mass, mass, mass, zero, zero, zero}, {{none, none, none}}, load(tree.own)});
}

// Each body's own inertia and, as impulses, what was done to it since the last sweep.
LUTKA_LANES void startBody(const BatchView& batch, int index, bool first) {
    BodyLanes& body = batch.bodies[index];
    TreeLanes& tree = batch.tree[index];
    const BodyConstants& constants = batch.bodyConstants[index];
    const F mass = all(1.0F / constants.inverseMass);
    if (first) {
        store(tree.own, onAxes(axesOf(body), constants.inertia));
        resetInertia(batch, index);
    }
    const V3 steadyVelocity = load(body.steadyVelocity);
    const V3 steadyAngular = load(body.steadyAngular);
    store(tree.impulse, (load(body.velocity) - steadyVelocity) * mass);
    store(tree.torque, load(tree.own) * (load(body.angular) - steadyAngular));
    store(body.velocity, steadyVelocity);
    store(body.angular, steadyAngular);
}

// Takes a child out of the equations: its matrices go over to the parent's.
LUTKA_LANES void eliminate(const BatchView& batch, int index) {
    const JointLanes& joint = batch.joints[index];
    const JointConstants& constants = batch.jointConstants[index];
    TreeLanes& tree = batch.tree[constants.child];
    TreeLanes& above = batch.tree[constants.parent];
    const Spatial s = movedTo(loadSpatial(tree), load(joint.childArm));
    const Symmetric weight = angularWeight(joint, constants);
    const Symmetric e = inverse(s.turning + weight);
    const Matrix ce = s.mixed * e;         // C E
    const Matrix ed = product(e, weight);  // E D
    storeSpatial(tree, s);
    store(tree.compliance, e);
    store(tree.fromAngular, ed);
    store(tree.fromLinear, ce);
    // B E D, symmetric, by rows: row i of B times E D.
    const Matrix b = rowsOf(s.turning);
    const V3 row0 = transposed(ed, b.row[0]), row1 = transposed(ed, b.row[1]), row2 = transposed(ed, b.row[2]);
    const Spatial left{
        s.linear - symmetricProduct(ce, s.mixed), ce * weight, {row0.x, row1.y, row2.z, row0.y, row0.z, row1.z}};
    const Spatial moved = movedTo(left, -load(joint.parentArm));
    const Spatial sum = loadSpatial(above);
    storeSpatial(above, {sum.linear + moved.linear, sum.mixed + moved.mixed, sum.turning + moved.turning});
}

// The right-hand side of the same elimination.
LUTKA_LANES void carryUp(const BatchView& batch, int index, const SubstepParams& params, int useBias) {
    const JointLanes& joint = batch.joints[index];
    const JointConstants& constants = batch.jointConstants[index];
    const BodyLanes& parent = batch.bodies[constants.parent];
    const BodyLanes& child = batch.bodies[constants.child];
    TreeLanes& tree = batch.tree[constants.child];
    TreeLanes& above = batch.tree[constants.parent];
    const V3 parentArm = load(joint.parentArm);
    const V3 childArm = load(joint.childArm);
    V3 r = (load(parent.velocity) + cross(load(parent.angular), parentArm)) -
           (load(child.velocity) + cross(load(child.angular), childArm));
    if (useBias != 0) r = r - load(joint.error) * all(params.jointRate);
    const Spatial s = loadSpatial(tree);
    const V3 atCentre = load(tree.impulse);
    const V3 resisting = load(tree.torque) - cross(childArm, atCentre) - transposed(s.mixed, r);
    const V3 turn = load(tree.compliance) * (resisting + load(joint.rowTorque));
    store(tree.anchorChange, r);
    store(tree.freeTurn, turn);
    const V3 impulse = atCentre - s.linear * r - s.mixed * turn;
    const V3 torque = resisting - s.turning * turn;
    store(above.impulse, load(above.impulse) + impulse);
    store(above.torque, load(above.torque) + (torque + cross(parentArm, impulse)));
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
    const V3 impulse = load(tree.impulse);
    const V3 angular = turning * (load(tree.torque) - ch * impulse);
    return {linear * (impulse - s.mixed * angular), angular};
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

// Guesses which rows hold; returns whether the guess is another than in the pass before.
LUTKA_LANES bool decide(const BatchView& batch, const SubstepParams& params, Pass& pass) {
    for (int j = 0; j < batch.jointCount; ++j) {
        const JointConstants& constants = batch.jointConstants[j];
        const V3 relative = load(batch.bodies[constants.child].angular) - load(batch.bodies[constants.parent].angular);
        decideJoint(batch.joints[j], constants, relative, params, pass);
    }
    for (int i = 0; i < batch.contactCount; ++i)
        decideStatic(batch, batch.contacts[i], params, pass);
    return bits(pass.changed) != 0;
}

// Adds the impulses of the rows that held and returns whether the guess was wrong in some lane.
LUTKA_LANES bool update(const BatchView& batch, const SubstepParams& params, int useBias) {
    Mask wrong = noLanes();
    for (int j = 0; j < batch.jointCount; ++j) {
        const JointConstants& constants = batch.jointConstants[j];
        const V3 relative = load(batch.bodies[constants.child].angular) - load(batch.bodies[constants.parent].angular);
        wrong |= updateRows(batch.joints[j], constants, relative, params, useBias);
    }
    for (int i = 0; i < batch.contactCount; ++i)
        wrong |= updateStatic(batch, batch.contacts[i], params, useBias);
    return bits(wrong) != 0;
}

// One Newton pass; returns whether its guess was wrong.
static bool sweep(const BatchView& batch, const SubstepParams& params, Pass pass, bool first) {
    // Before the guess, the velocities with which all joints hold; what was done to single bodies becomes impulses.
    for (int b = 0; b < batch.bodyCount; ++b)
        startBody(batch, b, first);
    const bool changed = decide(batch, params, pass);
    if (changed && !first) {
        for (int b = 0; b < batch.bodyCount; ++b)
            resetInertia(batch, b);
    }
    for (int i = 0; i < batch.contactCount; ++i) {
        if (batch.contacts[i].engaged == 0) continue;
        if (changed || first) addStaticWeight(batch, batch.contacts[i]);
        addStaticPush(batch, batch.contacts[i]);
    }
    for (int j = batch.jointCount - 1; (changed || first) && j >= 0; --j)
        eliminate(batch, j);
    for (int j = batch.jointCount - 1; j >= 0; --j)
        carryUp(batch, j, params, pass.useBias);
    const Motion root = solveRoot(batch.tree[0]);
    store(batch.tree[0].impulse, root.velocity);
    store(batch.tree[0].torque, root.angular);
    addMotion(batch.bodies[0], root);
    for (int j = 0; j < batch.jointCount; ++j)
        substitute(batch, j);
    return update(batch, params, pass.useBias);
}

// Whether some row mended an error, whose speed the relaxing pass must take out.
static bool mends(const BatchView& batch, const SubstepParams& params) {
    Mask off = noLanes();
    for (int j = 0; j < batch.jointCount; ++j) {
        const JointLanes& joint = batch.joints[j];
        const V3 error = load(joint.error);
        off |= dot(error, error) > all(params.relaxGap * params.relaxGap);
        for (int i = 0; i < 2; ++i) {
            if (joint.limitActive[i] != 0) off |= load(joint.limit[i].room) < all(-params.relaxAngle);
        }
    }
    for (int i = 0; i < batch.contactCount; ++i) {
        const StaticContactLanes& contact = batch.contacts[i];
        if (contact.engaged != 0) off |= load(contact.separation) < all(-params.slop - params.relaxGap);
    }
    return bits(off) != 0;
}

static void solve(const BatchView& batch, const SubstepParams& params, int useBias, int first) {
    if (useBias == 0 && !mends(batch, params)) return;
    const int passes = useBias != 0 ? params.passes : params.relaxPasses;
    const Mask none = noLanes();
    for (int i = 0; i < passes; ++i) {
        const bool start = first != 0 && i == 0;
        if (!sweep(batch, params, {useBias, all(start ? 0.0F : 1.0F), none}, start)) return;
    }
}

}  // namespace lutka::physics::crowd::LUTKA_CROWD_KERNELS
