#pragma once

/// The plain data that the solver's kernels and the code around them share. Nothing here may have inline functions
/// with code in it: this header is compiled for several instruction sets, and the linker would keep only one copy.
///
/// A batch holds kLanes dolls of one topology; every number of a body is a Wide, one float a doll:
///
///     bodies[b].position.x.lane[l]    x of body b of the doll in lane l
#include "physics/crowd/substep_params.hpp"

namespace lutka::physics::crowd {

inline constexpr int kLanes = 8;
inline constexpr unsigned kAllLanes = (1U << kLanes) - 1U;  ///< As a bit mask.

/// One float a lane.
struct alignas(32) Wide {
    float lane[kLanes];
};
struct Wide3 {
    Wide x, y, z;
};
struct Wide4 {
    Wide x, y, z, w;
};
/// A symmetric 3 × 3 matrix.
struct WideSymmetric {
    Wide xx, yy, zz, xy, xz, yz;
};

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

/// What is constant of a constraint, from the profile. Quaternions are x, y, z, w.
struct JointConstants {
    int parent;
    int child;
    int isHinge;
    int childGathers;  ///< Whether the child has children itself.
    int opens;         ///< Whether it is the last joint of its parent, whose sum it begins.
    float parentAnchor[3];
    float childAnchor[3];
    float parentFrame[4];
    float childFrame[4];
    float limit[3];  ///< Hinge: lower, upper. Cone-twist: swing y, swing z, twist.
    int longAxis;    ///< Cone-twist: which of limit[0] and [1] bounds a row of its own; -1: none, a round cone.
    float frictionNm;
};

/// A one-sided angular row: the relative angular velocity along `axis` may not fall below -`bias`.
struct LimitRow {
    Wide3 axis;    ///< Turns the child back into the range.
    Wide weight;   ///< N m s per rad/s; see tree_kernels.hpp.
    Wide bias;     ///< rad/s: with which the stop is just reached, or what mends an overrun, negative.
    Wide impulse;  ///< N m s, >= 0; kept between substeps.
    Wide gain;     ///< `weight` where the row holds, else 0.
};

/// The rows that keep a hinge's axes parallel, as one vector across the axis.
struct HingeRows {
    Wide3 axis;
    Wide3 bias;     ///< rad/s, mends the axes' error.
    Wide3 impulse;  ///< N m s, on the child.
    Wide weight;
};

inline constexpr int kLimitRows = 3;

/// A constraint in all lanes: impulses that are kept (warm starting) and what a substep prepares.
struct JointLanes {
    Wide3 parentArm, childArm;  ///< From centre of mass to anchor, as they will be half way through the substep.
    Wide3 drift;                ///< m/s: what `spin` moves the anchors apart with.
    Wide3 bias;                 ///< m/s: mends the anchors' distance.
    Wide3 frictionImpulse;      ///< N m s; a hinge uses x, about its axis.
    Wide frictionWeight;
    Wide frictionLimit;  ///< N m s a substep.
    Wide frictionGain;
    LimitRow limit[kLimitRows];  ///< Hinge: [0]. Cone-twist: swing, twist, the swing ellipse's longer axis.
    HingeRows hinge;
    Wide side[kLimitRows];        ///< Which end of the range limit[i] stands for (+1, -1); a change drops the impulse.
    int limitActive[kLimitRows];  ///< Whether any lane is near limit[i].
    int mends;                    ///< Whether any lane's anchors or limits are so far off that mending them adds speed.
};

/// A general 3 × 3 matrix by rows.
struct WideMatrix {
    Wide3 row[3];
};

/// What the children of a body add to its inertia (about its centre of mass) and to its right-hand side.
struct GatheredLanes {
    WideSymmetric linear;   ///< Momentum from velocity.
    WideMatrix mixed;       ///< Momentum from angular velocity.
    WideSymmetric turning;  ///< Angular momentum from angular velocity.
    Wide3 impulse, torque;  ///< Right-hand side.
};

/// What is left of a body once it has been eliminated: the factors that bring the parent's motion down.
struct EliminatedLanes {
    WideMatrix fromAngular;  ///< Child's angular change from the parent's.
    WideMatrix fromLinear;   ///< Child's angular change from that of the anchor, negated and transposed.
    Wide3 anchorChange;      ///< Change of the anchor's relative velocity.
    Wide3 freeTurn;          ///< Child's angular change while the parent stays.
};

/// What the tree solver holds of a body: first the one, then the other.
struct TreeLanes {
    union {
        GatheredLanes gathered;
        EliminatedLanes eliminated;
    };
    Wide3 velocityChange, angularChange;  ///< Of this sweep, for the children.
};

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

/// A pull on a point of a body towards a place, in the lane of one doll: a damped spring whose force is bounded.
struct DragLanes {
    Wide3 localPoint;
    Wide3 target;   ///< World space, at the step's end.
    Wide3 rate;     ///< m/s: how it moves.
    Wide weight;    ///< N s per m/s: what spring and damper answer a speed with in a substep; 0: nothing pulls here.
    Wide pull;      ///< 1/s: speed towards the target over the distance from it.
    Wide bound;     ///< N s a substep.
    Wide3 arm;      ///< As it will be half way through the substep.
    Wide3 bias;     ///< m/s
    Wide3 impulse;  ///< N s, of this substep.
    Wide3 before;   ///< m/s, of its point as the substep began, when Batch::energy was taken.
    Wide gain;      ///< `weight` while the force is within its bound, else 0; kept between substeps.
    int body;
};

/// A motor in a joint: a damped spring towards a turning target, whose torque is bounded. Rotations are those of the
/// child's frame in the parent's; axes are the parent frame's unless said otherwise.
struct MotorLanes {
    Wide4 target;   ///< Where the target is at the end of the step.
    Wide3 rate;     ///< rad/s: how it turns.
    Wide weight;    ///< N m s per rad/s: what spring and damper answer a speed with in a substep; 0: no motor here.
    Wide pull;      ///< 1/s: speed towards the target over the angle from it.
    Wide bound;     ///< N m s a substep.
    Wide3 bias;     ///< rad/s, world: the speed that the spring wants less of.
    Wide3 before;   ///< rad/s, world: how the joint turned at the substep's start.
    Wide3 impulse;  ///< N m s, world, on the child, of this substep.
    Wide work;      ///< J, of this substep.
    Wide gain;      ///< `weight` while the torque is within its bound, else 0; kept between substeps.
    int active;     ///< Whether any lane has one.
};

/// A frame in motion that a body is led to, one a lane; all of zeros where there is none. World axes.
struct TargetLanes {
    Wide3 goal;       ///< m/s: the body's velocity in this substep, were it alone with the spring.
    Wide3 turnGoal;   ///< rad/s
    Wide weight;      ///< N s per m/s: what the row answers a speed with.
    Wide turnWeight;  ///< N m s per rad/s
    Wide kinematic;   ///< 1 where the body follows exactly, else 0.
    Wide3 impulse;    ///< N s, of this substep.
    Wide3 torque;     ///< N m s, likewise.
    Wide3 position;   ///< Of the frame at the step's end.
    Wide4 rotation;
    Wide3 rate;        ///< m/s: how the frame moves.
    Wide3 turnRate;    ///< rad/s
    Wide pull;         ///< 1/s: speed towards the frame over the distance from it.
    Wide3 before;      ///< m/s: of the body at the substep's start.
    Wide3 turnBefore;  ///< rad/s
    Wide work;         ///< J, of this substep.
    int active;        ///< Whether any lane has one.
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

/// What brings dolls to rest, one a lane; 0 and 1 for those that move.
struct RestLanes {
    Wide brake;     ///< 1/s: how fast all speeds decay.
    Wide stiction;  ///< Factor on all friction: static friction is greater than sliding friction.
};

/// A batch as the kernels see it.
struct BatchView {
    int bodyCount;
    int jointCount;
    int contactCount;
    const BodyConstants* bodyConstants;
    const JointConstants* jointConstants;
    const int* firstContact;  ///< One a body and one more: where its contacts begin; they lie body by body.
    BodyLanes* bodies;
    JointLanes* joints;
    TreeLanes* tree;
    StaticContactLanes* contacts;
    int dragCount;
    DragLanes* drags;
    MotorLanes* motors;    ///< One a joint, or null where no doll of the batch has any.
    TargetLanes* targets;  ///< One a body, likewise.
    const RestLanes* rest;
    const int* paired;  ///< Its bodies that pair contacts push, in some lane.
    int pairedCount;
    const int* firstBody;  ///< One a lane: where its doll's bodies begin in `pairBodies`.
    PairBodies pairBodies;
    Wide* answered;  ///< 1 where the lane's doll has answered to contacts that were pressed again, else 0.
    Wide* energy;    ///< J, kinetic, of each doll at the substep's start.
    Wide* struck;    ///< What else presses the lane's doll in this substep: see Struck.
};

/// A pair of bodies of one doll that may collide, and the lanes in which their bounds meet.
struct SelfPair {
    int a;
    int b;
};

/// A point that a body can meet a plane with: a corner of a shape, or an end of its core with a radius around it.
struct PlanePoint {
    int body;
    int shape;       ///< Which of the body's shapes.
    int feature;     ///< Which point of it.
    float local[3];  ///< Body space.
    float radius;
};

/// Boxes around bodies or dolls, one a lane. Lanes without one hold an empty box (low above high).
struct BoxLanes {
    Wide3 low, high;
};

/// Those of a doll's bodies, and what bounds them all.
struct DollBoxes {
    const BoxLanes* boxes;
    int groups;  ///< BoxLanes.
    float low[3];
    float high[3];
};

/// Two bodies whose boxes meet, by their number in each doll.
struct BodyPair {
    int a;
    int b;
};

/// A body as the search for contacts sees it in one step. World space, SI units. Sixteen floats: the kernels read eight
/// of them at a time and transpose.
struct alignas(64) StepBody {
    float centre[3];
    float radius;   ///< Around the core.
    float half[3];  ///< From the centre to the end of a capsule's core.
    float swing;    ///< m/s by which turning can move a point of it.
    float velocity[3];
    float halfLength;  ///< Of the core; kBoxCore for a box, whose `half` means nothing.
    float size;        ///< Radius of a sphere around it.
    float unused[3];
};
inline constexpr float kBoxCore = -1.0F;

/// How near two bodies must be for a contact: `margin` metres and the way that they can make in `seconds`, of which
/// what does not bring them together counts by the share `sideways`.
struct TouchRange {
    float margin;
    float seconds;
    float sideways;
};

/// Where the cores of eight pairs of bodies are nearest.
struct CoreTouchLanes {
    Wide alongA, alongB;  ///< Metres from each body's centre along its core.
    Wide radius;          ///< Of both together.
    Wide3 normal;         ///< From B to A.
    Wide separation;      ///< Of the surfaces, metres.
};

/// Passes of a mending.
enum class MendPass { more, last, probe };

/// The kernels of one instruction set. All sets do the same operations in the same order, without
/// approximate instructions; those that fuse multiply and add give the same bits.
struct Kernels {
    /// Rotation columns and world inertia from the rotation.
    void (*refresh)(const BatchView& batch);
    /// Bounds of every body for a step of `dt` s: its motion relative to the doll's first body, plus `margin` metres.
    void (*findBounds)(const BatchView& batch, float dt, float margin);
    /// Writes a bit mask of lanes whose bounds meet for every pair.
    void (*findSelfPairs)(const BatchView& batch, const SelfPair* pairs, int count, unsigned char* masks);
    /// The bodies of two dolls whose boxes meet once those of `a` are grown by `apart`. Returns how many there are;
    /// `out` has room for every pair.
    int (*findBodyPairs)(const DollBoxes& a, const DollBoxes& b, const float (&apart)[3], BodyPair* out);
    /// Of `count` boxes, sorted by their low ends along x, those after number `from` that meet it. Returns how many;
    /// `out` has room for all. Lanes after the last hold an empty box.
    int (*findBoxesAfter)(const BoxLanes* boxes, int count, int from, int* out);
    /// The nearest points of eight pairs of capsules or spheres. Returns a bit mask of the pairs that are in range.
    unsigned (*touchCores)(const StepBody* const (&a)[kLanes], const StepBody* const (&b)[kLanes],
                           const TouchRange& range, CoreTouchLanes& out);
    /// The same of two bodies of one doll, in all lanes.
    unsigned (*touchOwnCores)(const BatchView& batch, const SelfPair& pair, const TouchRange& range,
                              CoreTouchLanes& out);
    /// For each of some points, which come body by body, a bit mask of the lanes in which it is nearer to a plane
    /// (normal · p = offset) than `margin` and the way that the body's motion can take it in `seconds`.
    void (*findNearPlane)(const BatchView& batch, const PlanePoint* points, int count, const float (&normal)[3],
                          float offset, float margin, float seconds, unsigned char* lanes);
    /// Lowers the room of each body (BodyLanes::room) to what a search for contacts with a plane has covered: `margin`
    /// and the way that its motion can take it in `seconds`, or all that lies between it and the plane.
    void (*limitRoom)(const BatchView& batch, const float (&normal)[3], float offset, float margin, float seconds);
    /// Bounds of each doll: those of its bodies.
    void (*joinBounds)(const BatchView& batch, Wide3& low, Wide3& high);
    /// Of each doll, how far the surface of any of its bodies has moved at most since this was last asked, metres, and
    /// how fast any moves now, m/s.
    void (*takeWay)(const BatchView& batch, Wide& way, Wide& speed);
    /// Squares of the largest speed and turning rate among a doll's bodies.
    void (*findMotion)(const BatchView& batch, Wide& speed2, Wide& turn2);
    /// Gravity and damping, this substep's Jacobians and masses, then last substep's impulses.
    void (*begin)(const BatchView& batch, const SubstepParams& params);
    /// Solves all joints of each doll at once with the limits, friction and static contacts that hold. `first`: brings
    /// in last substep's impulses; otherwise does nothing where no contact was pressed again.
    void (*solve)(const BatchView& batch, const SubstepParams& params, int first);
    /// Whether a body, as it moves now, could meet static geometry in this substep that it has no contact with, or one
    /// that was left out for being too far off when the substep began.
    int (*outruns)(const BatchView& batch, const SubstepParams& params);
    /// Solves once more, with static contacts that have been found anew.
    void (*solveAgain)(const BatchView& batch, const SubstepParams& params);
    /// Whether any error of position is so large that it is to be mended.
    int (*needsMending)(const BatchView& batch, const SubstepParams& params);
    /// Takes in what pair contacts have made of the velocities, for mendOnce().
    void (*takeMotions)(const BatchView& batch);
    /// Adds to the velocities, not to the steady ones, what mends errors of position, in some lanes (a bit mask) with
    /// firm static contacts (SubstepTuning::wedgeFirmness). Returns a bit mask of the lanes that need another pass.
    /// What this one would run through holds there, and unless it is the last, arms are foreseen anew. A probe changes
    /// nothing but velocities, and returns 0.
    unsigned (*mendOnce)(const BatchView& batch, const SubstepParams& params, unsigned firmly, MendPass kind);
    /// Takes back all mending in some lanes, a bit mask.
    void (*mendNot)(const BatchView& batch, unsigned lanes);
    /// Positions and orientations with the velocities, which are the steady ones again afterwards.
    void (*advance)(const BatchView& batch, const SubstepParams& params);
    /// Sets the view's live blocks, which all the others work on.
    void (*beginPairs)(PairsView& view, const SubstepParams& params);
    /// One sweep; returns whether any contact presses, or did before.
    int (*solvePairs)(const PairsView& view, const SubstepParams& params);
    /// Adds to the velocities what mends overlaps, for the time `sweep`, counted from 0; returns whether there was any.
    int (*mendPairs)(const PairsView& view, const SubstepParams& params, int sweep);
    /// Presses contacts anew after the dolls have answered, for the time `sweep`, counted from 0. Sets the view's
    /// changed blocks.
    void (*pressAgain)(PairsView& view, const SubstepParams& params, int sweep);
    /// Gives the supports what that held back from them.
    void (*pressRest)(const PairsView& view);
    /// Pushes the bodies with what the substep before left of the impulses.
    void (*carryPairs)(const PairsView& view);
    /// After answers: no doll that answered only itself keeps more energy than it had at the substep's start.
    void (*limitEnergy)(const BatchView& batch);
};

}  // namespace lutka::physics::crowd
