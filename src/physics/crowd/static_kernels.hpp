#pragma once

/// Rows of the contacts with static half spaces: one a lane, of the same body in all lanes. They are solved with the
/// joints (tree_kernels.hpp).

#include "physics/crowd/joint_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_CROWD_KERNELS {

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

LUTKA_LANES F massAlong(F inverseMass, const Symmetric& inertia, const V3& arm, const V3& direction) {
    const V3 lever = cross(arm, direction);
    return all(1.0F) / (inverseMass + dot(lever, inertia * lever));
}

LUTKA_LANES void beginStatic(StaticContactLanes& contact, const BatchView& batch, const SubstepParams& params) {
    const BodyLanes& body = batch.bodies[contact.body];
    const F inverseMass = all(batch.bodyConstants[contact.body].inverseMass);
    const Symmetric inertia = load(body.inverseInertia);
    const V3 normal = load(contact.normal);
    const F radius = load(contact.radius);
    const V3 core = axesOf(body) * load(contact.localPoint);
    const V3 arm = core - normal * radius;
    store(contact.arm, arm);
    store(contact.separation, dot(normal, load(body.position) + core) - load(contact.offset) - radius);
    if (params.warmStart != 0) {
        V3 t1, t2;
        tangentsOf(normal, t1, t2);
        store(contact.tangent[0], t1);
        store(contact.tangent[1], t2);
        const V3 kept = load(contact.frictionImpulse);
        store(contact.tangentImpulse[0], dot(kept, t1));
        store(contact.tangentImpulse[1], dot(kept, t2));
    }
    const V3 t1 = load(contact.tangent[0]);
    const V3 t2 = load(contact.tangent[1]);
    const F carried = most(load(contact.normalImpulse), all(0.0F));
    const Mask coming = (load(contact.separation) > all(0.0F)) & (carried <= all(0.0F));
    const F stiffness = coming ? all(params.firstTouch) : all(params.contactStiffness);
    store(contact.normalWeight, massAlong(inverseMass, inertia, arm, normal) * stiffness);
    const F grip = least(massAlong(inverseMass, inertia, arm, t1), massAlong(inverseMass, inertia, arm, t2));
    store(contact.tangentWeight, grip * all(params.grip));
    store(contact.rollWeight, all(params.grip) / most(most(inertia.xx, inertia.yy), inertia.zz));
    store(contact.normalImpulse, carried);
}

}  // namespace lutka::physics::crowd::LUTKA_CROWD_KERNELS
