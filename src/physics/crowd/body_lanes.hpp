#pragma once

/// What the kernels hold of bodies. A batch holds kLanes dolls of one topology; every number of a body is a Wide:
///
///     bodies[b].position.x.lane[l]    x of body b of the doll in lane l

#include "physics/crowd/wide.hpp"

namespace lutka::physics::crowd {

/// The state of one body in all lanes. World space, SI units. What a sweep of the tree needs comes first, so that it
/// stays in the nearest cache.
struct BodyLanes {
    Wide3 velocity;
    Wide3 angular;                        ///< World axes.
    Wide3 steadyVelocity, steadyAngular;  ///< With which all joints hold: see tree_kernels.hpp.
    WideSymmetric inertia;                ///< World axes, as it was at the substep's start.
    WideSymmetric inverseInertia;         ///< World axes.
    Wide3 aim;                            ///< The turning rate that the joints' arms were foreseen with.
    Wide3 position;                       ///< Of the centre of mass.
    Wide3 axisX, axisY, axisZ;            ///< The columns of the rotation, kept in step with `rotation`.
    Wide4 rotation;
    Wide3 loose;         ///< The velocity that pushes on single bodies gave: what differs is the joints' doing.
    Wide room;           ///< Metres that its surface may still move before a static contact could be missing.
    Wide way;            ///< Metres that its surface has moved at most since Kernels::takeWay was last asked.
    Wide3 spin;          ///< What half a substep of free motion adds to the turning rate.
    Wide3 halfTurn;      ///< Half the substep times both: with it
    Wide chord;          ///< and this factor an arm comes to where it is half way: see `halfWay`.
    Wide3 low, high;     ///< Bounds for the coming step as seen from the doll's root: see `findBounds`.
    Wide3 support;       ///< Out of what it rests on; its length says how firmly that holds, 0 to 1.
    Wide3 looseAngular;  ///< The turning rate likewise.
};

/// What else than itself presses a doll, as a number of a lane; 0 for nothing.
struct Struck {
    static constexpr float byProp = 0.5F;  ///< It may be given energy, and still answers itself.
    static constexpr float byDoll = 1.0F;
};

/// By which contacts a body was pressed again since its doll has last answered, as a number of a lane; 0 for none.
struct Pressed {
    static constexpr float within = 1.0F;  ///< Those of its own doll.
    static constexpr float byDoll = 2.0F;
};

/// One body of one doll as pair contacts see it: what they push. A register's worth, so that eight bodies of any dolls
/// are read by eight loads and a transposition. Begun anew in every substep from BodyLanes, and taken in there.
struct alignas(32) BodyMotion {
    float velocity[3];
    float angular[3];
    float pressed;  ///< See Pressed.
    float struck;   ///< What else than its doll presses it, in this substep's first sweep: see Struck.
};

/// What else they need of it, in rows of the same kind. What rests on a body passes its support on.
struct alignas(32) BodyFrame {
    float position[3], axisY[3];
    float half;   ///< Half length of its core along the body's y, where that is a capsule or sphere.
    float rises;  ///< 1 where its doll has more energy after its last answer than before it; else 0.
    float inverseInertia[6], unused1[2];  ///< As in WideSymmetric.
    float support[3], axisX[3], unused2[2];
};

/// One of each a body of the world. Jobs share no body.
struct PairBodies {
    BodyMotion* motions;
    BodyFrame* frames;
};

/// What is constant of a body, from the profile.
struct BodyConstants {
    float mass;
    float inverseMass;
    float inertia[3];
    float inverseInertia[3];
    float extent[3];  ///< Half extents of the core along the body's axes: a capsule's segment, a box.
    float radius;     ///< Around the core.
    float reach;      ///< Greatest distance of the core from the centre.
    float size;       ///< Greatest distance of the surface, of all its shapes, from the centre.
    float armReach;   ///< Greatest distance of a joint's anchor from the centre.
};

/// A doll's motion about its centre of mass as its substep begins, one a lane.
struct FlightLanes {
    Wide3 angularMomentum;  ///< kg m²/s
    Wide energy;            ///< J, kinetic.
};

/// What brings dolls to rest, one a lane; 0 and 1 for those that move.
struct RestLanes {
    Wide brake;     ///< 1/s: how fast all speeds decay.
    Wide stiction;  ///< Factor on all friction: static friction is greater than sliding friction.
};

}  // namespace lutka::physics::crowd
