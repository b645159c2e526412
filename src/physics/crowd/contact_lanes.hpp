#pragma once

/// Contacts as the kernels hold them: with static geometry lane by lane of a batch, between bodies eight to a block.

#include "physics/crowd/body_lanes.hpp"

namespace lutka::physics::crowd {

/// A point of a body (a sphere around a point of its core) against a half space, one a lane. What a sweep needs first.
struct StaticContactLanes {
    Wide3 normal;  ///< Out of the solid.
    Wide3 arm;     ///< As it will be half way through the substep.
    Wide bias;     ///< m/s: with which the surface is just reached, or what mends an overlap, negative.
    Wide friction;
    Wide normalImpulse;
    Wide3 frictionImpulse;  ///< World axes.
    Wide3 rollImpulse;
    Wide normalWeight;  ///< N s per m/s; see tree_kernels.hpp.
    Wide tangentWeight;
    Wide rollWeight;
    Wide normalGain;  ///< The weights where the rows hold, else 0.
    Wide tangentGain;
    Wide rollGain;
    int body;
    int near;     ///< Whether it can be met in this substep, in some lane.
    int engaged;  ///< Whether it presses, or just did, in some lane.

    Wide3 localPoint;
    Wide radius;
    Wide normalMass;                 ///< kg, of the body alone.
    Wide offset;                     ///< The solid is normal · p <= offset; very low where the lane has no contact.
    unsigned long long key[kLanes];  ///< What each lane's contact is matched by in the next step; 0: none.
};

/// What a contact between two bodies is, as a number of a lane.
struct PairKind {
    static constexpr float other = 0.0F;   ///< One of them has no other jointed to it. Empty lanes, too.
    static constexpr float driven = 1.0F;  ///< Of one doll that has muscles: a push that comes late would throw a limb.
    static constexpr float own = 2.0F;     ///< Of one limp doll, and
    static constexpr float dolls = 3.0F;   ///< of two: these are pressed again once the dolls have answered.
    static constexpr float wedged = 4.0F;  ///< One of `own` while its doll is mended: see own_wedges.hpp.
};

/// Eight contacts between two bodies each, of any dolls; no body comes twice, so that they are solved at once. Lanes
/// without a contact come last and repeat lane 0, but for `active`: they push nothing, and lane 0 is written after
/// them.
struct PairContactLanes {
    // What says whether there is anything to do,
    int bodyA[kLanes];  ///< Into PairBodies.
    int bodyB[kLanes];
    Wide3 normal;  ///< From B to A.
    Wide separation;
    Wide normalImpulse;
    Wide radius;           ///< Sum of both.
    Wide approach;         ///< Relative speed along the normal at the start of the last substep.
    Wide friction;         ///< 0 where the lane is empty.
    Wide3 localA, localB;  ///< The touching points of the cores.
    int onAxisY;           ///< Whether all touching points lie on the bodies' y, as those of capsules do.
    unsigned follows;  ///< A bit mask of the lanes of capsules and spheres: points and normal are found anew in every
                       ///< substep.
    int ready;         ///< Whether directions and masses are those of this substep.
    int answered;      ///< The sweep, counted from 1, in which any was last pressed again in this substep; 0: in none.
    Wide load;         ///< What was carried into this substep: see carriedLoad().
    // what a push needs,
    Wide3 armA, armB;
    Wide kind;  ///< A PairKind.
    Wide normalMass;
    Wide inverseMassA, inverseMassB;
    Wide3 pushA, pushB;  ///< The normal without the part that is held against by what a body rests on.
    Wide3 turnA, turnB;  ///< Inverse inertia times (arm × push).
    Wide carriedNormal;  ///< What the substep before left of the impulses; later what the last sweep added.
    // and what friction does.
    Wide carriedTangent[2];  ///< Later, in the first: what the contact was wrong by, m/s, when it was pressed again.
    Wide3 tangent;  ///< The first of two; until it is prepared in a step the friction of the step before, N s, in world
                    ///< axes.
    Wide3 rubA[2], rubB[2];  ///< Inverse inertia times (arm × tangent).
    Wide tangentMass[2];
    Wide tangentImpulse[2];
};

/// How many blocks of pair contacts lie side by side.
inline constexpr int kPairChunk = 64;

/// Pair contacts of a job as the kernels see them: `count` blocks from `first` on, in pieces of kPairChunk.
struct PairsView {
    PairContactLanes* const* chunks;
    int first;
    int count;
    PairBodies bodies;
    int* live;  ///< Blocks, counted as `first` is, that may be met in this substep, in their order; room for all.
    int liveCount;
    int* changed;  ///< Those that were pressed again; room for as many.
    int changedCount;
    int wedges;  ///< Whether a contact within a limp doll lies deeper than SubstepTuning::wedgeDepth.
};

}  // namespace lutka::physics::crowd
