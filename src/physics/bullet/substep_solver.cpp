#include "physics/bullet/substep_solver.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

#include "physics/bullet/convert.hpp"

namespace lutka::physics {
namespace {

constexpr int kFixed = 0;  // index of the body that never moves

// Turns an angular row's speed into one of a point, metres: about half a limb's length.
constexpr float kResidualArm = 0.1F;

}  // namespace

int SubstepSolver::indexOf(const btCollisionObject& object) const {
    // A body of an earlier substep that sleeps now, or was never here, must not be taken for another.
    const int index = object.getCompanionId();
    const bool mine = index > kFixed && index < static_cast<int>(bodies_.size()) && bodies_[index].body == &object;
    return mine ? index : kFixed;
}

void SubstepSolver::takeBodies(std::span<btRigidBody* const> bodies, float seconds) {
    bodies_.assign(1, Body{});
    islandOfTag_.clear();
    islands_.clear();
    for (btRigidBody* body : bodies) {
        if (!body->isActive() || body->isStaticOrKinematicObject()) continue;
        body->setCompanionId(static_cast<int>(bodies_.size()));
        Body taken;
        taken.body = body;
        taken.island = islandOf(body->getIslandTag());
        taken.inverseMass = body->getInvMass();
        taken.inverseInertia = fromBullet(body->getInvInertiaTensorWorld());
        taken.velocity = fromBullet(body->getLinearVelocity() + body->getTotalForce() * body->getInvMass() * seconds);
        taken.turn = fromBullet(body->getAngularVelocity() +
                                body->getInvInertiaTensorWorld() * body->getTotalTorque() * seconds);
        if ((body->getFlags() & BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY) != 0)
            taken.turn += fromBullet(body->computeGyroscopicImpulseImplicit_Body(seconds));
        bodies_.push_back(taken);
    }
}

// Bullet's tags are any numbers; ours count from 0 in the order of the bodies.
int SubstepSolver::islandOf(int tag) {
    if (tag >= static_cast<int>(islandOfTag_.size())) islandOfTag_.resize(tag + 1, -1);
    if (tag >= 0 && islandOfTag_[tag] >= 0) return islandOfTag_[tag];
    const int island = static_cast<int>(islands_.size());
    islands_.emplace_back();
    if (tag >= 0) islandOfTag_[tag] = island;
    return island;
}

void SubstepSolver::finishRow(Row& row, int a, int b) const {
    row.turnA = bodies_[a].inverseInertia * row.angularA;
    row.turnB = bodies_[b].inverseInertia * row.angularB;
    const float mass = bodies_[a].inverseMass * glm::dot(row.linearA, row.linearA) + glm::dot(row.angularA, row.turnA) +
                       bodies_[b].inverseMass * glm::dot(row.linearB, row.linearB) + glm::dot(row.angularB, row.turnB);
    row.inverseEffectiveMass = mass > 1e-12F ? 1.0F / (mass + row.softness) : 0.0F;
}

void SubstepSolver::takeConstraints(std::span<btTypedConstraint* const> constraints, float seconds) {
    joints_.clear();
    rows_.clear();
    for (btTypedConstraint* constraint : constraints) {
        const bool active = constraint->getRigidBodyA().isActive() || constraint->getRigidBodyB().isActive();
        if (constraint->isEnabled() && active) takeConstraint(*constraint, seconds);
    }
}

// Bullet's own protocol: the constraint writes its rows through pointers into solver rows.
int SubstepSolver::askRows(btTypedConstraint& constraint, float seconds) {
    btTypedConstraint::btConstraintInfo1 size{};
    constraint.buildJacobian();
    constraint.getInfo1(&size);
    if (size.m_numConstraintRows == 0) return 0;
    scratch_.resizeNoInitialize(size.m_numConstraintRows);
    for (int i = 0; i < size.m_numConstraintRows; ++i) {
        btSolverConstraint& row = scratch_[i];
        row.m_contactNormal1.setZero();
        row.m_contactNormal2.setZero();
        row.m_relpos1CrossNormal.setZero();
        row.m_relpos2CrossNormal.setZero();
        row.m_rhs = row.m_cfm = 0.0F;
        row.m_lowerLimit = -SIMD_INFINITY;
        row.m_upperLimit = SIMD_INFINITY;
    }
    btTypedConstraint::btConstraintInfo2 info{};
    info.fps = 1.0F / seconds;
    info.erp = 0.2F;  // Bullet's default, for constraints that are not ours
    info.m_J1linearAxis = scratch_[0].m_contactNormal1;
    info.m_J1angularAxis = scratch_[0].m_relpos1CrossNormal;
    info.m_J2linearAxis = scratch_[0].m_contactNormal2;
    info.m_J2angularAxis = scratch_[0].m_relpos2CrossNormal;
    info.rowskip = sizeof(btSolverConstraint) / sizeof(btScalar);
    info.m_constraintError = &scratch_[0].m_rhs;
    info.cfm = &scratch_[0].m_cfm;
    info.m_lowerLimit = &scratch_[0].m_lowerLimit;
    info.m_upperLimit = &scratch_[0].m_upperLimit;
    info.m_numIterations = tuning_.sweeps;
    info.m_damping = 1.0F;
    constraint.getInfo2(&info);
    return size.m_numConstraintRows;
}

void SubstepSolver::takeConstraint(btTypedConstraint& constraint, float seconds) {
    Joint joint;
    joint.count = askRows(constraint, seconds);
    if (joint.count == 0) return;
    joint.a = indexOf(constraint.getRigidBodyA());
    joint.b = indexOf(constraint.getRigidBodyB());
    // A drag's other body is Bullet's fixed one, which always counts as active: on a sleeping doll nothing is left to
    // move, and there is no island to take it into.
    if (joint.a == kFixed && joint.b == kFixed) return;
    joint.first = static_cast<int>(rows_.size());
    joint.constraint = &constraint;
    joint.warm = dynamic_cast<WarmStarted*>(&constraint);
    joint.block = joint.warm != nullptr && joint.warm->startsWithPoint();
    for (int i = 0; i < joint.count; ++i) {
        const btSolverConstraint& given = scratch_[i];
        Row row;
        row.linearA = fromBullet(given.m_contactNormal1);
        row.angularA = fromBullet(given.m_relpos1CrossNormal);
        row.linearB = fromBullet(given.m_contactNormal2);
        row.angularB = fromBullet(given.m_relpos2CrossNormal);
        row.mendTarget = given.m_rhs;
        if (joint.warm != nullptr) {
            row.duty = joint.warm->dutyOf(i);
            row.softness = joint.warm->softnessOf(i);
        }
        row.keepTarget = row.duty == RowDuty::mends ? 0.0F : given.m_rhs;
        row.low = given.m_lowerLimit;
        row.high = given.m_upperLimit;
        if (joint.warm != nullptr && tuning_.warmStart)
            row.impulse = std::clamp(joint.warm->storedImpulse(i), row.low, row.high);
        finishRow(row, joint.a, joint.b);
        rows_.push_back(row);
    }
    if (joint.block) joint.inverseBlock = inverseBlockOf(joint);
    joints_.push_back(joint);
}

mat3 SubstepSolver::inverseBlockOf(const Joint& joint) const {
    mat3 block(0);
    for (int i = 0; i < 3; ++i) {
        const Row& p = rows_[joint.first + i];
        for (int k = 0; k < 3; ++k) {
            const Row& q = rows_[joint.first + k];
            block[k][i] = bodies_[joint.a].inverseMass * glm::dot(p.linearA, q.linearA) +
                          bodies_[joint.b].inverseMass * glm::dot(p.linearB, q.linearB) +
                          glm::dot(p.angularA, q.turnA) + glm::dot(p.angularB, q.turnB);
        }
    }
    return glm::inverse(block);
}

void SubstepSolver::takeContacts(btDispatcher& dispatcher, float seconds) {
    contacts_.clear();
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
        btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
        const int a = indexOf(*manifold.getBody0());
        const int b = indexOf(*manifold.getBody1());
        if (a == b || !dispatcher.needsResponse(manifold.getBody0(), manifold.getBody1())) continue;
        for (int k = 0; k < manifold.getNumContacts(); ++k)
            takePoint(manifold.getContactPoint(k), a, b, seconds);
    }
}

void SubstepSolver::takePoint(btManifoldPoint& point, int a, int b, float seconds) {
    Contact contact;
    contact.a = a;
    contact.b = b;
    contact.point = &point;
    contact.friction = point.m_combinedFriction;
    const vec3 normal = fromBullet(point.m_normalWorldOnB);
    const vec3 middle = 0.5F * fromBullet(point.getPositionWorldOnA() + point.getPositionWorldOnB());
    const auto arm = [&](int body) {
        return bodies_[body].body != nullptr ? middle - fromBullet(bodies_[body].body->getCenterOfMassPosition())
                                             : vec3(0);
    };
    const vec3 armA = arm(a);
    const vec3 armB = arm(b);
    const auto along = [&](Row& row, const vec3& direction) {
        row.linearA = direction;
        row.linearB = -direction;
        row.angularA = glm::cross(armA, direction);
        row.angularB = -glm::cross(armB, direction);
        finishRow(row, a, b);
    };
    along(contact.normal, normal);
    contact.normal.high = std::numeric_limits<float>::max();
    const vec3 tangent = anyPerpendicular(normal);
    along(contact.tangents[0], tangent);
    along(contact.tangents[1], glm::cross(normal, tangent));
    const mat3 inverseInertia = bodies_[a].inverseInertia + bodies_[b].inverseInertia;
    contact.rollingInertia = 1.0F / (inverseInertia[0][0] + inverseInertia[1][1] + inverseInertia[2][2]);
    const float distance = point.getDistance();
    if (distance > 0.0F) {
        // Not there yet: only the speed that would arrive within the substep is bounded.
        contact.normal.mendTarget = contact.normal.keepTarget = -distance / seconds;
    } else {
        contact.normal.mendTarget = std::min(
            -tuning_.contactErp * std::min(distance + tuning_.contactSlop, 0.0F) / seconds, tuning_.maxPushSpeed);
    }
    const float approach = speedAlong(contact.normal, a, b);
    constexpr float kBounceSpeed = 0.5F;  // m/s: slower impacts don't bounce
    if (point.m_combinedRestitution > 0.0F && approach < -kBounceSpeed)
        contact.bounceTarget = -point.m_combinedRestitution * approach;
    if (tuning_.warmStart) {
        contact.normal.impulse = point.m_appliedImpulse;
        contact.tangents[0].impulse = point.m_appliedImpulseLateral1;
        contact.tangents[1].impulse = point.m_appliedImpulseLateral2;
    }
    contacts_.push_back(contact);
}

float SubstepSolver::speedAlong(const Row& row, int a, int b) const {
    return glm::dot(row.linearA, bodies_[a].velocity) + glm::dot(row.angularA, bodies_[a].turn) +
           glm::dot(row.linearB, bodies_[b].velocity) + glm::dot(row.angularB, bodies_[b].turn);
}

void SubstepSolver::apply(const Row& row, int a, int b, float impulse) {
    bodies_[a].velocity += row.linearA * (bodies_[a].inverseMass * impulse);
    bodies_[a].turn += row.turnA * impulse;
    bodies_[b].velocity += row.linearB * (bodies_[b].inverseMass * impulse);
    bodies_[b].turn += row.turnB * impulse;
}

float SubstepSolver::solveRow(Row& row, int a, int b, bool mending) {
    if (mending && row.duty == RowDuty::yields) return 0.0F;
    const float target = mending ? row.mendTarget : row.keepTarget;
    const float wanted =
        row.impulse + (target - speedAlong(row, a, b) - row.softness * row.impulse) * row.inverseEffectiveMass;
    const float impulse = std::clamp(wanted, row.low, row.high);
    const float change = impulse - row.impulse;
    apply(row, a, b, change);
    row.impulse = impulse;
    return row.inverseEffectiveMass > 0.0F ? std::abs(change) / row.inverseEffectiveMass : 0.0F;
}

float SubstepSolver::solveJoint(Joint& joint, bool mending) {
    Row* rows = &rows_[joint.first];
    const int firstScalar = joint.block ? 3 : 0;
    float residual = 0;
    for (int i = firstScalar; i < joint.count; ++i)
        residual = std::max(residual, kResidualArm * solveRow(rows[i], joint.a, joint.b, mending));
    if (!joint.block) return residual;
    vec3 missing;
    for (int i = 0; i < 3; ++i)
        missing[i] = (mending ? rows[i].mendTarget : rows[i].keepTarget) - speedAlong(rows[i], joint.a, joint.b);
    const vec3 impulse = joint.inverseBlock * missing;
    for (int i = 0; i < 3; ++i) {
        apply(rows[i], joint.a, joint.b, impulse[i]);
        rows[i].impulse += impulse[i];
    }
    return std::max(residual, glm::length(missing));
}

float SubstepSolver::solveContact(Contact& contact, bool mending) {
    const float residual = solveRow(contact.normal, contact.a, contact.b, mending);
    if (mending) return residual;  // friction yields
    // Both tangents at once, so that the bound is a cone and not a pyramid.
    vec2 wanted;
    for (int i = 0; i < 2; ++i) {
        const Row& row = contact.tangents[i];
        wanted[i] = row.impulse - speedAlong(row, contact.a, contact.b) * row.inverseEffectiveMass;
    }
    const float length = glm::length(wanted);
    const float bound = contact.friction * contact.normal.impulse;
    if (length > bound) wanted *= length > 0.0F ? bound / length : 0.0F;
    for (int i = 0; i < 2; ++i) {
        apply(contact.tangents[i], contact.a, contact.b, wanted[i] - contact.tangents[i].impulse);
        contact.tangents[i].impulse = wanted[i];
    }
    solveRolling(contact);
    return residual;
}

// Flesh gives way where it rests: the pressure's centre moves ahead of what rolls, by up to `rollingArm`.
void SubstepSolver::solveRolling(Contact& contact) {
    Body& a = bodies_[contact.a];
    Body& b = bodies_[contact.b];
    vec3 wanted = contact.rolling - (a.turn - b.turn) * contact.rollingInertia;
    const float length = glm::length(wanted);
    const float bound = tuning_.rollingArm * contact.normal.impulse;
    if (length > bound) wanted *= length > 0.0F ? bound / length : 0.0F;
    const vec3 change = wanted - contact.rolling;
    a.turn += a.inverseInertia * change;
    b.turn -= b.inverseInertia * change;
    contact.rolling = wanted;
}

// Old impulses in a new geometry can be far from the answer, and too few sweeps don't take back what they added: a doll
// that lands hard would be thrown up. So an island takes them only as far as they lessen what the sweeps minimise, the
// energy of D(s) = s²/2 |M⁻¹p|² + s (p·v - target·impulse): its minimum is at s = (target·impulse - p·v) / |M⁻¹p|².
// From there every row's step lessens it further, so that no substep adds energy, whatever the number of sweeps.
void SubstepSolver::warmStart() {
    if (!tuning_.warmStart) return;
    pushes_.assign(bodies_.size(), Push{});
    const auto gather = [&](const Row& row, int a, int b) {
        pushes_[a].linear += row.linearA * row.impulse;
        pushes_[a].angular += row.angularA * row.impulse;
        pushes_[b].linear += row.linearB * row.impulse;
        pushes_[b].angular += row.angularB * row.impulse;
        Island& island = islands_[bodies_[a != kFixed ? a : b].island];
        island.gain += row.keepTarget * row.impulse;
        island.square += row.softness * row.impulse * row.impulse;
    };
    forEachRow(gather);
    for (std::size_t i = 1; i < bodies_.size(); ++i) {
        const Body& body = bodies_[i];
        const Push& push = pushes_[i];
        Island& island = islands_[body.island];
        island.gain -= glm::dot(push.linear, body.velocity) + glm::dot(push.angular, body.turn);
        island.square += body.inverseMass * glm::dot(push.linear, push.linear) +
                         glm::dot(push.angular, body.inverseInertia * push.angular);
    }
    for (Island& island : islands_)
        island.share = island.square > 0.0F ? std::clamp(island.gain / island.square, 0.0F, 1.0F) : 0.0F;
    forEachRow([&](Row& row, int a, int b) {
        row.impulse *= islands_[bodies_[a != kFixed ? a : b].island].share;
        apply(row, a, b, row.impulse);
    });
}

template <class Visit>
void SubstepSolver::forEachRow(const Visit& visit) {
    for (const Joint& joint : joints_) {
        for (int i = 0; i < joint.count; ++i)
            visit(rows_[joint.first + i], joint.a, joint.b);
    }
    for (Contact& contact : contacts_) {
        visit(contact.normal, contact.a, contact.b);
        for (Row& tangent : contact.tangents)
            visit(tangent, contact.a, contact.b);
    }
}

// Puts joints and contacts in the order of their islands, which are then solved one after the other.
void SubstepSolver::sortByIsland() {
    for (Island& island : islands_)
        island = Island{};
    const auto islandOfPair = [&](int a, int b) -> Island& { return islands_[bodies_[a != kFixed ? a : b].island]; };
    for (const Joint& joint : joints_)
        ++islandOfPair(joint.a, joint.b).joints;
    for (const Contact& contact : contacts_)
        ++islandOfPair(contact.a, contact.b).contacts;
    int joints = 0;
    int contacts = 0;
    for (Island& island : islands_) {
        island.firstJoint = joints;
        island.firstContact = contacts;
        joints += std::exchange(island.joints, 0);
        contacts += std::exchange(island.contacts, 0);
    }
    jointOrder_.resize(joints_.size());
    contactOrder_.resize(contacts_.size());
    for (std::size_t i = 0; i < joints_.size(); ++i) {
        Island& island = islandOfPair(joints_[i].a, joints_[i].b);
        jointOrder_[island.firstJoint + island.joints++] = static_cast<int>(i);
    }
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        Island& island = islandOfPair(contacts_[i].a, contacts_[i].b);
        contactOrder_[island.firstContact + island.contacts++] = static_cast<int>(i);
    }
}

// One sweep, forth or back: impulses travel up a limb as fast as down. Returns the largest speed that a row was wrong
// by, m/s.
float SubstepSolver::sweep(const Island& island, bool mending, bool forth) {
    float residual = 0;
    for (int i = 0; i < island.joints; ++i) {
        const int at = island.firstJoint + (forth ? i : island.joints - 1 - i);
        residual = std::max(residual, solveJoint(joints_[jointOrder_[at]], mending));
    }
    for (int i = 0; i < island.contacts; ++i) {
        const int at = island.firstContact + (forth ? i : island.contacts - 1 - i);
        residual = std::max(residual, solveContact(contacts_[contactOrder_[at]], mending));
    }
    return residual;
}

// A doll that lies still is solved in a few sweeps, one that hits the floor needs many.
void SubstepSolver::iterate(bool mending) {
    const int most = mending ? tuning_.mendSweeps : tuning_.sweeps;
    for (const Island& island : islands_) {
        for (int i = 0; i < most; ++i) {
            const float residual = sweep(island, mending, i % 2 == 0);
            if (i + 1 >= tuning_.leastSweeps && residual < tuning_.tolerance) break;
        }
    }
}

// What lies nearly still is brought to rest: capsules would roll on for long, which skin and cloth never do.
void SubstepSolver::calm(float seconds) {
    const float keep = std::max(1.0F - tuning_.restDamping * seconds, 0.0F);
    for (std::size_t i = 1; i < bodies_.size(); ++i) {
        Body& body = bodies_[i];
        const bool slow = glm::dot(body.velocity, body.velocity) < tuning_.restSpeed * tuning_.restSpeed &&
                          glm::dot(body.turn, body.turn) < tuning_.restTurn * tuning_.restTurn;
        if (!slow || islands_[body.island].contacts == 0) continue;
        body.velocity *= keep;
        body.turn *= keep;
    }
}

void SubstepSolver::bounce() {
    for (Contact& contact : contacts_) {
        if (contact.bounceTarget <= 0.0F || contact.normal.impulse <= 0.0F) continue;
        Row& row = contact.normal;
        const float more = std::max(contact.bounceTarget - speedAlong(row, contact.a, contact.b), 0.0F);
        apply(row, contact.a, contact.b, more * row.inverseEffectiveMass);
        row.impulse += more * row.inverseEffectiveMass;
    }
}

void SubstepSolver::storeFeedback(const Joint& joint, float seconds) const {
    btJointFeedback* feedback = joint.constraint->getJointFeedback();
    if (feedback == nullptr) return;
    vec3 forceA(0), torqueA(0), forceB(0), torqueB(0);
    for (int i = 0; i < joint.count; ++i) {
        const Row& row = rows_[joint.first + i];
        forceA += row.linearA * (row.impulse / seconds);
        torqueA += row.angularA * (row.impulse / seconds);
        forceB += row.linearB * (row.impulse / seconds);
        torqueB += row.angularB * (row.impulse / seconds);
    }
    feedback->m_appliedForceBodyA = toBullet(forceA);
    feedback->m_appliedTorqueBodyA = toBullet(torqueA);
    feedback->m_appliedForceBodyB = toBullet(forceB);
    feedback->m_appliedTorqueBodyB = toBullet(torqueB);
}

void SubstepSolver::store(float seconds) {
    for (const Joint& joint : joints_) {
        storeFeedback(joint, seconds);
        if (joint.warm == nullptr) continue;
        for (int i = 0; i < joint.count; ++i)
            joint.warm->storeImpulse(i, rows_[joint.first + i].impulse);
        joint.warm->finishStoring();
    }
    for (const Contact& contact : contacts_) {
        contact.point->m_appliedImpulse = contact.normal.impulse;
        contact.point->m_appliedImpulseLateral1 = contact.tangents[0].impulse;
        contact.point->m_appliedImpulseLateral2 = contact.tangents[1].impulse;
    }
    for (std::size_t i = 1; i < bodies_.size(); ++i) {
        bodies_[i].body->setLinearVelocity(toBullet(bodies_[i].velocity));
        bodies_[i].body->setAngularVelocity(toBullet(bodies_[i].turn));
    }
}

void SubstepSolver::solve(std::span<btRigidBody* const> bodies, std::span<btTypedConstraint* const> constraints,
                          btDispatcher& dispatcher, float seconds) {
    takeBodies(bodies, seconds);
    takeConstraints(constraints, seconds);
    takeContacts(dispatcher, seconds);
    sortByIsland();
    calm(seconds);
    warmStart();
    iterate(false);
    bounce();
    store(seconds);
    iterate(true);
}

void SubstepSolver::moveBodies(float seconds) {
    for (std::size_t i = 1; i < bodies_.size(); ++i) {
        btRigidBody& body = *bodies_[i].body;
        btTransform moved;
        btTransformUtil::integrateTransform(body.getWorldTransform(), toBullet(bodies_[i].velocity),
                                            toBullet(bodies_[i].turn), seconds, moved);
        body.proceedToTransform(moved);
    }
}

}  // namespace lutka::physics
