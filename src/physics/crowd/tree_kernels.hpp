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
/// What a pass costs is memory more than arithmetic: all that is done with a body on the way up, and all on the way
/// down, is done while its numbers are at hand.

#include "physics/crowd/drag_kernels.hpp"
#include "physics/crowd/pair_body_kernels.hpp"
#include "physics/crowd/target_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

// Pushes on single bodies (gravity, contacts between bodies) change body.velocity; the sweep's own result is
// body.steadyVelocity, with which all joints hold. What a sweep brings in of the difference: nothing, what was pushed
// since the last sweep, or all pushes of this substep, to solve the joints from the beginning.
enum class Fresh { nothing, since, whole };

// A body's inertia about its centre with that of everything below it, what was done to it since the last sweep
// (`fresh`), and the contacts that hold it.
LUTKA_LANES Loaded loadBody(const BatchView& batch, int index, bool gathers, const SubstepParams& params,
                            const Pass& pass, Fresh fresh) {
    const BodyLanes& body = batch.bodies[index];
    const F zero = all(0.0F);
    const V3 none{zero, zero, zero};
    const F mass = all(batch.bodyConstants[index].mass);
    const Symmetric inertia = load(body.inertia);
    Loaded loaded{{{mass, mass, mass, zero, zero, zero}, {{none, none, none}}, inertia}, none, none};
    if (fresh != Fresh::nothing) {
        const bool whole = fresh == Fresh::whole;
        loaded.impulse = (load(whole ? body.loose : body.velocity) - load(body.steadyVelocity)) * mass;
        loaded.torque = inertia * (load(whole ? body.looseAngular : body.angular) - load(body.steadyAngular));
    }
    if (gathers) {
        const GatheredLanes& below = batch.tree[index].gathered;
        loaded.inertia = loaded.inertia + load(below);
        loaded.impulse = loaded.impulse + load(below.impulse);
        loaded.torque = loaded.torque + load(below.torque);
    }
    for (int i = batch.firstContact[index]; i < batch.firstContact[index + 1]; ++i) {
        if (batch.contacts[i].near != 0) askStatic(body, batch.contacts[i], params, pass, loaded);
    }
    for (int i = 0; i < batch.dragCount; ++i) {
        if (batch.drags[i].body == index) askDrag(body, batch.drags[i], pass, loaded);
    }
    if (batch.targets != nullptr && batch.targets[index].active != 0)
        addTarget(askTarget(body, batch.targets[index], pass), loaded);
    return loaded;
}

// Adds to what the parent gathers, or begins it.
LUTKA_LANES void gather(GatheredLanes& above, bool opens, const Loaded& loaded) {
    if (opens) {
        store(above, loaded.inertia);
        store(above.impulse, loaded.impulse);
        store(above.torque, loaded.torque);
        return;
    }
    store(above, load(above) + loaded.inertia);
    store(above.impulse, load(above.impulse) + loaded.impulse);
    store(above.torque, load(above.torque) + loaded.torque);
}

// The way up: takes a joint's child out of the equations.
LUTKA_LANES void eliminate(const BatchView& batch, int index, const SubstepParams& params, const Pass& pass,
                           Fresh fresh) {
    JointLanes& joint = batch.joints[index];
    const JointConstants& constants = batch.jointConstants[index];
    const BodyLanes& parent = batch.bodies[constants.parent];
    const BodyLanes& child = batch.bodies[constants.child];
    const Loaded loaded = loadBody(batch, constants.child, constants.childGathers != 0, params, pass, fresh);
    const V3 parentAngular = load(parent.steadyAngular);
    const V3 childAngular = load(child.steadyAngular);
    JointTerms terms = askJoint(joint, constants, childAngular - parentAngular, pass);
    if (batch.motors != nullptr && batch.motors[index].active != 0) {
        const JointTerms driven = askMotor(batch.motors[index], joint, constants, childAngular - parentAngular, pass);
        terms = {terms.torque + driven.torque, terms.weight + driven.weight};
    }
    if (batch.targets != nullptr) terms = scaled(terms, freeToTurn(batch, constants));
    const V3 parentArm = load(joint.parentArm);
    const V3 childArm = load(joint.childArm);
    V3 r = (load(parent.steadyVelocity) + cross(parentAngular, parentArm)) -
           (load(child.steadyVelocity) + cross(childAngular, childArm));
    r = r - load(joint.drift);
    if (pass.mending) r = r - load(joint.bias);

    const Spatial s = movedTo(loaded.inertia, childArm);
    const Symmetric e = inverse(s.turning + terms.weight);
    const V3 resisting = loaded.torque - cross(childArm, loaded.impulse) - transposed(s.mixed, r);
    const V3 turn = e * (resisting + terms.torque);
    const V3 impulse = loaded.impulse - s.linear * r - s.mixed * turn;
    const V3 torque = resisting - s.turning * turn;
    const Matrix ce = s.mixed * e;               // C E
    const Matrix ed = product(e, terms.weight);  // E D
    // B E D, symmetric, by rows: row i of B times E D.
    const Matrix b = rowsOf(s.turning);
    const V3 row0 = transposed(ed, b.row[0]), row1 = transposed(ed, b.row[1]), row2 = transposed(ed, b.row[2]);
    const Spatial left{
        s.linear - symmetricProduct(ce, s.mixed), ce * terms.weight, {row0.x, row1.y, row2.z, row0.y, row0.z, row1.z}};
    EliminatedLanes& eliminated = batch.tree[constants.child].eliminated;
    store(eliminated.fromAngular, ed);
    store(eliminated.fromLinear, ce);
    store(eliminated.anchorChange, r);
    store(eliminated.freeTurn, turn);
    gather(batch.tree[constants.parent].gathered, constants.opens != 0,
           {movedTo(left, -parentArm), impulse, torque + cross(parentArm, impulse)});
}

struct Motion {
    V3 velocity, angular;
};
LUTKA_LANES Motion solveRoot(const Loaded& loaded) {
    const Spatial& s = loaded.inertia;
    const Symmetric linear = inverse(s.linear);
    // Rows of Cᵀ H⁻¹ are images of the columns of C.
    const Matrix columns{{V3{s.mixed.row[0].x, s.mixed.row[1].x, s.mixed.row[2].x},
                          V3{s.mixed.row[0].y, s.mixed.row[1].y, s.mixed.row[2].y},
                          V3{s.mixed.row[0].z, s.mixed.row[1].z, s.mixed.row[2].z}}};
    const Matrix ch = columns * linear;
    const Symmetric turning = inverse(s.turning - symmetricProduct(ch, columns));
    const V3 angular = turning * (loaded.torque - ch * loaded.impulse);
    return {linear * (loaded.impulse - s.mixed * angular), angular};
}

// A body's new velocities; its change is kept for its children. Returns the lanes in which a contact was guessed wrong.
LUTKA_LANES Mask moveBody(const BatchView& batch, int index, const Motion& change, const SubstepParams& params,
                          Pass& pass) {
    BodyLanes& body = batch.bodies[index];
    TreeLanes& tree = batch.tree[index];
    const V3 velocity = load(body.steadyVelocity) + change.velocity;
    const V3 angular = load(body.steadyAngular) + change.angular;
    store(tree.velocityChange, change.velocity);
    store(tree.angularChange, change.angular);
    store(body.velocity, velocity);
    store(body.angular, angular);
    const V3 off = angular - load(body.aim);
    const F missed = all(0.5F * params.dt * params.dt * batch.bodyConstants[index].armReach);
    pass.astray |= dot(off, off) * dot(angular, angular) * (missed * missed) > all(params.aimGap * params.aimGap);
    Mask wrong = noLanes();
    if (pass.mending) {
        if (pass.probes) return wrong;
        const F speed = speedBound(body, batch.bodyConstants[index]);
        for (int i = batch.firstContact[index]; i < batch.firstContact[index + 1]; ++i) {
            StaticContactLanes& contact = batch.contacts[i];
            if (contact.near == 0) {
                if (bits(meetsFar(contact, body, speed)) == 0) continue;
                bringNear(contact, batch, params);
            }
            wrong |= holdMet(body, contact, params);
        }
        return wrong;
    }
    store(body.steadyVelocity, velocity);
    store(body.steadyAngular, angular);
    for (int i = batch.firstContact[index]; i < batch.firstContact[index + 1]; ++i) {
        if (batch.contacts[i].near != 0) wrong |= updateStatic(body, batch.contacts[i], params, pass);
    }
    for (int i = 0; i < batch.dragCount; ++i) {
        if (batch.drags[i].body == index) wrong |= updateDrag(body, batch.drags[i], pass);
    }
    if (batch.targets != nullptr && batch.targets[index].active != 0) updateTarget(body, batch.targets[index]);
    return wrong;
}

// The way down.
LUTKA_LANES Mask substitute(const BatchView& batch, int index, const SubstepParams& params, Pass& pass) {
    JointLanes& joint = batch.joints[index];
    const JointConstants& constants = batch.jointConstants[index];
    const TreeLanes& above = batch.tree[constants.parent];
    const EliminatedLanes& eliminated = batch.tree[constants.child].eliminated;
    const V3 parentTurn = load(above.angularChange);
    const V3 anchor = load(above.velocityChange) + cross(parentTurn, load(joint.parentArm));
    const V3 turn = load(eliminated.freeTurn) - transposed(load(eliminated.fromLinear), anchor) +
                    load(eliminated.fromAngular) * parentTurn;
    const V3 velocity = anchor + load(eliminated.anchorChange) - cross(turn, load(joint.childArm));
    Mask wrong = moveBody(batch, constants.child, {velocity, turn}, params, pass);
    if (pass.mending) {
        if (pass.probes) return wrong;
        return wrong |
               holdPassed(joint,
                          load(batch.bodies[constants.child].angular) - load(batch.bodies[constants.parent].angular),
                          params);
    }
    const V3 relative =
        load(batch.bodies[constants.child].steadyAngular) - load(batch.bodies[constants.parent].steadyAngular);
    if (batch.motors != nullptr && batch.motors[index].active != 0)
        wrong |= updateMotor(batch.motors[index], joint, constants, relative, pass);
    Mask off = updateJoint(joint, constants, relative, params, pass);
    if (batch.targets != nullptr) {
        const F free = freeToTurn(batch, constants);
        forgetHeld(joint, constants, free);
        if (batch.motors != nullptr) drivesOnly(batch.motors[index], free);
        off &= free > all(0.0F);
    }
    return wrong | off;
}

// One Newton pass; returns the lanes whose guess was wrong.
static Mask sweep(const BatchView& batch, const SubstepParams& params, Pass& pass, Fresh fresh) {
    for (int j = batch.jointCount - 1; j >= 0; --j)
        eliminate(batch, j, params, pass, fresh);
    const Loaded root = loadBody(batch, 0, batch.jointCount > 0, params, pass, fresh);
    Mask wrong = moveBody(batch, 0, solveRoot(root), params, pass);
    for (int j = 0; j < batch.jointCount; ++j)
        wrong |= substitute(batch, j, params, pass);
    return wrong;
}

// Whether anything is so far off that it is to be mended.
static int needsMending(const BatchView& batch, const SubstepParams& params) {
    for (int j = 0; j < batch.jointCount; ++j) {
        if (batch.joints[j].mends != 0) return 1;
    }
    Mask off = noLanes();
    for (int i = 0; i < batch.contactCount; ++i) {
        const StaticContactLanes& contact = batch.contacts[i];
        if (contact.engaged != 0) off |= load(contact.bias) < all(-params.mendGap * params.contactRate);
    }
    return bits(off) != 0 ? 1 : 0;
}

// The arms of all rows, as the bodies' aims foresee them.
static void aimRows(const BatchView& batch, const SubstepParams& params) {
    for (int j = 0; j < batch.jointCount; ++j) {
        const JointConstants& constants = batch.jointConstants[j];
        aimJoint(batch.joints[j], constants, batch.bodies[constants.parent], batch.bodies[constants.child], params);
    }
    for (int i = 0; i < batch.contactCount; ++i) {
        StaticContactLanes& contact = batch.contacts[i];
        if (contact.near == 0) continue;
        const BodyLanes& body = batch.bodies[contact.body];
        store(contact.arm, armOf(contact, body, axesOf(body) * load(contact.localPoint)));
    }
    for (int i = 0; i < batch.dragCount; ++i)
        aimDrag(batch.drags[i], batch.bodies[batch.drags[i].body]);
}

// Foresees the arms anew in some lanes, by `share` of what the rates have changed.
static void aim(const BatchView& batch, const SubstepParams& params, const Mask& lanes, float share) {
    for (int b = 0; b < batch.bodyCount; ++b) {
        BodyLanes& body = batch.bodies[b];
        const V3 before = load(body.aim);
        const V3 angular = choose(lanes, before + (load(body.angular) - before) * all(share), before);
        aimBody(body, batch.bodyConstants[b], angular, load(body.steadyAngular), all(0.5F * params.dt));
    }
    aimRows(batch, params);
}

// Foresees them as if nothing but what was done to the single bodies turned them, in some lanes.
static void aimLoose(const BatchView& batch, const SubstepParams& params, const Mask& lanes) {
    for (int b = 0; b < batch.bodyCount; ++b) {
        BodyLanes& body = batch.bodies[b];
        const V3 angular = choose(lanes, load(body.looseAngular), load(body.aim));
        const V3 steady = choose(lanes, load(body.looseAngular), load(body.steadyAngular));
        aimBody(body, batch.bodyConstants[b], angular, steady, all(0.5F * params.dt));
    }
    aimRows(batch, params);
}

// One pass of a mending, in some lanes with firm static contacts. Returns the lanes that need another.
static unsigned mendOnce(const BatchView& batch, const SubstepParams& params, unsigned firmly, MendPass kind) {
    const F firmness = lanesOf(firmly) ? all(params.wedgeFirmness) : all(1.0F);
    Pass pass{true, all(1.0F), true, noLanes(), all(1.0F), noLanes(), noLanes(), firmness, kind == MendPass::probe};
    const Mask wrong = sweep(batch, params, pass, Fresh::since);
    if (pass.probes) return 0;
    if (kind != MendPass::last && bits(pass.astray) != 0) aim(batch, params, pass.astray, 1.0F);
    return bits(wrong | pass.astray);
}

// Takes back all mending in some lanes. What lies deeper in static geometry than the fastest push mends in a substep
// leaves it as a rigid body: that opens no joint and runs through no limit, where pushes at single points fold the doll
// up and are never solved. Where it lies on both sides of a wall, the side of the most points wins.
static void mendNot(const BatchView& batch, const SubstepParams& params, unsigned lanes) {
    const Mask taken = lanesOf(lanes);
    const F zero = all(0.0F);
    V3 out{zero, zero, zero};
    for (int i = 0; i < batch.contactCount; ++i) {
        const StaticContactLanes& contact = batch.contacts[i];
        if (contact.near == 0) continue;
        const Mask isDeep = load(contact.bias) <= all(-params.pushSpeed);
        out = out + load(contact.normal) * (isDeep ? all(1.0F) : zero);
    }
    const F length2 = dot(out, out);
    const F speed = length2 > all(0.25F) ? all(params.pushSpeed) / squareRoot(most(length2, all(0.25F))) : zero;
    out = out * speed;
    for (int b = 0; b < batch.bodyCount; ++b) {
        BodyLanes& body = batch.bodies[b];
        store(body.velocity, choose(taken, load(body.steadyVelocity) + out, load(body.velocity)));
        store(body.angular, choose(taken, load(body.steadyAngular), load(body.angular)));
    }
}

// Gathers what has been done to single bodies, without the joints' answer.
static void gatherLoose(const BatchView& batch, bool isFirst) {
    for (int b = 0; b < batch.bodyCount; ++b) {
        BodyLanes& body = batch.bodies[b];
        if (isFirst) {
            body.loose = body.velocity;
            body.looseAngular = body.angular;
        } else {
            store(body.loose, load(body.loose) + (load(body.velocity) - load(body.steadyVelocity)));
            store(body.looseAngular, load(body.looseAngular) + (load(body.angular) - load(body.steadyAngular)));
        }
    }
}

// What is solved for: all pushes of the substep, those that were pressed since, or contacts that were found since.
enum class Solving { first, answer, again };

// Passes until the guesses are right. `aims`: whether the arms are foreseen anew where bodies turn otherwise than
// foreseen. Returns whether they were.
static bool guess(const BatchView& batch, const SubstepParams& params, Solving what, Pass& pass, Fresh fresh,
                  bool aims) {
    bool aimed = false;
    for (int i = 0; i < params.passes; ++i) {
        pass.astray = noLanes();
        const Mask wrong = sweep(batch, params, pass, fresh);
        const bool astray = aims && bits(pass.astray) != 0;
        if (bits(wrong) == 0 && !astray) return aimed;
        // At other arms the joints push otherwise: an answer to further pushes is solved from the beginning, or what
        // was pushed at the old arms would be left over as energy. Taken whole each time, the arms of a light limb
        // under a great load go to and fro by more and more.
        const bool anew = astray && what != Solving::first;
        if (astray) aim(batch, params, ~noLanes(), anew && i > 0 ? 0.5F : 1.0F);
        aimed = aimed || astray;
        fresh = anew ? Fresh::whole : Fresh::nothing;
        pass.applied = all(anew ? 0.0F : 1.0F);
        pass.begun = true;
        if (i + 1 >= params.patience) pass.late |= wrong;
    }
    return aimed;
}

LUTKA_LANES F kineticEnergy(const BatchView& batch, Wide3 BodyLanes::*velocity, Wide3 BodyLanes::*angular) {
    F energy = all(0.0F);
    for (int b = 0; b < batch.bodyCount; ++b) {
        const BodyLanes& body = batch.bodies[b];
        const V3 moving = load(body.*velocity);
        const V3 turning = load(body.*angular);
        energy = energy + all(0.5F * batch.bodyConstants[b].mass) * dot(moving, moving) +
                 all(0.5F) * dot(load(body.inertia) * turning, turning);
    }
    return energy;
}

// The motion of a doll as a whole. Positions and velocities are as seen from its first body: far from the origin and in
// a fast fall the small differences count.
struct WholeMotion {
    F mass;
    V3 centre;    // m
    V3 velocity;  // m/s, of the centre of mass
    Symmetric inertia;
    V3 angularMomentum;  // both about it, as is
    F energy;            // J, kinetic
};

LUTKA_LANES WholeMotion wholeMotion(const BatchView& batch, Wide3 BodyLanes::*velocity, Wide3 BodyLanes::*angular) {
    const F zero = all(0.0F);
    const V3 none{zero, zero, zero};
    const V3 origin = load(batch.bodies[0].position);
    const V3 drift = load(batch.bodies[0].*velocity);
    WholeMotion whole{zero, none, none, {zero, zero, zero, zero, zero, zero}, none, zero};
    for (int b = 0; b < batch.bodyCount; ++b) {
        const BodyLanes& body = batch.bodies[b];
        const F mass = all(batch.bodyConstants[b].mass);
        const Symmetric inertia = onAxes(axesOf(body), batch.bodyConstants[b].inertia);
        const V3 arm = load(body.position) - origin;
        const V3 moving = load(body.*velocity) - drift;
        const V3 turning = load(body.*angular);
        const V3 own = inertia * turning;
        whole.mass = whole.mass + mass;
        whole.centre = whole.centre + arm * mass;
        whole.velocity = whole.velocity + moving * mass;
        whole.inertia = whole.inertia + inertia + pointInertia(arm, mass);
        whole.angularMomentum = whole.angularMomentum + cross(arm, moving * mass) + own;
        whole.energy = whole.energy + all(0.5F) * (mass * dot(moving, moving) + dot(own, turning));
    }
    const F share = all(1.0F) / whole.mass;
    whole.centre = whole.centre * share;
    whole.velocity = whole.velocity * share;
    whole.inertia = whole.inertia - pointInertia(whole.centre, whole.mass);
    whole.angularMomentum = whole.angularMomentum - cross(whole.centre, whole.velocity * whole.mass);
    whole.energy = whole.energy - all(0.5F) * whole.mass * dot(whole.velocity, whole.velocity);
    return whole;
}

LUTKA_LANES F keptEnergy(const BatchView& batch) {
    return kineticEnergy(batch, &BodyLanes::steadyVelocity, &BodyLanes::steadyAngular);
}

// The velocity of a pull's point, m/s.
LUTKA_LANES V3 pointVelocity(const BatchView& batch, const DragLanes& drag, Wide3 BodyLanes::*velocity,
                             Wide3 BodyLanes::*angular) {
    const BodyLanes& body = batch.bodies[drag.body];
    return load(body.*velocity) + cross(load(body.*angular), load(drag.arm));
}
LUTKA_LANES V3 keptVelocity(const BatchView& batch, const DragLanes& drag) {
    return pointVelocity(batch, drag, &BodyLanes::steadyVelocity, &BodyLanes::steadyAngular);
}

// What the pulls have given since the substep began, joules: each its impulse times the mean of its point's velocity
// then and now. What contacts did to the pulled body alone says nothing about it: a light hand that is pulled onto the
// own head would seem to take more than all of the doll has.
LUTKA_LANES F workOfDrags(const BatchView& batch) {
    F work = all(0.0F);
    for (int i = 0; i < batch.dragCount; ++i) {
        const DragLanes& drag = batch.drags[i];
        work = work + all(0.5F) * dot(load(drag.impulse), load(drag.before) + keptVelocity(batch, drag));
    }
    return work;
}

// The same, since all was done to the single bodies.
LUTKA_LANES F workOnLoose(const BatchView& batch) {
    F work = all(0.0F);
    for (int i = 0; i < batch.dragCount; ++i) {
        const DragLanes& drag = batch.drags[i];
        const V3 loose = pointVelocity(batch, drag, &BodyLanes::loose, &BodyLanes::looseAngular);
        work = work + all(0.5F) * dot(load(drag.impulse), loose + keptVelocity(batch, drag));
    }
    return work;
}

// Whether energy, joules, is more than was given, but for rounding and arms that are not quite those of the motion.
LUTKA_LANES Mask gainsOver(F has, F given) {
    constexpr float kShare = 0.003F;
    constexpr float kJoules = 0.1F;
    return has > given * all(1.0F + kShare) + all(kJoules);
}

// The lanes that have more energy than what was done to their single bodies gave them, or than they began the substep
// with where nothing else pushes. Rows that only hold take some away.
static Mask gainsEnergy(const BatchView& batch) {
    if (batch.motors != nullptr || batch.targets != nullptr) return noLanes();
    const F loose = kineticEnergy(batch, &BodyLanes::loose, &BodyLanes::looseAngular) + workOnLoose(batch);
    const F began = load(*batch.energy) + workOfDrags(batch);
    return gainsOver(keptEnergy(batch), load(*batch.struck) > all(0.0F) ? loose : least(loose, began));
}

static void solveAll(const BatchView& batch, const SubstepParams& params, Solving what) {
    const bool isFirst = what == Solving::first;
    gatherLoose(batch, isFirst);
    const Mask alone = params.isHeap != 0 ? noLanes() : load(*batch.struck) < all(Struck::byDoll);
    Pass pass{false, all(isFirst ? 0.0F : 1.0F), !isFirst, noLanes(), load(batch.rest->stiction), noLanes(), alone};
    if (!guess(batch, params, what, pass, Fresh::since, true)) return;
    // Arms that are foreseen by what their own pushes give may turn a light limb faster and faster: one hand in some
    // thousand falls was sped up to 360 rad/s. Arms that stay cannot. They are those of free motion, but where contacts
    // within the doll were pressed again: what those pushed a single body with says nothing about how it turns.
    Mask gains = gainsEnergy(batch);
    if (bits(gains) == 0) return;
    const auto again = [&](bool aims) {
        aimLoose(batch, params, gains & ~answersItself(batch));
        Pass whole{false, all(0.0F), true, noLanes(), pass.stiction, noLanes(), alone};
        guess(batch, params, Solving::again, whole, Fresh::whole, aims);
    };
    // By half of what changes each time the arms may come to rest all the same, and a joint does not open.
    if (isFirst) {
        again(true);
        gains = gainsEnergy(batch);
        if (bits(gains) == 0) return;
    }
    again(false);
}

static void solve(const BatchView& batch, const SubstepParams& params, int first) {
    const Taken taken = takePushed(batch);
    if (first == 0 && bits(taken.pressed > all(0.0F)) == 0) return;
    const F before = first != 0 ? all(0.0F) : keptEnergy(batch);
    if (first != 0) {
        store(*batch.struck, taken.struck);
        takeSupports(batch);
        store(*batch.answered, all(0.0F));
        store(*batch.energy, keptEnergy(batch));
        if (batch.jointCount > 0) {
            const WholeMotion whole = wholeMotion(batch, &BodyLanes::steadyVelocity, &BodyLanes::steadyAngular);
            store(batch.flight->angularMomentum, whole.angularMomentum);
            store(batch.flight->energy, whole.energy);
        }
        for (int i = 0; i < batch.dragCount; ++i)
            store(batch.drags[i].before, keptVelocity(batch, batch.drags[i]));
    } else {
        const F zero = all(0.0F);
        store(*batch.answered, taken.pressed > zero ? all(1.0F) : load(*batch.answered));
        const F struck = taken.pressed > all(Pressed::within) ? all(Struck::byDoll) : zero;
        store(*batch.struck, most(load(*batch.struck), struck));
    }
    solveAll(batch, params, first != 0 ? Solving::first : Solving::answer);
    showMotions(batch);
    if (first != 0) return;
    showRises(batch, answersItself(batch) & gainsOver(keptEnergy(batch), before));
}

static void solveAgain(const BatchView& batch, const SubstepParams& params) {
    for (int i = 0; i < batch.contactCount; ++i)
        beginStatic(batch.contacts[i], batch, params);
    solveAll(batch, params, Solving::again);
    showMotions(batch);
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
