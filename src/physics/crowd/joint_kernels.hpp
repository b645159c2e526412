#pragma once

/// Preparation of the constraints for a substep: arms, errors, axes and limits. tree_kernels.hpp solves them.

#include "physics/crowd/body_kernels.hpp"
#include "physics/crowd/spatial.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

// `near`: rows farther from their limit than this are left out of the substep.
LUTKA_LANES Mask prepareLimit(JointLanes& joint, int index, const Symmetric& k, const V3& axis, F room, F side, F near,
                              const SubstepParams& params) {
    LimitRow& row = joint.limit[index];
    const F zero = all(0.0F);
    const Mask met = room < near;
    joint.limitActive[index] = bits(met) != 0 ? 1 : 0;
    if (joint.limitActive[index] == 0) {
        store(row.impulse, zero);
        return noLanes();
    }
    const F along = dot(axis, k * axis);
    store(row.axis, axis);
    const F mend = most(room * all(params.limitRate), all(-params.limitSpeed));
    store(row.bias, room > zero ? room * all(params.inverseDt) : mend);  // may turn as far as the limit
    const Mask kept = (side == load(joint.side[index])) & met;
    const F impulse = kept ? most(load(row.impulse), zero) : zero;
    store(row.impulse, impulse);
    store(row.gain, zero);
    const F scale = ((room > zero) & (impulse <= zero)) ? all(params.firstTouch) : all(params.limitStiffness);
    store(row.weight, along > all(1e-9F) ? scale / along : zero);
    store(joint.side[index], side);
    return room < all(-params.mendAngle);
}

// What the rows of a joint are prepared from.
struct JointSetting {
    Symmetric k;  ///< Sum of both inverse inertias.
    Axes frame;   ///< The parent's frame in the world.
    Q relative;   ///< The child's frame in the parent's.
    F near;
};

// All of its rotation is an error.
LUTKA_LANES Mask prepareLocked(JointLanes& joint, const JointSetting& setting, const SubstepParams& params) {
    const F zero = all(0.0F);
    const Axes& frame = setting.frame;
    const Q& relative = setting.relative;
    HingeRows& rows = joint.hinge;
    store(rows.axis, V3{zero, zero, zero});
    const F twice = relative.w < zero ? all(-2.0F) : all(2.0F);
    const V3 error = frame * V3{relative.x * twice, relative.y * twice, relative.z * twice};
    const F size = squareRoot(dot(error, error));
    store(rows.bias, error * least(all(params.jointRate), all(params.limitSpeed) / most(size, all(1e-6F))));
    const F easiest = least(least(dot(frame.x, setting.k * frame.x), dot(frame.y, setting.k * frame.y)),
                            dot(frame.z, setting.k * frame.z));
    store(rows.weight, all(params.jointStiffness) / easiest);
    for (int& active : joint.limitActive)
        active = 0;
    return size > all(params.mendAngle);
}

LUTKA_LANES Mask prepareHinge(JointLanes& joint, const JointConstants& constants, const JointSetting& setting,
                              const SubstepParams& params) {
    const F two = all(2.0F);
    const Axes& frame = setting.frame;
    const Q& relative = setting.relative;
    HingeRows& rows = joint.hinge;
    store(rows.axis, frame.z);
    // The child's z in the parent's frame; its cross product with z is the rotation that is too much.
    const F rate = all(params.jointRate);
    const F errorX = -two * (relative.y * relative.z - relative.w * relative.x);
    const F errorY = two * (relative.x * relative.z + relative.w * relative.y);
    store(rows.bias, frame.x * (errorX * rate) + frame.y * (errorY * rate));
    const F least2 = least(dot(frame.x, setting.k * frame.x), dot(frame.y, setting.k * frame.y));
    store(rows.weight, all(params.jointStiffness) / least2);
    store(rows.impulse, across(load(rows.impulse), frame.z));
    store(joint.frictionWeight, all(params.grip) / dot(frame.z, setting.k * frame.z));

    const F flip = relative.w < all(0.0F) ? all(-1.0F) : all(1.0F);
    const F angle = two * angleOf(relative.z * flip, relative.w * flip);
    const F past = angle - all(0.5F * (constants.limit[0] + constants.limit[1]));
    const F side = past < all(0.0F) ? all(-1.0F) : all(1.0F);
    const F room = all(0.5F * (constants.limit[1] - constants.limit[0])) - magnitude(past);
    return prepareLimit(joint, 0, setting.k, frame.z * -side, room, side, setting.near, params);
}

// Swing: with the swing's rotation vector s = angle · u (in the frame's y, z plane) and d = u × x the direction that
// frame x leans to, its rate along a direction n of that plane is
//     n · ds/dt = w · [ (n·u) u + (n·d) (angle · cot(angle) · d - angle · x) ]
// for the relative angular velocity w, in the parent's frame. n is the outward normal of the ellipse.
// Twist: its rate is w · (x + x') / (1 + x·x') with x' the child's x.
LUTKA_LANES Mask prepareCone(JointLanes& joint, const JointConstants& constants, const JointSetting& setting,
                             const SubstepParams& params) {
    const Axes& frame = setting.frame;
    const Q& given = setting.relative;
    const F zero = all(0.0F), one = all(1.0F), two = all(2.0F), tiny = all(1e-12F);
    const F flip = given.w < zero ? -one : one;
    const Q q{given.x * flip, given.y * flip, given.z * flip, given.w * flip};
    // q = swing · twist: the twist is (w, x) made a unit, and the swing (y, z) turned by it, which keeps its length.
    const F cosHalf = squareRoot(q.w * q.w + q.x * q.x);
    const F sinHalf = squareRoot(q.y * q.y + q.z * q.z);
    const F perCos = one / most(cosHalf, all(1e-6F));
    const F perSin = one / most(sinHalf, tiny);
    const F angle = two * angleOf(sinHalf, cosHalf);
    const F unit = perCos * perSin;
    const F uy = (q.y * q.w - q.z * q.x) * unit;
    const F uz = (q.z * q.w + q.y * q.x) * unit;

    const F gy = uy * all(1.0F / (constants.limit[0] * constants.limit[0]));
    const F gz = uz * all(1.0F / (constants.limit[1] * constants.limit[1]));
    const F rate = squareRoot(most(uy * gy + uz * gz, tiny));  // of rho along u
    const F slope = squareRoot(most(gy * gy + gz * gz, tiny));
    const F perSlope = one / slope;
    const F ny = gy * perSlope;
    const F nz = gz * perSlope;
    const F flat = rate * perSlope;  // one over the length of the gradient of rho
    const F along = ny * uy + nz * uz;
    const F sideways = ny * uz - nz * uy;
    const F cosine = one - two * sinHalf * sinHalf;
    const F bent = two * sinHalf * cosHalf > all(1e-4F) ? angle * cosine * (all(0.5F) * unit) : one;  // angle · cot
    const V3 inFrame{-sideways * angle, along * uy + sideways * bent * uz, along * uz - sideways * bent * uy};
    Mask off =
        prepareLimit(joint, 0, setting.k, frame * -inFrame, (one - angle * rate) * flat, one, setting.near, params);
    if (constants.longAxis >= 0) {
        // Past the tip the ellipse's normal turns quickly towards the short axis, where a little to and fro satisfies
        // its row while the swing runs on along the long one: that has a row of its own.
        const bool isY = constants.longAxis == 0;
        const F reached = angle * (isY ? uy : uz);
        const F end = reached < zero ? -one : one;
        const F n_u = isY ? uy : uz;
        const F n_d = isY ? uz : -uy;
        const V3 rising{-n_d * angle, n_u * uy + n_d * bent * uz, n_u * uz - n_d * bent * uy};
        const F left = all(constants.limit[isY ? 0 : 1]) - magnitude(reached);
        off |= prepareLimit(joint, 2, setting.k, frame * (rising * -end), left, end, setting.near, params);
    }

    const F twist = two * angleOf(q.x, q.w);
    const F side = twist < zero ? -one : one;
    const V3 childX{one - two * (q.y * q.y + q.z * q.z), two * (q.x * q.y + q.w * q.z), two * (q.x * q.z - q.w * q.y)};
    const F spread = -side / most(one + childX.x, all(0.05F));
    const V3 twistAxis{(one + childX.x) * spread, childX.y * spread, childX.z * spread};
    const F room = all(constants.limit[2]) - magnitude(twist);
    // One weight for all directions: that of the one that turns most easily.
    store(joint.frictionWeight, all(params.grip) / most(most(setting.k.xx, setting.k.yy), setting.k.zz));
    return off | prepareLimit(joint, 1, setting.k, frame * twistAxis, room, side, setting.near, params);
}

// The anchors' arms half way through the substep, as the bodies' aims foresee them. Returns the anchors' distance.
LUTKA_LANES V3 aimJoint(JointLanes& joint, const JointConstants& constants, const BodyLanes& parent,
                        const BodyLanes& child, const SubstepParams& params) {
    const V3 parentArm = axesOf(parent) * all(constants.parentAnchor);
    const V3 childArm = axesOf(child) * all(constants.childAnchor);
    const V3 error = (load(child.position) - load(parent.position)) + (childArm - parentArm);
    const V3 parentMiddle = halfWay(parent, parentArm);
    const V3 childMiddle = halfWay(child, childArm);
    store(joint.parentArm, parentMiddle);
    store(joint.childArm, childMiddle);
    store(joint.drift, cross(load(child.spin), childMiddle) - cross(load(parent.spin), parentMiddle));
    store(joint.bias, error * all(params.jointRate));
    return error;
}

LUTKA_LANES void beginJoint(JointLanes& joint, const JointConstants& constants, const BodyLanes& parent,
                            const BodyLanes& child, const SubstepParams& params) {
    const V3 error = aimJoint(joint, constants, parent, child, params);
    const Q parentFrame = load(parent.rotation) * allTurns(constants.parentFrame);
    const V3 turning = load(child.angular) - load(parent.angular);
    const F rate = squareRoot(dot(turning, turning));
    // Static friction is greater than sliding friction (Stribeck): limbs do not swing on for ever.
    const F still = most(all(1.0F) - rate * all(1.0F / params.stictionRate), all(0.0F));
    store(joint.frictionLimit, all(constants.frictionNm * params.dt) * (all(1.0F) + all(params.jointStiction) * still));
    const JointSetting setting{load(parent.inverseInertia) + load(child.inverseInertia), axesOf(parentFrame),
                               conjugate(parentFrame) * (load(child.rotation) * allTurns(constants.childFrame)),
                               all(0.1F) + rate * all(2.0F * params.dt)};
    const Mask off = constants.isLocked != 0  ? prepareLocked(joint, setting, params)
                     : constants.isHinge != 0 ? prepareHinge(joint, constants, setting, params)
                                              : prepareCone(joint, constants, setting, params);
    joint.mends = bits(off | (dot(error, error) > all(params.mendGap * params.mendGap))) != 0 ? 1 : 0;
}

static void beginJoints(const BatchView& batch, const SubstepParams& params) {
    for (int j = 0; j < batch.jointCount; ++j) {
        const JointConstants& constants = batch.jointConstants[j];
        beginJoint(batch.joints[j], constants, batch.bodies[constants.parent], batch.bodies[constants.child], params);
    }
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
