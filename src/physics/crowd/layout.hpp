#pragma once

/// The plain data that the solver's kernels and the code around them share. Nothing here may have inline functions
/// with code in it: this header is compiled for several instruction sets, and the linker would keep only one copy.
///
/// A batch holds kLanes dolls of one topology; every number of a body is a Wide, one float a doll:
///
///     bodies[b].position.x.lane[l]    x of body b of the doll in lane l
namespace lutka::physics::crowd {

inline constexpr int kLanes = 8;

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

/// The state of one body in all lanes. World space, SI units. Pair contacts find the members of one lane by the
/// offsets below, so that the order of members is part of the layout.
struct BodyLanes {
    Wide3 velocity;
    Wide3 angular;                 ///< World axes.
    Wide3 position;                ///< Of the centre of mass.
    Wide3 axisX, axisY, axisZ;     ///< The columns of the rotation, kept in step with `rotation`.
    WideSymmetric inverseInertia;  ///< World axes.
    Wide4 rotation;
    Wide3 steadyVelocity, steadyAngular;  ///< With which all joints hold: see tree_kernels.hpp.
    Wide3 low, high;  ///< Bounds for the coming step as seen from the doll's root: see `findBounds`.
};
/// In floats, from the first member to the lane's own.
inline constexpr int kVelocityOffset = 0;
inline constexpr int kAngularOffset = 3 * kLanes;
inline constexpr int kPositionOffset = 6 * kLanes;
inline constexpr int kAxisOffset = 9 * kLanes;
inline constexpr int kInertiaOffset = 18 * kLanes;

/// What is constant of a body, from the profile.
struct BodyConstants {
    float inverseMass;
    float inertia[3];
    float inverseInertia[3];
    float extent[3];  ///< Half extents of the core along the body's axes: a capsule's segment, a box.
    float radius;     ///< Around the core.
    float reach;      ///< Greatest distance of the core from the centre.
};

/// What is constant of a constraint, from the profile. Quaternions are x, y, z, w.
struct JointConstants {
    int parent;
    int child;
    int isHinge;
    float parentAnchor[3];
    float childAnchor[3];
    float parentFrame[4];
    float childFrame[4];
    float limit[3];  ///< Hinge: lower, upper. Cone-twist: swing y, swing z, twist.
    float frictionNm;
};

/// A one-sided angular row: the relative angular velocity along `axis` may not make `room` negative.
struct LimitRow {
    Wide3 axis;    ///< Turns the child back into the range.
    Wide weight;   ///< N m s per rad/s; see tree_kernels.hpp.
    Wide room;     ///< Radians to the limit, negative past it.
    Wide impulse;  ///< N m s, >= 0; kept between substeps.
    Wide gain;     ///< `weight` where the row holds, else 0.
};

/// A constraint in all lanes: impulses that are kept (warm starting) and what a substep prepares.
struct JointLanes {
    Wide3 frictionImpulse;  ///< N m s; a hinge uses x, about its axis.
    Wide hingeImpulse[2];   ///< N m s, about the two axes across the hinge's.
    LimitRow limit[2];      ///< Hinge: [0]. Cone-twist: swing, twist.
    Wide side[2];           ///< Which end of the range limit[i] stands for (+1, -1); a change drops the impulse.

    Wide3 parentArm, childArm;  ///< From centre of mass to anchor.
    Wide3 error;                ///< Child's anchor minus parent's.
    Wide3 hingeAxis;
    Wide3 across[2];
    Wide acrossError[2];
    Wide acrossWeight;
    Wide frictionWeight;
    Wide frictionGain;
    Wide3 rowTorque;     ///< On the child, of the rows above.
    int limitActive[2];  ///< Whether any lane is near limit[i].
};

/// A general 3 × 3 matrix by rows.
struct WideMatrix {
    Wide3 row[3];
};

/// What the tree solver holds of a body: its inertia with everything below it (about the centre of mass while it is
/// gathered, about the anchor of its joint once eliminated), and the factors that bring the parent's motion down.
struct TreeLanes {
    WideSymmetric linear;   ///< Momentum from velocity.
    WideMatrix mixed;       ///< Momentum from angular velocity.
    WideSymmetric turning;  ///< Angular momentum from angular velocity.
    Wide3 impulse, torque;  ///< Right-hand side.

    WideSymmetric own;         ///< The body's own angular inertia, world axes.
    WideSymmetric compliance;  ///< Inverse of the angular block with the joint's rows.
    WideMatrix fromAngular;    ///< Child's angular change from the parent's.
    WideMatrix fromLinear;     ///< Child's angular change from that of the anchor, negated and transposed.
    Wide3 anchorChange;        ///< Change of the anchor's relative velocity.
    Wide3 freeTurn;            ///< Child's angular change while the parent stays.
};

/// A point of a body (a sphere around a point of its core) against a half space, one a lane.
struct StaticContactLanes {
    int body;
    Wide3 localPoint;
    Wide radius;
    Wide3 normal;  ///< Out of the solid.
    Wide offset;   ///< The solid is normal · p <= offset; very low where the lane has no contact.
    Wide friction;
    Wide normalImpulse;
    Wide3 frictionImpulse;  ///< World axes, kept between steps; the two below within one.
    Wide tangentImpulse[2];
    Wide3 rollImpulse;
    unsigned long long key[kLanes];  ///< What each lane's contact is matched by in the next step; 0: none.

    Wide3 arm;
    Wide3 tangent[2];
    Wide separation;
    Wide normalWeight;  ///< N s per m/s; see tree_kernels.hpp.
    Wide tangentWeight;
    Wide rollWeight;
    Wide normalGain;  ///< The weights where the rows hold, else 0.
    Wide tangentGain;
    Wide rollGain;
    Wide normalPush;  ///< This pass's impulses.
    Wide tangentPush[2];
    Wide3 rollPush;
    int engaged;  ///< Whether it presses, or just did, in some lane.
};

/// Eight contacts between two bodies each, of any dolls; no body comes twice, so that they are solved at once.
struct PairContactLanes {
    float* bodyA[kLanes];  ///< First member of the lane in its BodyLanes.
    float* bodyB[kLanes];
    Wide3 localA, localB;  ///< The touching points of the cores.
    Wide radius;           ///< Sum of both.
    Wide3 normal;          ///< From B to A.
    Wide inverseMassA, inverseMassB;
    Wide friction;
    Wide normalImpulse;
    Wide3 frictionImpulse;  ///< World axes, what is carried from the step before.
    Wide tangentImpulse[2];
    Wide active;  ///< 1, or 0 where the lane is empty.

    Wide3 armA, armB;
    Wide3 tangent[2];
    Wide3 turnA[3], turnB[3];  ///< Inverse inertia times (arm × direction), for the normal and the tangents.
    Wide separation;
    Wide normalMass;
    Wide tangentMass[2];
};

/// What a substep needs.
struct SubstepParams {
    float dt;
    float inverseDt;
    float gravity[3];
    float linearDamping;     ///< Factor a substep.
    float angularDamping;    ///< Likewise.
    float jointRate;         ///< 1/s: the speed over the error that it is mended with.
    float limitRate;         ///< Likewise.
    float contactRate;       ///< Likewise.
    float pushSpeed;         ///< m/s, largest speed that overlap is pushed apart with.
    float limitSpeed;        ///< rad/s, the same of limits.
    float slop;              ///< Metres of overlap that are left alone.
    float rollingLever;      ///< Metres: rolling resistance over normal force.
    float jointStiffness;    ///< Weight of rows that hold over the local effective mass: hinges.
    float limitStiffness;    ///< Limits.
    float contactStiffness;  ///< Static contacts.
    float firstTouch;        ///< Limits and contacts that are about to be met.
    float grip;              ///< The same of friction.
    float limitTolerance;    ///< rad/s, and
    float contactTolerance;  ///< m/s: a guess of which rows hold that is wrong by more is mended in another pass.
    float relaxGap;          ///< Metres, and
    float relaxAngle;        ///< rad: errors below which the relaxing pass is left out.
    int passes;              ///< At most, with bias and
    int relaxPasses;         ///< without.
    int warmStart;           ///< The first substep of a step makes the carried friction impulses its own.
};

/// A batch as the kernels see it.
struct BatchView {
    int bodyCount;
    int jointCount;
    int contactCount;
    const BodyConstants* bodyConstants;
    const JointConstants* jointConstants;
    BodyLanes* bodies;
    JointLanes* joints;
    TreeLanes* tree;
    StaticContactLanes* contacts;
    const Wide* brake;  ///< Factor on all speeds a substep, one a doll.
};

/// A pair of bodies of one doll that may collide, and the lanes in which their bounds meet.
struct SelfPair {
    int a;
    int b;
};

/// The kernels of one instruction set. All sets do the same operations in the same order, without contraction or
/// approximate instructions, so that they give the same bits.
struct Kernels {
    /// Rotation columns and world inertia from the rotation.
    void (*refresh)(const BatchView& batch);
    /// Bounds of every body for a step of `dt` s: its motion relative to the doll's first body, plus `margin` metres.
    void (*findBounds)(const BatchView& batch, float dt, float margin);
    /// Writes a bit mask of lanes whose bounds meet for every pair.
    void (*findSelfPairs)(const BatchView& batch, const SelfPair* pairs, int count, unsigned char* masks);
    /// Bounds of each doll: those of its bodies.
    void (*joinBounds)(const BatchView& batch, Wide3& low, Wide3& high);
    /// Squares of the largest speed and turning rate among a doll's bodies.
    void (*findMotion)(const BatchView& batch, Wide& speed2, Wide& turn2);
    /// Gravity and damping, this substep's Jacobians and masses, then last substep's impulses.
    void (*begin)(const BatchView& batch, const SubstepParams& params);
    /// `first`: the substep's first pass, which also brings in last substep's impulses. Solves all joints of each doll
    /// at once with the limits, friction and static contacts that hold; `useBias` 0: the relaxing pass, which takes out
    /// the speed that mending errors put in.
    void (*solve)(const BatchView& batch, const SubstepParams& params, int useBias, int first);
    /// Positions, orientations and what follows from them.
    void (*advance)(const BatchView& batch, const SubstepParams& params);
    void (*beginPairs)(PairContactLanes* pairs, int count, const SubstepParams& params);
    /// Returns whether any contact presses, or did before.
    int (*solvePairs)(PairContactLanes* pairs, int count, const SubstepParams& params, int useBias);
};

}  // namespace lutka::physics::crowd
