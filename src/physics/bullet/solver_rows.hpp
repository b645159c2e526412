#pragma once

#include <btBulletDynamicsCommon.h>

#include "core/simd/vector4.hpp"
#include "physics/bullet/warm_started.hpp"

/// What SubstepSolver sweeps over: bodies and rows as they lie in memory, and the step of each kind of row.
namespace lutka::physics {

using simd::allF4;
using simd::cross;
using simd::crossDifference;
using simd::dot;
using simd::F4;
using simd::inverseOfSymmetric;
using simd::M4;
using simd::sum;

/// A body's share of the solver. `shape`: nothing of it changes within a substep but the velocities.
struct SolverBody {
    F4 velocity{};
    F4 turn{};
    M4 inverseInertia;  ///< World.
    float inverseMass = 0;
    int island = 0;               ///< Of those that touch or are linked.
    btRigidBody* body = nullptr;  ///< Null: the body that never moves.
};

/// The three equations that close a joint's anchors, solved as a block: the impulse acts on B, its opposite on A.
struct PointRows {
    F4 armA{}, armB{};
    M4 turnA, turnB;  ///< Turn of each body by an impulse on it: inverse inertia times (arm ×).
    M4 inverse;       ///< Of their J M⁻¹ Jᵀ.
    F4 mendTarget{};
    F4 impulse{};
};

/// One equation about an axis: axis · (turn of B - turn of A) + softness · impulse = target, with bounds on its
/// impulse.
struct AngularRow {
    F4 axis{};
    F4 turnA{}, turnB{};  ///< Inverse inertias times the axis.
    float inverseEffectiveMass = 0;
    float softness = 0;
    float keepTarget = 0;
    float mendTarget = 0;
    float low = 0;
    float high = 0;
    float impulse = 0;
    RowDuty duty = RowDuty::keeps;
};

/// Dry friction of a joint about all axes at once: a motor of no relative turn whose torque has a bound.
struct TurnFriction {
    M4 mass;  ///< Inverse of the sum of the inverse inertias.
    F4 impulse{};
    float bound = 0;  ///< N m s
};

/// One equation of any kind: J v + softness · impulse = target.
struct GeneralRow {
    F4 linearA{}, angularA{}, linearB{}, angularB{};  ///< J
    F4 turnA{}, turnB{};                              ///< Inverse inertia times the angular parts.
    float inverseEffectiveMass = 0;
    float softness = 0;
    float keepTarget = 0;
    float mendTarget = 0;
    float low = 0;
    float high = 0;
    float impulse = 0;
    RowDuty duty = RowDuty::keeps;
};

/// One direction of a contact.
struct ContactRow {
    F4 direction{};  ///< On A; its opposite on B.
    F4 angularA{}, angularB{};
    F4 turnA{}, turnB{};
    float inverseEffectiveMass = 0;
    float impulse = 0;
};
struct ContactRows {
    int a = 0;  ///< Moves.
    int b = 0;  ///< May be the body that never moves.
    btManifoldPoint* point = nullptr;
    ContactRow normal;
    F4 armA{}, armB{};         ///< From the bodies' centres.
    bool hasFriction = false;  ///< Whether the following were worked out: not before the two press.
    ContactRow tangents[2];
    F4 rolling{};              ///< Impulse that resists rolling, N m s.
    float rollingInertia = 0;  ///< kg m², no more than about any axis.
    float keepTarget = 0;
    float mendTarget = 0;
    float friction = 0;
    float bounceTarget = 0;  ///< Speed of parting that restitution asks for.
};

/// The impulses of many rows on one body, summed up.
struct PushSum {
    F4 linear{};
    F4 angular{};
};

/// Turns an angular row's speed into one of a point, metres: about half a limb's length.
inline constexpr float kResidualArm = 0.1F;

// Each of these changes velocities and impulses and returns the square of the speed by which the row was wrong, m²/s²:
// the largest of many is the same without their roots.

[[nodiscard]] inline float squareOf(float speed) {
    return speed * speed;
}

inline void push(SolverBody& a, SolverBody& b, const PointRows& rows, const F4& impulse) {
    a.velocity -= impulse * allF4(a.inverseMass);
    a.turn -= rows.turnA * impulse;
    b.velocity += impulse * allF4(b.inverseMass);
    b.turn += rows.turnB * impulse;
}
[[nodiscard]] inline float solve(SolverBody& a, SolverBody& b, PointRows& rows, bool mending) {
    const F4 relative = b.velocity - a.velocity + crossDifference(b.turn, rows.armB, a.turn, rows.armA);
    const F4 missing = mending ? rows.mendTarget - relative : -relative;
    const F4 impulse = rows.inverse * missing;
    rows.impulse += impulse;
    push(a, b, rows, impulse);
    return dot(missing, missing);
}

inline void push(SolverBody& a, SolverBody& b, const AngularRow& row, float impulse) {
    a.turn -= row.turnA * allF4(impulse);
    b.turn += row.turnB * allF4(impulse);
}
[[nodiscard]] inline float solve(SolverBody& a, SolverBody& b, AngularRow& row, bool mending) {
    if (mending && row.duty == RowDuty::yields) return 0.0F;
    const float target = mending ? row.mendTarget : row.keepTarget;
    const float missing = target - dot(row.axis, b.turn - a.turn) - row.softness * row.impulse;
    const float wanted = row.impulse + missing * row.inverseEffectiveMass;
    const float impulse = wanted < row.low ? row.low : (wanted > row.high ? row.high : wanted);
    const float change = impulse - row.impulse;
    if (change == 0.0F) return 0.0F;
    push(a, b, row, change);
    row.impulse = impulse;
    return squareOf(kResidualArm * change / row.inverseEffectiveMass);
}

[[nodiscard]] inline float solve(SolverBody& a, SolverBody& b, TurnFriction& friction) {
    const F4 turn = b.turn - a.turn;
    F4 wanted = friction.impulse - friction.mass * turn;
    const float square = dot(wanted, wanted);
    const bool slips = square > friction.bound * friction.bound;
    if (slips) wanted *= allF4(friction.bound / std::sqrt(square));
    const F4 change = wanted - friction.impulse;
    const F4 movedA = a.inverseInertia * change;
    const F4 movedB = b.inverseInertia * change;
    a.turn -= movedA;
    b.turn += movedB;
    friction.impulse = wanted;
    const F4 moved = movedA + movedB;
    return kResidualArm * kResidualArm * dot(moved, moved);
}

inline void push(SolverBody& a, SolverBody& b, const GeneralRow& row, float impulse) {
    a.velocity += row.linearA * allF4(a.inverseMass * impulse);
    a.turn += row.turnA * allF4(impulse);
    b.velocity += row.linearB * allF4(b.inverseMass * impulse);
    b.turn += row.turnB * allF4(impulse);
}
[[nodiscard]] inline float solve(SolverBody& a, SolverBody& b, GeneralRow& row, bool mending) {
    if (mending && row.duty == RowDuty::yields) return 0.0F;
    const float speed =
        sum(row.linearA * a.velocity + row.angularA * a.turn + row.linearB * b.velocity + row.angularB * b.turn);
    const float target = mending ? row.mendTarget : row.keepTarget;
    const float wanted = row.impulse + (target - speed - row.softness * row.impulse) * row.inverseEffectiveMass;
    const float impulse = wanted < row.low ? row.low : (wanted > row.high ? row.high : wanted);
    const float change = impulse - row.impulse;
    if (change == 0.0F) return 0.0F;
    push(a, b, row, change);
    row.impulse = impulse;
    return squareOf(kResidualArm * change / row.inverseEffectiveMass);
}

[[nodiscard]] inline float speedOf(const SolverBody& a, const SolverBody& b, const ContactRow& row) {
    return sum(row.direction * (a.velocity - b.velocity) + row.angularA * a.turn - row.angularB * b.turn);
}
inline void push(SolverBody& a, SolverBody& b, const ContactRow& row, float impulse) {
    a.velocity += row.direction * allF4(a.inverseMass * impulse);
    a.turn += row.turnA * allF4(impulse);
    b.velocity -= row.direction * allF4(b.inverseMass * impulse);
    b.turn -= row.turnB * allF4(impulse);
}

/// A contact's other body never moves: only half of the work, and no waiting for what was last written of that body.
[[nodiscard]] inline float speedOf(const SolverBody& a, const ContactRow& row) {
    return sum(row.direction * a.velocity + row.angularA * a.turn);
}
inline void push(SolverBody& a, const ContactRow& row, float impulse) {
    a.velocity += row.direction * allF4(a.inverseMass * impulse);
    a.turn += row.turnA * allF4(impulse);
}
inline void pushRolling(SolverBody& a, const F4& impulse) {
    a.turn += a.inverseInertia * impulse;
}
inline void pushRolling(SolverBody& a, SolverBody& b, const F4& impulse) {
    a.turn += a.inverseInertia * impulse;
    b.turn -= b.inverseInertia * impulse;
}

/// Both tangents at once, so that the bound is a cone and not a pyramid. `bodies`: both, or the one that moves.
template <class... Bodies>
inline void solveFriction(ContactRows& contact, Bodies&... bodies) {
    float wanted[2];
    for (int i = 0; i < 2; ++i) {
        const ContactRow& row = contact.tangents[i];
        wanted[i] = row.impulse - speedOf(bodies..., row) * row.inverseEffectiveMass;
    }
    const float square = wanted[0] * wanted[0] + wanted[1] * wanted[1];
    const float bound = contact.friction * contact.normal.impulse;
    const float scale = square > bound * bound ? bound / std::sqrt(square) : 1.0F;
    for (int i = 0; i < 2; ++i) {
        ContactRow& row = contact.tangents[i];
        push(bodies..., row, scale * wanted[i] - row.impulse);
        row.impulse = scale * wanted[i];
    }
}

[[nodiscard]] inline F4 turnBetween(const SolverBody& a) {
    return a.turn;
}
[[nodiscard]] inline F4 turnBetween(const SolverBody& a, const SolverBody& b) {
    return a.turn - b.turn;
}

/// Flesh gives way where it rests: the pressure's centre moves ahead of what rolls, by up to `arm` metres.
template <class... Bodies>
inline void solveRolling(ContactRows& contact, float arm, Bodies&... bodies) {
    F4 wanted = contact.rolling - turnBetween(bodies...) * allF4(contact.rollingInertia);
    const float square = dot(wanted, wanted);
    const float bound = arm * contact.normal.impulse;
    if (square > bound * bound) wanted *= allF4(bound / std::sqrt(square));
    pushRolling(bodies..., wanted - contact.rolling);
    contact.rolling = wanted;
}

/// For an impulse along a row: `mass` is the inverse of the effective one.
[[nodiscard]] inline float inverseOf(float mass, float softness) {
    return mass > 1e-12F ? 1.0F / (mass + softness) : 0.0F;
}
inline void setRow(ContactRow& row, const F4& direction, const ContactRows& contact, const SolverBody& a,
                   const SolverBody& b) {
    row.direction = direction;
    row.angularA = cross(contact.armA, direction);
    row.angularB = cross(contact.armB, direction);
    row.turnA = a.inverseInertia * row.angularA;
    row.turnB = b.inverseInertia * row.angularB;
    row.inverseEffectiveMass =
        inverseOf(a.inverseMass + b.inverseMass + dot(row.angularA, row.turnA) + dot(row.angularB, row.turnB), 0.0F);
}
inline void setRow(ContactRow& row, const F4& direction, const ContactRows& contact, const SolverBody& a) {
    row.direction = direction;
    row.angularA = cross(contact.armA, direction);
    row.turnA = a.inverseInertia * row.angularA;
    row.inverseEffectiveMass = inverseOf(a.inverseMass + dot(row.angularA, row.turnA), 0.0F);
}
/// Any unit vector across a unit vector.
[[nodiscard]] inline F4 anyPerpendicular(const F4& v) {
    // Across x or, where that is near, across y.
    const F4 across = std::abs(v[0]) < 0.6F ? F4{0, v[2], -v[1], 0} : F4{-v[2], 0, v[0], 0};
    return across * allF4(1.0F / std::sqrt(dot(across, across)));
}
[[nodiscard]] inline float inverseTrace(const SolverBody& a) {
    return a.inverseInertia.x[0] + a.inverseInertia.y[1] + a.inverseInertia.z[2];
}
template <class... Bodies>
inline void setFriction(ContactRows& contact, const Bodies&... bodies) {
    contact.hasFriction = true;
    const F4 tangent = anyPerpendicular(contact.normal.direction);
    setRow(contact.tangents[0], tangent, contact, bodies...);
    setRow(contact.tangents[1], cross(contact.normal.direction, tangent), contact, bodies...);
    contact.rollingInertia = 1.0F / (inverseTrace(bodies) + ...);
}

template <class... Bodies>
[[nodiscard]] inline float solve(ContactRows& contact, bool mending, float rollingArm, Bodies&... bodies) {
    ContactRow& normal = contact.normal;
    const float target = mending ? contact.mendTarget : contact.keepTarget;
    const float wanted = normal.impulse + (target - speedOf(bodies..., normal)) * normal.inverseEffectiveMass;
    const float impulse = wanted > 0.0F ? wanted : 0.0F;
    const float change = impulse - normal.impulse;
    // What is not touched yet and stays so: friction has no hold either.
    if (change == 0.0F && impulse == 0.0F) return 0.0F;
    push(bodies..., normal, change);
    normal.impulse = impulse;
    if (!mending) {  // friction yields
        if (!contact.hasFriction) setFriction(contact, bodies...);
        solveFriction(contact, bodies...);
        solveRolling(contact, rollingArm, bodies...);
    }
    return normal.inverseEffectiveMass > 0.0F ? squareOf(change / normal.inverseEffectiveMass) : 0.0F;
}

// Warm starting, for each kind of rows. gather(): what the kept impulses do to the two bodies. Then the work that their
// targets ask of them (target · impulse), that of their softness (softness · impulse²), and the part that is applied.

inline void gather(PushSum& a, PushSum& b, const PointRows& rows) {
    a.linear -= rows.impulse;
    a.angular -= cross(rows.armA, rows.impulse);
    b.linear += rows.impulse;
    b.angular += cross(rows.armB, rows.impulse);
}
inline void gather(PushSum& a, PushSum& b, const TurnFriction& friction) {
    a.angular -= friction.impulse;
    b.angular += friction.impulse;
}
inline void gather(PushSum& a, PushSum& b, const AngularRow& row) {
    a.angular -= row.axis * allF4(row.impulse);
    b.angular += row.axis * allF4(row.impulse);
}
inline void gather(PushSum& a, PushSum& b, const GeneralRow& row) {
    a.linear += row.linearA * allF4(row.impulse);
    a.angular += row.angularA * allF4(row.impulse);
    b.linear += row.linearB * allF4(row.impulse);
    b.angular += row.angularB * allF4(row.impulse);
}
inline void gather(PushSum& a, PushSum& b, const ContactRows& contact) {
    for (const ContactRow* row : {&contact.normal, &contact.tangents[0], &contact.tangents[1]}) {
        a.linear += row->direction * allF4(row->impulse);
        a.angular += row->angularA * allF4(row->impulse);
        b.linear -= row->direction * allF4(row->impulse);
        b.angular -= row->angularB * allF4(row->impulse);
    }
    a.angular += contact.rolling;
    b.angular -= contact.rolling;
}

template <class Rows>
[[nodiscard]] inline float targetWork(const Rows& /*rows*/) {
    return 0.0F;
}
[[nodiscard]] inline float targetWork(const AngularRow& row) {
    return row.keepTarget * row.impulse;
}
[[nodiscard]] inline float targetWork(const GeneralRow& row) {
    return row.keepTarget * row.impulse;
}
[[nodiscard]] inline float targetWork(const ContactRows& contact) {
    return contact.keepTarget * contact.normal.impulse;
}
template <class Rows>
[[nodiscard]] inline float softnessWork(const Rows& /*rows*/) {
    return 0.0F;
}
[[nodiscard]] inline float softnessWork(const GeneralRow& row) {
    return row.softness * row.impulse * row.impulse;
}

inline void applyShare(SolverBody& a, SolverBody& b, PointRows& rows, float share) {
    rows.impulse *= allF4(share);
    push(a, b, rows, rows.impulse);
}
inline void applyShare(SolverBody& a, SolverBody& b, TurnFriction& friction, float share) {
    friction.impulse *= allF4(share);
    a.turn -= a.inverseInertia * friction.impulse;
    b.turn += b.inverseInertia * friction.impulse;
}
template <class Row>  // AngularRow, GeneralRow, ContactRow
inline void applyShare(SolverBody& a, SolverBody& b, Row& row, float share) {
    row.impulse *= share;
    push(a, b, row, row.impulse);
}
inline void applyShare(SolverBody& a, SolverBody& b, ContactRows& contact, float share) {
    for (ContactRow* row : {&contact.normal, &contact.tangents[0], &contact.tangents[1]})
        applyShare(a, b, *row, share);
    contact.rolling *= allF4(share);
    pushRolling(a, b, contact.rolling);
}

}  // namespace lutka::physics
