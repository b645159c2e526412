#pragma once

/// Kernels of the contacts between two bodies: eight contacts of any dolls at a time, gathered and scattered. Friction
/// comes before the normal row, so that overlap has the last word; both tangents are solved at once and share one
/// circular bound.

#include "physics/crowd/contact_rules.hpp"
#include "physics/crowd/pair_body_kernels.hpp"
#include "physics/crowd/touch_kernels.hpp"
#include "physics/crowd/tree_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

LUTKA_LANES Symmetric inverseInertiaOf(const PairBodies& bodies, Indices index) {
    return symmetricOf(readRows(bodies.frames, index, kInertiaRow));
}
LUTKA_LANES V3 supportOf(const PairBodies& bodies, Indices index) {
    return first3(readRows(bodies.frames, index, kSupportRow));
}
// From the centre to a point of the core.
LUTKA_LANES V3 coreOf(const PairBodies& bodies, Indices index, const V3& axisY, const V3& local, int onAxisY) {
    if (onAxisY != 0) return axisY * local.y;
    const V3 axisX = second3(readRows(bodies.frames, index, kSupportRow));
    return axisX * local.x + axisY * local.y + cross(axisX, axisY) * local.z;
}

struct PairVelocities {
    V3 velocityA, angularA, velocityB, angularB;
};
LUTKA_LANES PairVelocities velocitiesOf(const PairContactLanes& pair, const PairBodies& bodies) {
    const Columns a = readRows(bodies.motions, pair.bodyA, 0);
    const Columns b = readRows(bodies.motions, pair.bodyB, 0);
    return {first3(a), second3(a), first3(b), second3(b)};
}
LUTKA_LANES void storeVelocities(const PairContactLanes& pair, const PairBodies& bodies, const PairVelocities& v) {
    writeRows(bodies.motions, pair.bodyA, 0, columnsOf(v.velocityA, v.angularA));
    writeRows(bodies.motions, pair.bodyB, 0, columnsOf(v.velocityB, v.angularB));
}
// Puts velocities into rows that were read before, with a note in one more column, of which the largest stays.
LUTKA_LANES void writeNoted(const PairBodies& bodies, Indices index, int column, const Columns& before,
                            const V3& velocity, const V3& angular, F note) {
    Columns row = columnsOf(velocity, angular);
    row.column[column] = most(note, before.column[column]);
    writeRows(bodies.motions, index, 0, row);
}
// An impulse of size `size` along the normal, without what supports hold against.
LUTKA_LANES void pressPair(const PairContactLanes& pair, PairVelocities& v, F size) {
    v.velocityA = v.velocityA + load(pair.pushA) * (size * load(pair.inverseMassA));
    v.velocityB = v.velocityB - load(pair.pushB) * (size * load(pair.inverseMassB));
    v.angularA = v.angularA + load(pair.turnA) * size;
    v.angularB = v.angularB - load(pair.turnB) * size;
}
// An impulse of size `size` on A along tangent `index`.
LUTKA_LANES void rubPair(const PairContactLanes& pair, PairVelocities& v, int index, const V3& direction, F size) {
    v.velocityA = v.velocityA + direction * (size * load(pair.inverseMassA));
    v.velocityB = v.velocityB - direction * (size * load(pair.inverseMassB));
    v.angularA = v.angularA + load(pair.rubA[index]) * size;
    v.angularB = v.angularB - load(pair.rubB[index]) * size;
}
LUTKA_LANES V3 slidingAt(const V3& armA, const V3& armB, const PairVelocities& v) {
    return v.velocityA + cross(v.angularA, armA) - (v.velocityB + cross(v.angularB, armB));
}
LUTKA_LANES V3 slidingOf(const PairContactLanes& pair, const PairVelocities& v) {
    return slidingAt(load(pair.armA), load(pair.armB), v);
}

// What is left of a push along `direction` where a support holds against it.
LUTKA_LANES V3 leftOf(const V3& direction, const V3& support) {
    const F firmness = squareRoot(dot(support, support));
    const F into = least(dot(direction, support), all(0.0F));
    return direction - support * (into / most(firmness, all(1e-6F)));
}

// What a body's angular velocity gains by a push with that lever, per unit of impulse. Kinematic bodies have no inverse
// mass, and none of their inertia counts either.
LUTKA_LANES V3 turnBy(const V3& lever, const Symmetric& inverseInertia, const F& inverseMass) {
    const F zero = all(0.0F);
    return choose(inverseMass > zero, inverseInertia * lever, {zero, zero, zero});
}

LUTKA_LANES PairContactLanes& pairAt(const PairsView& view, int block) {
    return view.chunks[block / kPairChunk][block % kPairChunk];
}

// Those between dolls with joints.
LUTKA_LANES Mask strikes(const PairContactLanes& pair) {
    return load(pair.kind) == all(PairKind::dolls);
}
// Those between bodies of one limp doll,
LUTKA_LANES Mask isOwn(const PairContactLanes& pair) {
    return load(pair.kind) == all(PairKind::own);
}
// those of them that are mended together,
LUTKA_LANES Mask isWedged(const PairContactLanes& pair) {
    return load(pair.kind) == all(PairKind::wedged);
}
// and of one that has muscles.
LUTKA_LANES Mask isDriven(const PairContactLanes& pair) {
    return load(pair.kind) == all(PairKind::driven);
}
// All of these.
LUTKA_LANES Mask isOfDolls(const PairContactLanes& pair) {
    return load(pair.kind) != all(PairKind::other);
}
// The lanes that have a contact.
LUTKA_LANES Mask hasContact(const PairContactLanes& pair) {
    return load(pair.friction) > all(0.0F);
}

// What a contact presses harder by than the masses of its two bodies ask.
LUTKA_LANES F eagerness(const PairContactLanes& pair, float rate) {
    return isOfDolls(pair) ? all(rate) : all(1.0F);
}

// What a support holds back is a guess, and a push that counts on too much of it is never taken back in time: a pair
// that stands free in truth answers it with more than it was meant to stop, and so on. Hence a bound, of what the two
// bodies yield when they are free.
constexpr float kLeastYield = 0.35F;

// Directions and masses. What friction carries is turned into the new directions.
LUTKA_LANES void preparePair(PairContactLanes& pair, const PairBodies& bodies, bool isFirst) {
    V3 direction[3];
    direction[0] = load(pair.normal);
    tangentsOf(direction[0], direction[1], direction[2]);
    const V3 before = load(pair.tangent);
    const V3 kept =
        isFirst ? before
                : before * load(pair.tangentImpulse[0]) + cross(direction[0], before) * load(pair.tangentImpulse[1]);
    store(pair.tangent, direction[1]);
    store(pair.tangentImpulse[0], dot(kept, direction[1]));
    store(pair.tangentImpulse[1], dot(kept, direction[2]));
    const V3 armA = load(pair.armA);
    const V3 armB = load(pair.armB);
    const Symmetric inertiaA = inverseInertiaOf(bodies, pair.bodyA);
    const Symmetric inertiaB = inverseInertiaOf(bodies, pair.bodyB);
    const V3 pushA = leftOf(direction[0], supportOf(bodies, pair.bodyA));
    const V3 pushB = -leftOf(-direction[0], supportOf(bodies, pair.bodyB));
    store(pair.pushA, pushA);
    store(pair.pushB, pushB);
    const F massA = load(pair.inverseMassA);
    const F massB = load(pair.inverseMassB);
    const F zero = all(0.0F);
    const V3 leverA = cross(armA, direction[0]);
    const V3 leverB = cross(armB, direction[0]);
    const F free =
        massA + massB + dot(leverA, turnBy(leverA, inertiaA, massA)) + dot(leverB, turnBy(leverB, inertiaB, massB));
    const Mask moves = hasContact(pair) & (free > zero);
    const F leastYield = most(free * all(kLeastYield), all(1e-12F));
    for (int i = 0; i < 3; ++i) {
        const V3& onA = i == 0 ? pushA : direction[i];
        const V3& onB = i == 0 ? pushB : direction[i];
        const V3 turnA = turnBy(cross(armA, onA), inertiaA, massA);
        const V3 turnB = turnBy(cross(armB, onB), inertiaB, massB);
        store(i == 0 ? pair.turnA : pair.rubA[i - 1], turnA);
        store(i == 0 ? pair.turnB : pair.rubB[i - 1], turnB);
        const F k = massA * dot(onA, direction[i]) + massB * dot(onB, direction[i]) +
                    dot(cross(armA, direction[i]), turnA) + dot(cross(armB, direction[i]), turnB);
        const F mass = moves ? all(1.0F) / most(k, leastYield) : zero;
        store(i == 0 ? pair.normalMass : pair.tangentMass[i - 1], mass);
    }
}

// What was too far off to be met when the substep began may have been pushed together since.
LUTKA_LANES void makeReady(PairContactLanes& pair, const PairBodies& bodies) {
    if (pair.ready != 0) return;
    pair.ready = 1;
    preparePair(pair, bodies, false);
}

// Places a contact where its bodies are now: the touching points, how far apart the surfaces are, the arms. Both bodies
// are pushed at one point, so that no torque comes from nowhere.
struct Arms {
    V3 a, b;
};
LUTKA_LANES Arms placePair(PairContactLanes& pair, const PairBodies& bodies, bool isFirst) {
    const F radius = load(pair.radius);
    V3 coreA, coreB;
    const Columns placeA = readRows(bodies.frames, pair.bodyA, kPlaceRow);
    const Columns placeB = readRows(bodies.frames, pair.bodyB, kPlaceRow);
    const V3 between = first3(placeA) - first3(placeB);
    const V3 axisA = second3(placeA);
    const V3 axisB = second3(placeB);
    const unsigned followed = isFirst ? 0U : pair.follows;
    if (followed != kAllLanes) {
        coreA = coreOf(bodies, pair.bodyA, axisA, load(pair.localA), pair.onAxisY);
        coreB = coreOf(bodies, pair.bodyB, axisB, load(pair.localB), pair.onAxisY);
    }
    if (followed != 0) {
        const F one = all(1.0F), two = all(2.0F), zero = all(0.0F);
        const F halfA = placeA.column[kHalfColumn];
        const F halfB = placeB.column[kHalfColumn];
        const NearestPoints at = nearestPoints(between, axisA * halfA, {zero, zero, zero}, axisB * halfB);
        // Cores that have passed through each other go back where they came from.
        const V3 before = load(pair.normal);
        const Mask through = (dot(at.normal, before) < zero) & (at.distance < radius);
        const F side = through ? -one : one;
        const F alongA = (two * at.s - one) * halfA;
        const F alongB = (two * at.t - one) * halfB;
        const V3 normal = choose(hasContact(pair), at.normal * side, before);
        if (followed == kAllLanes) {
            store(pair.normal, normal);
            store(pair.localA.y, alongA);
            store(pair.localB.y, alongB);
            coreA = axisA * alongA;
            coreB = axisB * alongB;
        } else {
            const Mask follows = lanesOf(followed);
            store(pair.normal, choose(follows, normal, before));
            store(pair.localA.y, follows ? alongA : load(pair.localA.y));
            store(pair.localB.y, follows ? alongB : load(pair.localB.y));
            coreA = choose(follows, axisA * alongA, coreA);
            coreB = choose(follows, axisB * alongB, coreB);
        }
    }
    const V3 apart = between + (coreA - coreB);
    store(pair.separation, dot(load(pair.normal), apart) - radius);
    const V3 middle = apart * all(0.5F);
    return {coreA - middle, coreB + middle};
}

// What rests on something that is held is held itself, less firmly.
LUTKA_LANES void passSupport(const PairContactLanes& pair, const PairBodies& bodies, const Mask& presses,
                             const SubstepParams& params) {
    const F zero = all(0.0F);
    const V3 normal = load(pair.normal);
    const Columns rowA = readRows(bodies.frames, pair.bodyA, kSupportRow);
    const Columns rowB = readRows(bodies.frames, pair.bodyB, kSupportRow);
    const V3 a = first3(rowA);
    const V3 b = first3(rowB);
    const F firmA = -dot(normal, a) * all(params.supportPassed);
    const F firmB = dot(normal, b) * all(params.supportPassed);
    const Mask liftsA = presses & (firmB > zero) & (firmB * firmB > dot(a, a));
    const Mask liftsB = presses & (firmA > zero) & (firmA * firmA > dot(b, b)) & ~liftsA;
    if (bits(liftsA | liftsB) == 0) return;
    writeRows(bodies.frames, pair.bodyA, kSupportRow, columnsOf(choose(liftsA, normal * firmB, a), second3(rowA)));
    writeRows(bodies.frames, pair.bodyB, kSupportRow, columnsOf(choose(liftsB, -normal * firmA, b), second3(rowB)));
}

// The mass that a contact within a doll has shown: a whole limb may hang on its bodies.
LUTKA_LANES F shownMass(const PairContactLanes& pair, F pressed, const SubstepParams& params) {
    constexpr float kSlow = 0.1F;  // m/s: what comes slower shows no mass
    const F mass = load(pair.normalMass);
    return clampLanes(pressed / most(-load(pair.approach), all(kSlow)), mass, mass * all(params.ownMass));
}

static void beginPairs(PairsView& view, const SubstepParams& params) {
    const bool isFirst = params.warmStart != 0;
    const PairBodies& bodies = view.bodies;
    view.liveCount = 0;
    Mask wedges = noLanes();
    for (int i = view.first; i < view.first + view.count; ++i) {
        PairContactLanes& pair = pairAt(view, i);
        const Arms arms = placePair(pair, bodies, isFirst);
        const V3 normal = load(pair.normal);
        const F start = dot(normal, slidingAt(arms.a, arms.b, velocitiesOf(pair, bodies)));
        const F pressed = load(pair.normalImpulse);
        const F left = start + contactBias(load(pair.separation), params, 0);
        const Mask meets = (pressed > all(0.0F)) | (left < all(0.0F));
        if (bits(meets | (left < all(params.nearSpeed))) == 0) continue;  // nor did it press before
        store(pair.armA, arms.a);
        store(pair.armB, arms.b);
        view.live[view.liveCount++] = i;
        pair.answered = 0;
        pair.ready = bits(meets) != 0 ? 1 : 0;
        if (pair.ready != 0) preparePair(pair, bodies, isFirst);
        // What changed the bodies' speeds was a hit and is over; what held them against a load goes on.
        const F mass = load(pair.normalMass);
        const Mask own = isOwn(pair);
        const F steady = pressed - (own ? shownMass(pair, pressed, params) : mass) * (start - load(pair.approach));
        wedges |= own & (load(pair.separation) < all(-params.wedgeDepth));
        // What comes from the step before is no more than that already.
        const F borne =
            isFirst ? pressed : carriedLoad(load(pair.kind), pressed, load(pair.load), mass, params.ownLoad);
        // Bodies that part already bear no load either: pushing on would speed them up.
        const F held = least(most(steady, all(0.0F)), borne) * stays(start, kSlipSpeed);
        store(pair.load, held);
        store(pair.approach, start);
        store(pair.normalImpulse, held);
        store(pair.carriedNormal, held);
        const Mask presses = held > all(0.0F);
        if (bits(presses) != 0) passSupport(pair, bodies, presses, params);
        for (int k = 0; k < 2; ++k) {  // friction ends with the load
            const F share = own ? held / most(pressed, all(1e-9F)) : all(1.0F);
            const F rubbed = held > all(0.0F) ? load(pair.tangentImpulse[k]) * share : all(0.0F);
            store(pair.tangentImpulse[k], rubbed);
            store(pair.carriedTangent[k], rubbed);
        }
    }
    view.wedges = bits(wedges) != 0 ? 1 : 0;
}

// Both sides get the impulse `whole`, less what pressPair() gave each of them for a push of size `pressed`.
LUTKA_LANES void pushRest(const PairContactLanes& pair, const PairBodies& bodies, PairVelocities& v, const V3& whole,
                          F pressed) {
    const V3 toA = whole - load(pair.pushA) * pressed;
    const V3 toB = whole - load(pair.pushB) * pressed;
    const F massA = load(pair.inverseMassA);
    const F massB = load(pair.inverseMassB);
    v.velocityA = v.velocityA + toA * massA;
    v.velocityB = v.velocityB - toB * massB;
    v.angularA = v.angularA + turnBy(cross(load(pair.armA), toA), inverseInertiaOf(bodies, pair.bodyA), massA);
    v.angularB = v.angularB - turnBy(cross(load(pair.armB), toB), inverseInertiaOf(bodies, pair.bodyB), massB);
}

// Pushes with what the substep before left, and gives the supports what the sweep held back from them.
static void carryPairs(const PairsView& view) {
    const PairBodies& bodies = view.bodies;
    for (int i = 0; i < view.liveCount; ++i) {
        const PairContactLanes& pair = pairAt(view, view.live[i]);
        const F pressed = load(pair.carriedNormal);
        const F total = load(pair.normalImpulse);
        if (bits((pressed > all(0.0F)) | (total > all(0.0F))) == 0) continue;
        const Columns a = readRows(bodies.motions, pair.bodyA, 0);
        const Columns b = readRows(bodies.motions, pair.bodyB, 0);
        PairVelocities v{first3(a), second3(a), first3(b), second3(b)};
        const V3 whole = load(pair.normal) * total;
        const F swept = total - pressed;
        pushRest(pair, bodies, v, whole, swept);
        const V3 tangent = load(pair.tangent);
        rubPair(pair, v, 0, tangent, load(pair.carriedTangent[0]));
        rubPair(pair, v, 1, cross(load(pair.normal), tangent), load(pair.carriedTangent[1]));
        const F by = strikes(pair) ? all(Struck::byDoll) : (isOfDolls(pair) ? all(0.0F) : all(Struck::byProp));
        const F struck = total > all(0.0F) ? by : all(0.0F);
        writeNoted(bodies, pair.bodyA, kStruckColumn, a, v.velocityA, v.angularA, struck);
        writeNoted(bodies, pair.bodyB, kStruckColumn, b, v.velocityB, v.angularB, struck);
    }
}

static int solvePairs(const PairsView& view, const SubstepParams& params) {
    const PairBodies& bodies = view.bodies;
    Mask pressed = noLanes();
    for (int i = 0; i < view.liveCount; ++i) {
        PairContactLanes& pair = pairAt(view, view.live[i]);
        PairVelocities v = velocitiesOf(pair, bodies);
        const V3 normal = load(pair.normal);
        const V3 sliding = slidingOf(pair, v);
        const F carried = load(pair.normalImpulse);
        const F bias = contactBias(load(pair.separation), params, 0);
        if (bits((carried > all(0.0F)) | (dot(normal, sliding) + bias < all(0.0F))) == 0) continue;
        makeReady(pair, bodies);
        const V3 t1 = load(pair.tangent);
        const V3 t2 = cross(normal, t1);
        const F before1 = load(pair.tangentImpulse[0]);
        const F before2 = load(pair.tangentImpulse[1]);
        const Tangents after =
            insideCircle(before1 - load(pair.tangentMass[0]) * dot(t1, sliding),
                         before2 - load(pair.tangentMass[1]) * dot(t2, sliding), load(pair.friction) * carried);
        store(pair.tangentImpulse[0], after.first);
        store(pair.tangentImpulse[1], after.second);
        rubPair(pair, v, 0, t1, after.first - before1);
        rubPair(pair, v, 1, t2, after.second - before2);

        const F approach = dot(normal, slidingOf(pair, v));
        const F off = approach + bias;
        const F total = most(carried - load(pair.normalMass) * off, all(0.0F));
        pressed |= (total > all(0.0F)) | (carried > all(0.0F));
        store(pair.normalImpulse, total);
        pressPair(pair, v, total - carried);
        storeVelocities(pair, bodies, v);
    }
    return bits(pressed) != 0 ? 1 : 0;
}

// m/s that overlap is pushed apart with at most when it is mended.
LUTKA_LANES F fastestPush(const PairContactLanes& pair, const SubstepParams& params) {
    const F limp = isOwn(pair) ? all(params.ownPushSpeed) : all(params.pushSpeed);
    const F own = isDriven(pair) ? all(params.drivenPushSpeed) : limp;
    return strikes(pair) ? all(params.dollPushSpeed) : own;
}

static int mendPairs(const PairsView& view, const SubstepParams& params, int sweep) {
    const PairBodies& bodies = view.bodies;
    Mask any = noLanes();
    for (int i = 0; i < view.liveCount; ++i) {
        PairContactLanes& pair = pairAt(view, view.live[i]);
        const F zero = all(0.0F);
        const F separation = load(pair.separation);
        const Mask deep = overlaps(separation, params) & hasContact(pair) & ~isWedged(pair);
        // What a push drives together within a doll may come no nearer than touching, or a hand in a gap would be
        // thrown from one side of it into the other.
        const Mask nears = sweep > 0 ? isOwn(pair) & hasContact(pair) & ~deep : noLanes();
        const Mask mends = deep | nears;
        if (bits(mends) == 0) continue;
        makeReady(pair, bodies);
        any |= deep;
        PairVelocities v = velocitiesOf(pair, bodies);
        const V3 normal = load(pair.normal);
        // Between dolls what was too much is given back: a foot between two trunks would be thrown to and fro. Within a
        // doll too little is left of a push once all of the doll has answered: more is asked for, and kept.
        const Mask gathers = strikes(pair);
        const F parting = mendSpeed(separation, fastestPush(pair, params), eagerness(pair, params.mendHaste), params);
        const F asked = deep & ~gathers ? parting * eagerness(pair, params.mendRate) : parting;
        // The first sweep skips what does not overlap, and leaves its record of another kind there.
        const F before = (sweep > 0 ? gathers & deep : noLanes()) ? load(pair.carriedNormal) : zero;
        const F total = most(before - load(pair.normalMass) * (dot(normal, slidingOf(pair, v)) - asked), zero);
        const F size = mends ? total - before : zero;
        store(pair.carriedNormal, gathers & deep ? total : zero);  // is free again
        pressPair(pair, v, size);
        // What pushes one side of a doll alone pushes all of it, and the other side after it: own contacts push both.
        const F onOwn = isOwn(pair) ? size : zero;
        if (bits(onOwn > zero) != 0) pushRest(pair, bodies, v, normal * onOwn, onOwn);
        storeVelocities(pair, bodies, v);
    }
    return bits(any) != 0 ? 1 : 0;
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
