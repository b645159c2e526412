#pragma once

/// What the kernels hold of joints, and of the tree that these make of a doll.

#include "physics/crowd/wide.hpp"

namespace lutka::physics::crowd {

/// What is constant of a constraint, from the profile. Quaternions are x, y, z, w.
struct JointConstants {
    int parent;
    int child;
    int isHinge;
    int isLocked;  ///< Whether its range is so narrow that it does not turn at all; neither a hinge nor a cone then.
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

/// The rows that keep a hinge's axes parallel, as one vector across the axis; or a locked joint from turning at all.
struct HingeRows {
    Wide3 axis;     ///< Zero where the joint is locked: all is across it.
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

}  // namespace lutka::physics::crowd
