#pragma once

/// Rows of the contacts with static half spaces: one a lane, of the same body in all lanes. They are solved with the
/// joints (tree_kernels.hpp).

#include "physics/crowd/joint_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

constexpr float kMendReach = 3.0F;  // m/s that mending moves a point with at most

// The speed that a contact's row asks to be added to the normal speed: room to close, or overlap to mend.
LUTKA_LANES F contactBias(F separation, const SubstepParams& params, int useBias) {
    const F zero = all(0.0F);
    const F closing = separation * all(params.inverseDt);  // may come as near as touching
    const F overlap = least(separation + all(params.slop), zero);
    const F push = useBias != 0 ? most(overlap * all(params.contactRate), all(-params.pushSpeed)) : zero;
    return separation > zero ? closing : push;
}

struct Tangents {
    F first, second;
};
// Cuts a friction impulse back to the circle of radius `limit`.
LUTKA_LANES Tangents insideCircle(F first, F second, F limit) {
    const F size = squareRoot(first * first + second * second);
    const F scale = size > limit ? limit / most(size, all(1e-20F)) : all(1.0F);
    return {first * scale, second * scale};
}

// What a push of one along a unit vector at an arm changes the speed of that point by: along the normal, and the mean
// of two directions across it.
struct Compliance {
    F along, across;
};
LUTKA_LANES Compliance complianceAt(F inverseMass, const Symmetric& inertia, const V3& arm, const V3& normal) {
    // arm × (inertia · (direction × arm)) is a symmetric matrix times the direction; its trace is the sum over three.
    const V3 lever = cross(arm, normal);
    const F along = dot(lever, inertia * lever);
    const V3 square{arm.x * arm.x, arm.y * arm.y, arm.z * arm.z};
    const F trace = inertia.xx * (square.y + square.z) + inertia.yy * (square.x + square.z) +
                    inertia.zz * (square.x + square.y) -
                    all(2.0F) * (inertia.xy * arm.x * arm.y + inertia.xz * arm.x * arm.z + inertia.yz * arm.y * arm.z);
    return {inverseMass + along, inverseMass + most(trace - along, all(0.0F)) * all(0.5F)};
}

// Once a step, or when a contact comes near: the masses change little within one.
LUTKA_LANES void weighContact(StaticContactLanes& contact, const BatchView& batch, const V3& arm,
                              const SubstepParams& params) {
    const Symmetric inertia = load(batch.bodies[contact.body].inverseInertia);
    const Compliance compliance =
        complianceAt(all(batch.bodyConstants[contact.body].inverseMass), inertia, arm, load(contact.normal));
    store(contact.normalMass, all(1.0F) / compliance.along);
    store(contact.tangentWeight, all(params.grip) / compliance.across);
    store(contact.rollWeight, all(params.grip) / most(most(inertia.xx, inertia.yy), inertia.zz));
}

LUTKA_LANES V3 armOf(const StaticContactLanes& contact, const BodyLanes& body, const V3& core) {
    return halfWay(body, core) - load(contact.normal) * load(contact.radius);
}

// The lanes in which contacts within the doll were pressed again, and no other doll presses (a prop may: Struck).
LUTKA_LANES Mask answersItself(const BatchView& batch) {
    return load(*batch.answered) > load(*batch.struck);
}

LUTKA_LANES void beginStatic(StaticContactLanes& contact, const BatchView& batch, const SubstepParams& params) {
    const BodyLanes& body = batch.bodies[contact.body];
    const F zero = all(0.0F);
    const V3 normal = load(contact.normal);
    const F radius = load(contact.radius);
    const V3 core = axesOf(body) * load(contact.localPoint);
    const F separation = dot(normal, load(body.position) + core) - load(contact.offset) - radius;
    const F impulse = most(load(contact.normalImpulse), zero);
    const F bias = contactBias(separation, params, 1);
    // What is too far off to be met in this substep is left out.
    const V3 angular = load(body.angular);
    const F approach = dot(normal, load(body.velocity) + cross(angular, core));
    const bool wasNear = contact.near != 0;
    contact.near = bits((impulse > zero) | (approach + bias < all(params.nearSpeed))) != 0 ? 1 : 0;
    contact.engaged = 0;
    store(contact.normalGain, zero);
    store(contact.bias, bias);
    if (contact.near == 0) return;
    const V3 arm = armOf(contact, body, core);
    store(contact.arm, arm);
    store(contact.normalImpulse, impulse);
    // What a blow pressed with, answer by answer, is no load, and friction of its size would drive the doll on.
    const V3 rubbed = across(load(contact.frictionImpulse), normal);
    store(contact.frictionImpulse, choose(answersItself(batch), V3{zero, zero, zero}, rubbed));
    if (params.warmStart != 0 || !wasNear) weighContact(contact, batch, arm, params);
    const Mask coming = (separation > zero) & (impulse <= zero);
    store(contact.normalWeight,
          load(contact.normalMass) * (coming ? all(params.firstTouch) : all(params.contactStiffness)));
}

// Whether a contact that was left out when the substep began, since nothing would speed a body up by so much, is met
// after all. `speed`: of any point of the body.
LUTKA_LANES Mask meetsFar(const StaticContactLanes& contact, const BodyLanes& body, const F& speed) {
    const F bias = load(contact.bias);
    if (bits(bias < speed) == 0) return noLanes();
    const V3 core = axesOf(body) * load(contact.localPoint);
    const F approach = dot(load(contact.normal), load(body.velocity) + cross(load(body.angular), core));
    return approach + bias < all(0.0F);
}

LUTKA_LANES Mask meetsFarOnes(const BatchView& batch, int index, const F& speed) {
    Mask meets = noLanes();
    for (int i = batch.firstContact[index]; i < batch.firstContact[index + 1]; ++i) {
        if (batch.contacts[i].near == 0) meets |= meetsFar(batch.contacts[i], batch.bodies[index], speed);
    }
    return meets;
}

// Takes in a contact that was left out.
LUTKA_LANES void bringNear(StaticContactLanes& contact, const BatchView& batch, const SubstepParams& params) {
    const BodyLanes& body = batch.bodies[contact.body];
    const V3 arm = armOf(contact, body, axesOf(body) * load(contact.localPoint));
    contact.near = 1;
    store(contact.arm, arm);
    weighContact(contact, batch, arm, params);
    store(contact.normalWeight, load(contact.normalMass) * all(params.contactStiffness));
}

static int outruns(const BatchView& batch, const SubstepParams& params) {
    Mask outrun = noLanes();
    for (int b = 0; b < batch.bodyCount; ++b) {
        const F speed = speedBound(batch.bodies[b], batch.bodyConstants[b]);
        outrun |= load(batch.bodies[b].room) < (speed + all(kMendReach)) * all(params.dt);
        outrun |= meetsFarOnes(batch, b, speed);
    }
    return bits(outrun) != 0 ? 1 : 0;
}

// What each body rests on: the static contact that presses most, or what is left of other bodies (passSupport).
LUTKA_LANES void findSupports(const BatchView& batch, const SubstepParams& params) {
    for (int b = 0; b < batch.bodyCount; ++b) {
        V3 support = load(batch.bodies[b].support) * all(params.supportKept);
        F strongest = all(0.0F);
        for (int i = batch.firstContact[b]; i < batch.firstContact[b + 1]; ++i) {
            const StaticContactLanes& contact = batch.contacts[i];
            if (contact.near == 0) continue;
            const F impulse = load(contact.normalImpulse);
            support = choose(impulse > strongest, load(contact.normal), support);
            strongest = most(strongest, impulse);
        }
        store(batch.bodies[b].support, support);
    }
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
