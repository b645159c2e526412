#pragma once

/// The end of a substep: what a doll in free flight keeps, and the bodies' new positions.

#include "physics/crowd/tree_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

// The lanes in which nothing holds the doll that the solver of joints took into account: no static contact, no drag, no
// target. Nor does another doll press it.
static Mask unheld(const BatchView& batch) {
    Mask held = load(*batch.struck) >= all(Struck::byDoll);
    for (int i = 0; i < batch.contactCount; ++i) {
        if (batch.contacts[i].engaged != 0) held |= load(batch.contacts[i].normalImpulse) > all(0.0F);
    }
    for (int i = 0; i < batch.dragCount; ++i)
        held |= load(batch.drags[i].weight) > all(0.0F);
    for (int b = 0; batch.targets != nullptr && b < batch.bodyCount; ++b)
        held |= load(batch.targets[b].weight) > all(0.0F);
    return ~held;
}

// The solver pushes at the arms of the substep's middle, so that the anchors meet at its end, while the bodies' centres
// are still where the substep began. Together that is a torque of (middle arm - arm) x push from nowhere, and cost a
// tumbling doll 4 % of its angular momentum a second. What a body keeps is what pushes at the arms of the start give
// (as in SHAKE; Ryckaert, Ciccotti and Berendsen 1977): the anchors are one point there, so nothing is lost.
// What rests on something keeps what the solver found, which holds the contact. So does a doll that is struck: the push
// of a hit at an arm that is a little off turned light limbs by another 100 rad/s a substep.
static void keepMomentum(const BatchView& batch) {
    const Mask free = unheld(batch);
    if (bits(free) == 0) return;
    const F share = free ? all(1.0F) : all(0.0F);
    // A joint's push is the sum over all that hangs on it; velocityChange is free for that once the tree is solved.
    for (int b = 0; b < batch.bodyCount; ++b) {
        const BodyLanes& body = batch.bodies[b];
        const F mass = all(batch.bodyConstants[b].mass);
        store(batch.tree[b].velocityChange, (load(body.steadyVelocity) - load(body.loose)) * mass);
    }
    for (int j = batch.jointCount - 1; j >= 0; --j) {
        const JointLanes& joint = batch.joints[j];
        const JointConstants& constants = batch.jointConstants[j];
        BodyLanes& parent = batch.bodies[constants.parent];
        BodyLanes& child = batch.bodies[constants.child];
        const V3 push = load(batch.tree[constants.child].velocityChange);
        Wide3& above = batch.tree[constants.parent].velocityChange;
        store(above, load(above) + push);
        const V3 childOff = axesOf(child) * all(constants.childAnchor) - load(joint.childArm);
        const V3 parentOff = axesOf(parent) * all(constants.parentAnchor) - load(joint.parentArm);
        const V3 childTurn = load(child.inverseInertia) * cross(childOff, push);
        const V3 parentTurn = load(parent.inverseInertia) * cross(parentOff, push);
        store(child.steadyAngular, load(child.steadyAngular) + childTurn * share);
        store(parent.steadyAngular, load(parent.steadyAngular) - parentTurn * share);
    }
}

// Contacts within a doll that were pressed again as often as they may be, and were wrong together to the last, leave it
// with energy from nowhere. It keeps what it had: slower all over where something holds it, else about its centre.
static void limitEnergy(const BatchView& batch) {
    const F zero = all(0.0F);
    const F given = load(*batch.energy) + workOfDrags(batch);
    const F has = keptEnergy(batch);
    const Mask own = answersItself(batch) & (load(*batch.struck) <= zero);
    const Mask gains = own & gainsOver(has, given);
    if (bits(gains) == 0 || batch.motors != nullptr || batch.targets != nullptr) return;
    V3 momentum{zero, zero, zero};
    F mass = zero;
    for (int b = 0; b < batch.bodyCount; ++b) {
        mass = mass + all(batch.bodyConstants[b].mass);
        momentum = momentum + load(batch.bodies[b].steadyVelocity) * all(batch.bodyConstants[b].mass);
    }
    const V3 centre = momentum * (all(1.0F) / mass);
    const Mask free = unheld(batch);
    const V3 kept{free ? centre.x : zero, free ? centre.y : zero, free ? centre.z : zero};
    const F whole = all(0.5F) * mass * dot(kept, kept);
    const F share = squareRoot(most(given - whole, zero) / most(has - whole, all(1e-6F)));
    const F factor = gains ? least(share, all(1.0F)) : all(1.0F);
    for (int b = 0; b < batch.bodyCount; ++b) {
        BodyLanes& body = batch.bodies[b];
        const V3 velocity = load(body.steadyVelocity);
        store(body.steadyVelocity, choose(gains, kept + (velocity - kept) * factor, velocity));
        store(body.steadyAngular, load(body.steadyAngular) * factor);
        body.velocity = body.steadyVelocity;
        body.angular = body.steadyAngular;
    }
    showMotions(batch);
}

static void advance(const BatchView& batch, const SubstepParams& params) {
    if (batch.jointCount > 0) keepMomentum(batch);
    for (int b = 0; b < batch.bodyCount; ++b)
        advanceBody(batch.bodies[b], batch.bodyConstants[b], all(params.dt));
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
