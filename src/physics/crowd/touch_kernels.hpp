#pragma once

/// Kernels of the search for contacts between two bodies: eight pairs of capsules or spheres at a time.

#include "physics/crowd/body_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

// Eight bodies, one a lane: a segment with a radius around it, and how it moves.
struct Cores {
    V3 centre, half, velocity;
    F halfLength, radius, swing;
};

LUTKA_LANES F clampedUnit(const F& value) {
    return clampLanes(value, all(0.0F), all(1.0F));
}

// Where two segments are nearest: how far along each from its start, the way from B's point to A's.
struct NearestPoints {
    F s, t;  // 0 to 1
    V3 normal;
    F distance;
};

// Ericson, Real-Time Collision Detection, 5.1.9, on all lanes; a sphere is a segment of no length.
LUTKA_LANES NearestPoints nearestPoints(const V3& centreA, const V3& halfA, const V3& centreB, const V3& halfB) {
    const F zero = all(0.0F), one = all(1.0F), two = all(2.0F), tiny = all(1e-10F);
    const V3 da = halfA * two;
    const V3 db = halfB * two;
    const V3 r = (centreA - halfA) - (centreB - halfB);
    const F aa = dot(da, da), bb = dot(db, db), ab = dot(da, db);
    const F aR = dot(da, r), bR = dot(db, r);
    const F perA = one / most(aa, tiny), perB = one / most(bb, tiny);
    const F denominator = aa * bb - ab * ab;
    // Of parallel segments any pair in the overlap will do.
    const F crossing = (ab * bR - aR * bb) / most(denominator, tiny * tiny);
    const F first = clampedUnit(denominator > all(1e-6F) * aa * bb ? crossing : -aR * perA);
    const F free = (ab * first + bR) * perB;
    const F t = clampedUnit(free);
    const F s = free < zero ? clampedUnit(-aR * perA) : (free > one ? clampedUnit((ab - aR) * perA) : first);

    const V3 between = r + da * s - db * t;
    const F distance = squareRoot(dot(between, between));
    const Mask apart = distance > all(1e-6F);
    const F scale = one / most(distance, all(1e-6F));
    if (bits(~apart) == 0) return {s, t, between * scale, distance};
    // Where the cores cross: apart along what is across both, or anything.
    const V3 crossed = cross(da, db);
    const F across2 = dot(crossed, crossed);
    const F perAcross = one / squareRoot(most(across2, tiny * tiny));
    const Mask skew = across2 > all(1e-6F) * aa * bb;
    const V3 other{skew ? crossed.x * perAcross : zero, skew ? crossed.y * perAcross : one,
                   skew ? crossed.z * perAcross : zero};
    return {s, t, choose(apart, between * scale, other), distance};
}

LUTKA_LANES unsigned touch(const Cores& a, const Cores& b, const TouchRange& range, CoreTouchLanes& out) {
    const F one = all(1.0F), two = all(2.0F);
    const NearestPoints at = nearestPoints(a.centre, a.half, b.centre, b.half);
    const F radius = a.radius + b.radius;
    const V3 relative = a.velocity - b.velocity;
    const F closing = most(-dot(at.normal, relative), all(0.0F));
    const F linear = closing + (squareRoot(dot(relative, relative)) - closing) * all(range.sideways);
    const F speed = linear + (a.swing + b.swing);
    store(out.normal, at.normal);
    store(out.alongA, (two * at.s - one) * a.halfLength);
    store(out.alongB, (two * at.t - one) * b.halfLength);
    store(out.radius, radius);
    store(out.separation, at.distance - radius);
    return bits(at.distance - radius < all(range.margin) + speed * all(range.seconds));
}

LUTKA_LANES Cores coresOf(const StepBody* const (&bodies)[kLanes]) {
    F place[kLanes];
    F motion[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
        place[lane] = *reinterpret_cast<const F*>(bodies[lane]->centre);
        motion[lane] = *reinterpret_cast<const F*>(bodies[lane]->velocity);
    }
    transpose(place);
    transpose(motion);
    return {{place[0], place[1], place[2]},
            {place[4], place[5], place[6]},
            {motion[0], motion[1], motion[2]},
            motion[3],
            place[3],
            place[7]};
}

static unsigned touchCores(const StepBody* const (&a)[kLanes], const StepBody* const (&b)[kLanes],
                           const TouchRange& range, CoreTouchLanes& out) {
    return touch(coresOf(a), coresOf(b), range, out);
}

LUTKA_LANES Cores coresOf(const BatchView& batch, int index) {
    const BodyLanes& body = batch.bodies[index];
    const BodyConstants& constants = batch.bodyConstants[index];
    const V3 turn = load(body.angular);
    const F halfLength = all(constants.extent[1]);
    return {load(body.position), load(body.axisY) * halfLength, load(body.velocity),
            halfLength,          all(constants.radius),         squareRoot(dot(turn, turn)) * all(constants.reach)};
}

static unsigned touchOwnCores(const BatchView& batch, const SelfPair& pair, const TouchRange& range,
                              CoreTouchLanes& out) {
    return touch(coresOf(batch, pair.a), coresOf(batch, pair.b), range, out);
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
