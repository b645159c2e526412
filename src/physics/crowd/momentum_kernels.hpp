#pragma once

/// The end of a substep: the bodies' new positions, and what a doll in free flight keeps.

#include "physics/crowd/tree_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

// The lanes in which nothing holds the doll that the solver of joints took into account: no static contact, no drag, no
// target. Nor does another doll press it.
static Mask unheld(const BatchView& batch) {
    Mask held = load(*batch.struck) >= all(Struck::byDoll);
    // A contact may pull by less than its tolerance, or rub by what is left of a blow.
    for (int i = 0; i < batch.contactCount; ++i) {
        const StaticContactLanes& contact = batch.contacts[i];
        if (contact.engaged == 0) continue;
        const V3 friction = load(contact.frictionImpulse);
        const V3 roll = load(contact.rollImpulse);
        held |= (load(contact.normalImpulse) != all(0.0F)) | (dot(friction, friction) + dot(roll, roll) > all(0.0F));
    }
    for (int i = 0; i < batch.dragCount; ++i)
        held |= load(batch.drags[i].weight) > all(0.0F);
    for (int b = 0; batch.targets != nullptr && b < batch.bodyCount; ++b)
        held |= load(batch.targets[b].weight) > all(0.0F);
    return ~held;
}

// Rows that only hold leave a doll that nothing strikes with energy from nowhere where contacts within it were pressed
// again as often as they may be, and were wrong together to the last, and where a blow of tens of kilonewtons goes
// through joints whose arms turn within the substep. It keeps what it had: slower all over where something holds it,
// else about its centre.
static void limitEnergy(const BatchView& batch) {
    if (batch.motors != nullptr || batch.targets != nullptr) return;
    const F zero = all(0.0F);
    const Mask alone = load(*batch.struck) <= zero;
    if (bits(alone) == 0) return;
    const F given = load(*batch.energy) + workOfDrags(batch);
    const F has = keptEnergy(batch);
    const Mask gains = alone & gainsOver(has, given);
    if (bits(gains) == 0) return;
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

// The lanes in which nothing within the doll takes energy either: no joint rubs or is at its stop, no bodies touch.
LUTKA_LANES Mask takesNothing(const BatchView& batch) {
    const F zero = all(0.0F);
    if (batch.pairedCount > 0) return noLanes();
    Mask takes = noLanes();
    for (int j = 0; j < batch.jointCount; ++j) {
        const JointLanes& joint = batch.joints[j];
        const V3 friction = load(joint.frictionImpulse);
        takes |= dot(friction, friction) > zero;
        for (int i = 0; i < kLimitRows; ++i)
            if (joint.limitActive[i] != 0) takes |= load(joint.limit[i].gain) > zero;
    }
    return ~takes;
}

// A doll in free flight has the angular momentum that it began the substep with, and no more energy. The solver pushes
// at the arms of the substep's middle, so that the anchors meet at its end, while the bodies' centres are still where
// the substep began; together that is a torque from nowhere, and cost a tumbling doll 4 % of its angular momentum a
// second. A doll's motion about its centre is the sum of a rigid body's, which has all of the angular momentum, and one
// within the doll, which has none. Their energies add up (Koenig), and the joints hold in both. So the first is made
// what the momentum asks, and the second is scaled to what is left of the energy. (Simo and Tarnow 1992 build both into
// the integrator; here they are restored after it.)
static void keepFlight(const BatchView& batch, Mask free) {
    const F zero = all(0.0F);
    const F one = all(1.0F);
    const WholeMotion whole = wholeMotion(batch, &BodyLanes::velocity, &BodyLanes::angular);
    const Symmetric inverseInertia = inverse(whole.inertia);
    const V3 momentum = load(batch.flight->angularMomentum);
    const V3 rateNow = inverseInertia * whole.angularMomentum;
    const V3 rate = inverseInertia * momentum;
    F factor = one;
    if (batch.motors == nullptr) {
        constexpr float kLeastSpeed2 = 1e-6F;  // (m/s)²: where there is less within, there is nothing to scale
        const F within = whole.energy - all(0.5F) * dot(rateNow, whole.angularMomentum);
        const F left = load(batch.flight->energy) - all(0.5F) * dot(rate, momentum);
        const F moves = whole.mass * all(kLeastSpeed2);
        const F share = squareRoot(most(left, zero) / most(within, moves));
        const F gain = left - within;
        const Mask gains = (gain > zero) & ~takesNothing(batch);
        factor = (within > moves) & ~gains ? share : one;
    }
    const V3 origin = load(batch.bodies[0].position) + whole.centre;
    const V3 drift = load(batch.bodies[0].velocity) + whole.velocity;
    for (int b = 0; b < batch.bodyCount; ++b) {
        BodyLanes& body = batch.bodies[b];
        const V3 arm = load(body.position) - origin;
        const V3 velocity = load(body.velocity);
        const V3 angular = load(body.angular);
        const V3 inner = velocity - drift - cross(rateNow, arm);
        store(body.velocity, choose(free, drift + cross(rate, arm) + inner * factor, velocity));
        store(body.angular, choose(free, rate + (angular - rateNow) * factor, angular));
    }
}

static void advance(const BatchView& batch, const SubstepParams& params) {
    const Mask free = batch.jointCount > 0 ? unheld(batch) : noLanes();
    for (int b = 0; b < batch.bodyCount; ++b)
        advanceBody(batch.bodies[b], batch.bodyConstants[b], all(params.dt));
    const Mask alone = free & (load(*batch.struck) <= all(0.0F));
    if (bits(alone) != 0) keepFlight(batch, alone);
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
