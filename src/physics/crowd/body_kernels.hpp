#pragma once

/// Kernels that touch bodies only: frames, bounds, integration. kernels.hpp says what they are compiled for.

#include "physics/crowd/lane_storage.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

LUTKA_LANES Axes axesOf(const BodyLanes& body) {
    return {load(body.axisX), load(body.axisY), load(body.axisZ)};
}

// The sum of value[i] times the outer product of axis i with itself.
LUTKA_LANES Symmetric onAxes(const Axes& axes, const float (&value)[3]) {
    const V3 x = axes.x * all(value[0]);
    const V3 y = axes.y * all(value[1]);
    const V3 z = axes.z * all(value[2]);
    return {x.x * axes.x.x + y.x * axes.y.x + z.x * axes.z.x, x.y * axes.x.y + y.y * axes.y.y + z.y * axes.z.y,
            x.z * axes.x.z + y.z * axes.y.z + z.z * axes.z.z, x.x * axes.x.y + y.x * axes.y.y + z.x * axes.z.y,
            x.x * axes.x.z + y.x * axes.y.z + z.x * axes.z.z, x.y * axes.x.z + y.y * axes.y.z + z.y * axes.z.z};
}

LUTKA_LANES void setFrame(BodyLanes& body, const BodyConstants& constants, const Axes& axes) {
    store(body.axisX, axes.x);
    store(body.axisY, axes.y);
    store(body.axisZ, axes.z);
    store(body.inverseInertia, onAxes(axes, constants.inverseInertia));
}

static void refresh(const BatchView& batch) {
    for (int b = 0; b < batch.bodyCount; ++b) {
        BodyLanes& body = batch.bodies[b];
        setFrame(body, batch.bodyConstants[b], axesOf(load(body.rotation)));
    }
}

static void findBounds(const BatchView& batch, float dt, float margin) {
    const V3 rootVelocity = load(batch.bodies[0].velocity);
    for (int b = 0; b < batch.bodyCount; ++b) {
        BodyLanes& body = batch.bodies[b];
        const BodyConstants& constants = batch.bodyConstants[b];
        const Axes axes = axesOf(body);
        const V3 turn = load(body.angular);
        const F swept = squareRoot(dot(turn, turn)) * all(constants.reach * dt) + all(constants.radius + margin);
        const V3 moved = magnitude(load(body.velocity) - rootVelocity) * all(dt);
        const V3 core = magnitude(axes.x) * all(constants.extent[0]) + magnitude(axes.y) * all(constants.extent[1]) +
                        magnitude(axes.z) * all(constants.extent[2]);
        const V3 half = core + moved + V3{swept, swept, swept};
        const V3 position = load(body.position);
        store(body.low, position - half);
        store(body.high, position + half);
    }
}

static void findSelfPairs(const BatchView& batch, const SelfPair* pairs, int count, unsigned char* masks) {
    for (int i = 0; i < count; ++i) {
        const BodyLanes& a = batch.bodies[pairs[i].a];
        const BodyLanes& b = batch.bodies[pairs[i].b];
        const Mask apart = (load(a.low.x) > load(b.high.x)) | (load(b.low.x) > load(a.high.x)) |
                           (load(a.low.y) > load(b.high.y)) | (load(b.low.y) > load(a.high.y)) |
                           (load(a.low.z) > load(b.high.z)) | (load(b.low.z) > load(a.high.z));
        masks[i] = static_cast<unsigned char>(~bits(apart) & 0xFFU);
    }
}

LUTKA_LANES unsigned meeting(const BoxLanes& boxes, const V3& low, const V3& high) {
    return bits((load(boxes.low.x) <= high.x) & (low.x <= load(boxes.high.x)) & (load(boxes.low.y) <= high.y) &
                (low.y <= load(boxes.high.y)) & (load(boxes.low.z) <= high.z) & (low.z <= load(boxes.high.z)));
}

static int findBodyPairs(const DollBoxes& a, const DollBoxes& b, const float (&apart)[3], BodyPair* out) {
    int count = 0;
    const V3 lowB = all(b.low) - all(apart), highB = all(b.high) + all(apart);
    for (int i = 0; i < a.groups; ++i) {
        for (unsigned near = meeting(a.boxes[i], lowB, highB); near != 0; near &= near - 1) {
            const int lane = __builtin_ctz(near);
            const BoxLanes& group = a.boxes[i];
            const V3 from{all(group.low.x.lane[lane] - apart[0]), all(group.low.y.lane[lane] - apart[1]),
                          all(group.low.z.lane[lane] - apart[2])};
            const V3 to{all(group.high.x.lane[lane] + apart[0]), all(group.high.y.lane[lane] + apart[1]),
                        all(group.high.z.lane[lane] + apart[2])};
            for (int j = 0; j < b.groups; ++j) {
                for (unsigned met = meeting(b.boxes[j], from, to); met != 0; met &= met - 1)
                    out[count++] = {i * kLanes + lane, j * kLanes + __builtin_ctz(met)};
            }
        }
    }
    return count;
}

static int findBoxesAfter(const BoxLanes* boxes, int count, int from, int* out) {
    const BoxLanes& own = boxes[from / kLanes];
    const int lane = from % kLanes;
    const V3 low{all(own.low.x.lane[lane]), all(own.low.y.lane[lane]), all(own.low.z.lane[lane])};
    const V3 high{all(own.high.x.lane[lane]), all(own.high.y.lane[lane]), all(own.high.z.lane[lane])};
    unsigned after = ~1U << static_cast<unsigned>(lane);  // in the first eight
    int found = 0;
    for (int i = from / kLanes; i * kLanes < count && boxes[i].low.x.lane[0] <= own.high.x.lane[lane]; ++i) {
        for (unsigned met = meeting(boxes[i], low, high) & after; met != 0; met &= met - 1)
            out[found++] = i * kLanes + __builtin_ctz(met);
        after = ~0U;
    }
    return found;
}

// m/s, of any point of the surface.
LUTKA_LANES F speedBound(const BodyLanes& body, const BodyConstants& constants) {
    const V3 velocity = load(body.velocity);
    const V3 angular = load(body.angular);
    return squareRoot(dot(velocity, velocity)) + squareRoot(dot(angular, angular)) * all(constants.reach);
}

static void limitRoom(const BatchView& batch, const float (&normal)[3], float offset, float margin, float seconds) {
    for (int b = 0; b < batch.bodyCount; ++b) {
        BodyLanes& body = batch.bodies[b];
        const BodyConstants& constants = batch.bodyConstants[b];
        const F between = dot(all(normal), load(body.position)) - all(offset + constants.size);
        const F covered = all(margin) + speedBound(body, constants) * all(seconds);
        store(body.room, least(load(body.room), most(covered, between)));
    }
}

static void findNearPlane(const BatchView& batch, const PlanePoint* points, int count, const float (&normal)[3],
                          float offset, float margin, float seconds, unsigned char* lanes) {
    F reach = all(0.0F);
    for (int i = 0; i < count; ++i) {
        const PlanePoint& point = points[i];
        const BodyLanes& body = batch.bodies[point.body];
        if (i == 0 || point.body != points[i - 1].body)
            reach = all(margin) + speedBound(body, batch.bodyConstants[point.body]) * all(seconds);
        const V3 core = load(body.position) + axesOf(body) * all(point.local);
        lanes[i] = static_cast<unsigned char>(bits(dot(all(normal), core) - all(offset + point.radius) < reach));
    }
}

// What half a substep of free motion (`half` seconds) adds to the turning rate: the angular momentum stays, the rate
// does not.
LUTKA_LANES V3 spinOf(const BodyLanes& body, const BodyConstants& constants, const V3& angular, F half) {
    const Axes axes = axesOf(body);
    const V3 inertia = all(constants.inertia);
    const V3 inverseInertia = all(constants.inverseInertia);
    const V3 rate = transposed(axes, angular);
    const V3 torque = cross(V3{rate.x * inertia.x, rate.y * inertia.y, rate.z * inertia.z}, rate);
    return axes * V3{half * torque.x * inverseInertia.x, half * torque.y * inverseInertia.y,
                     half * torque.z * inverseInertia.z};
}

// Foresees how a body turns: `angular` is its rate, `half` half the substep, seconds.
LUTKA_LANES void aimBody(BodyLanes& body, const BodyConstants& constants, const V3& angular, const V3& steady, F half) {
    const V3 spin = spinOf(body, constants, steady, half);
    const V3 turn = (angular + spin) * half;
    store(body.aim, angular);
    store(body.spin, spin);
    store(body.halfTurn, turn);
    store(body.chord, all(1.0F) / (all(1.0F) + dot(turn, turn)));
}

// An arm of the body as it will be half way through the substep, shortened so that the rate times it and the substep's
// length is the chord along which its end moves.
LUTKA_LANES V3 halfWay(const BodyLanes& body, const V3& arm) {
    return (arm + cross(load(body.halfTurn), arm)) * load(body.chord);
}

LUTKA_LANES void applyForces(const BatchView& batch, const SubstepParams& params) {
    const V3 gain = all(params.gravity) * all(params.dt);
    const F brake = all(1.0F) / (all(1.0F) + load(batch.rest->brake) * all(params.dt));
    const F linear = brake * all(params.linearDamping);
    const F angular = brake * all(params.angularDamping);
    for (int b = 0; b < batch.bodyCount; ++b) {
        BodyLanes& body = batch.bodies[b];
        // What brakes does not hold up: gravity acts in full, or what lies would press by less than its weight.
        const V3 velocity = load(body.velocity) * linear + gain;
        const V3 turn = load(body.angular) * angular;
        store(body.velocity, velocity);
        store(body.angular, turn);
        store(body.steadyVelocity, velocity);
        store(body.steadyAngular, turn);
        store(body.inertia, onAxes(axesOf(body), batch.bodyConstants[b].inertia));
        aimBody(body, batch.bodyConstants[b], turn, turn, all(0.5F * params.dt));
    }
}

static void joinBounds(const BatchView& batch, Wide3& low, Wide3& high) {
    V3 least3 = load(batch.bodies[0].low);
    V3 most3 = load(batch.bodies[0].high);
    for (int b = 1; b < batch.bodyCount; ++b) {
        const V3 bodyLow = load(batch.bodies[b].low);
        const V3 bodyHigh = load(batch.bodies[b].high);
        least3 = {least(least3.x, bodyLow.x), least(least3.y, bodyLow.y), least(least3.z, bodyLow.z)};
        most3 = {most(most3.x, bodyHigh.x), most(most3.y, bodyHigh.y), most(most3.z, bodyHigh.z)};
    }
    store(low, least3);
    store(high, most3);
}

static void takeWay(const BatchView& batch, Wide& way, Wide& speed) {
    F farthest = all(0.0F);
    F fastest = all(0.0F);
    for (int b = 0; b < batch.bodyCount; ++b) {
        BodyLanes& body = batch.bodies[b];
        farthest = most(farthest, load(body.way));
        fastest = most(fastest, speedBound(body, batch.bodyConstants[b]));
        store(body.way, all(0.0F));
    }
    store(way, farthest);
    store(speed, fastest);
}

static void findMotion(const BatchView& batch, Wide& speed2, Wide& turn2) {
    F fastest = all(0.0F);
    F quickest = all(0.0F);
    for (int b = 0; b < batch.bodyCount; ++b) {
        const V3 velocity = load(batch.bodies[b].velocity);
        const V3 angular = load(batch.bodies[b].angular);
        fastest = most(fastest, dot(velocity, velocity));
        quickest = most(quickest, dot(angular, angular));
    }
    store(speed2, fastest);
    store(turn2, quickest);
}

// One body's substep: the orientation turns by the mean rate of the free motion over the substep (the angular momentum
// stays, the rate does not), then the rate follows from the momentum. Keeping the rate instead would lose momentum,
// and turning by the rate at the start would gain energy on slender bodies. What was added to mend errors moves the
// body and is forgotten.
LUTKA_LANES void advanceBody(BodyLanes& body, const BodyConstants& constants, F dt) {
    store(body.position, load(body.position) + load(body.velocity) * dt);
    const F moved = speedBound(body, constants) * dt;
    store(body.room, load(body.room) - moved);
    store(body.way, load(body.way) + moved);
    const Axes axes = axesOf(body);
    const V3 inertia = all(constants.inertia);
    const V3 inverseInertia = all(constants.inverseInertia);
    const V3 steady = transposed(axes, load(body.steadyAngular));
    const V3 rate = transposed(axes, load(body.angular));
    const V3 momentum{steady.x * inertia.x, steady.y * inertia.y, steady.z * inertia.z};
    const V3 torque = cross(momentum, steady);
    const F half = all(0.5F) * dt;
    const V3 mean{rate.x + half * torque.x * inverseInertia.x, rate.y + half * torque.y * inverseInertia.y,
                  rate.z + half * torque.z * inverseInertia.z};
    store(body.velocity, load(body.steadyVelocity));
    const Q q = load(body.rotation);
    const Q turn{mean.x * half, mean.y * half, mean.z * half, all(1.0F)};
    Q next = q * turn;
    const F scale = all(1.0F) / squareRoot(next.x * next.x + next.y * next.y + next.z * next.z + next.w * next.w);
    next = {next.x * scale, next.y * scale, next.z * scale, next.w * scale};
    store(body.rotation, next);
    const Axes turned = axesOf(next);
    setFrame(body, constants, turned);
    const V3 inBody = transposed(turned, axes * momentum);
    store(body.angular,
          turned * V3{inBody.x * inverseInertia.x, inBody.y * inverseInertia.y, inBody.z * inverseInertia.z});
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
