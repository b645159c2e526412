#include "physics/bullet/substep_solver.hpp"

#include <algorithm>
#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <tuple>
#include <utility>

#include "physics/bullet/contact_impulses.hpp"
#include "physics/bullet/convert.hpp"
#include "physics/bullet/fetch_ahead.hpp"
#include "physics/bullet/island_momentum.hpp"

namespace lutka::physics {
namespace {

constexpr int kFixed = SubstepRows::kFixed;

F4 toF4(const btVector3& v) {
    return F4{v.x(), v.y(), v.z(), 0.0F};
}
F4 toF4(const vec3& v) {
    return F4{v.x, v.y, v.z, 0.0F};
}
btVector3 toBullet(const F4& v) {
    return {v[0], v[1], v[2]};
}
// The columns of a symmetric matrix are its rows.
M4 toM4(const btMatrix3x3& symmetric) {
    return {toF4(symmetric[0]), toF4(symmetric[1]), toF4(symmetric[2])};
}

// Change of the turn in a substep by the torque that keeps a free body's angular momentum: one Newton step of the
// implicit equation in the body's frame, as Bullet's computeGyroscopicImpulseImplicit_Body() takes it (Catto, GDC
// 2015).
F4 gyroscopicChange(const btRigidBody& body, float seconds) {
    const btMatrix3x3& basis = body.getWorldTransform().getBasis();
    const M4 bodyFromWorld{toF4(basis[0]), toF4(basis[1]), toF4(basis[2])};
    const F4 inertia = toF4(body.getLocalInertia());
    const F4 turn = bodyFromWorld * toF4(body.getAngularVelocity());
    const F4 momentum = inertia * turn;
    const F4 step = allF4(seconds);
    const auto column = [&](const F4& unit) {
        const F4 own = inertia * unit;
        return own + step * (cross(turn, own) - cross(momentum, unit));
    };
    const F4 x = column(F4{1, 0, 0, 0});
    const F4 y = column(F4{0, 1, 0, 0});
    const F4 z = column(F4{0, 0, 1, 0});
    const F4 wrong = step * cross(turn, momentum);
    const F4 yz = cross(y, z);
    const float scale = -1.0F / dot(x, yz);
    const F4 change{scale * dot(yz, wrong), scale * dot(cross(z, x), wrong), scale * dot(cross(x, y), wrong), 0.0F};
    return F4{dot(bodyFromWorld.x, change), dot(bodyFromWorld.y, change), dot(bodyFromWorld.z, change), 0.0F};
}

// Change of a body's turn by an impulse at the end of an arm, by columns.
M4 turnBy(const SolverBody& body, const F4& arm) {
    return {body.inverseInertia * F4{0.0F, arm[2], -arm[1], 0.0F},
            body.inverseInertia * F4{-arm[2], 0.0F, arm[0], 0.0F},
            body.inverseInertia * F4{arm[1], -arm[0], 0.0F, 0.0F}};
}

}  // namespace

int SubstepSolver::indexOf(const btCollisionObject& object) const {
    // A body of an earlier substep that sleeps now, or was never here, must not be taken for another.
    const int index = object.getCompanionId();
    const bool mine =
        index > kFixed && index < static_cast<int>(rows_.bodies.size()) && rows_.bodies[index].body == &object;
    return mine ? index : kFixed;
}

void SubstepSolver::takeBodies(std::span<btRigidBody* const> bodies) {
    unsorted_.clear();
    islandOfTag_.clear();
    rows_.islands.clear();
    for (btRigidBody* body : bodies) {
        if (!body->isActive() || body->isStaticOrKinematicObject()) continue;
        SolverBody& taken = unsorted_.emplace_back();
        taken.body = body;
        taken.island = islandOf(body->getIslandTag());
        ++rows_.islands[taken.island].bodies;
    }
    rows_.bodies.resize(1 + unsorted_.size());
    rows_.bodies[kFixed] = SolverBody{};
    int at = kFixed + 1;
    for (Island& island : rows_.islands) {
        island.firstBody = at;
        at += std::exchange(island.bodies, 0);
    }
    for (const SolverBody& body : unsorted_) {
        Island& island = rows_.islands[body.island];
        const int index = island.firstBody + island.bodies++;
        body.body->setCompanionId(index);
        rows_.bodies[index] = body;
    }
}

void SubstepSolver::takeBody(SolverBody& taken, float seconds) {
    const btRigidBody& body = *taken.body;
    taken.inverseMass = body.getInvMass();
    taken.inverseInertia = toM4(body.getInvInertiaTensorWorld());
    taken.velocity = toF4(body.getLinearVelocity()) + toF4(body.getTotalForce()) * allF4(taken.inverseMass * seconds);
    taken.turn =
        toF4(body.getAngularVelocity()) + taken.inverseInertia * (toF4(body.getTotalTorque()) * allF4(seconds));
    if ((body.getFlags() & BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY) != 0)
        taken.turn += gyroscopicChange(body, seconds);
}

// Bullet's tags are any numbers; ours count from 0 in the order of the bodies.
int SubstepSolver::islandOf(int tag) {
    if (tag >= static_cast<int>(islandOfTag_.size())) islandOfTag_.resize(tag + 1, -1);
    if (tag >= 0 && islandOfTag_[tag] >= 0) return islandOfTag_[tag];
    const int island = static_cast<int>(rows_.islands.size());
    rows_.islands.emplace_back();
    if (tag >= 0) islandOfTag_[tag] = island;
    return island;
}

void SubstepSolver::takeLinks(std::span<btTypedConstraint* const> constraints) {
    unsortedLinks_.clear();
    for (btTypedConstraint* constraint : constraints) {
        if (!constraint->isEnabled()) continue;
        const Link link{constraint, indexOf(constraint->getRigidBodyA()), indexOf(constraint->getRigidBodyB())};
        // A drag's other body is Bullet's fixed one, which always counts as active: on a sleeping doll nothing is left
        // to move, and there is no island to take it into.
        if (link.a != kFixed || link.b != kFixed) unsortedLinks_.push_back(link);
    }
    sortByIsland(unsortedLinks_, links_, &Island::firstLink, &Island::links);
}

void SubstepSolver::takeTouches(btDispatcher& dispatcher) {
    unsortedTouches_.clear();
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
        btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
        if (manifold.getNumContacts() == 0) continue;
        const Touch touch{&manifold, indexOf(*manifold.getBody0()), indexOf(*manifold.getBody1())};
        if (touch.a != touch.b) unsortedTouches_.push_back(touch);
    }
    sortByIsland(unsortedTouches_, touches_, &Island::firstTouch, &Island::touches);
    // Bullet fills the place of a manifold that ends with its last one, so that what happens to one doll would change
    // the order of another's contacts, and with it their bits.
    const auto placeOf = [](const btCollisionObject* object) { return object->getWorldArrayIndex(); };
    const auto key = [&](const Touch& touch) {
        return std::tuple(touch.a, touch.b, placeOf(touch.what->getBody0()), placeOf(touch.what->getBody1()));
    };
    for (const Island& island : rows_.islands) {
        const std::span touches = std::span(touches_).subspan(island.firstTouch, island.touches);
        std::sort(touches.begin(), touches.end(), [&](const Touch& x, const Touch& y) { return key(x) < key(y); });
    }
}

template <class T>
void SubstepSolver::sortByIsland(std::vector<T>& all, std::vector<T>& sorted, int Island::*first, int Island::*count) {
    for (const T& one : all)
        ++(rows_.islandOfPair(one.a, one.b).*count);
    int at = 0;
    for (Island& island : rows_.islands) {
        island.*first = at;
        at += std::exchange(island.*count, 0);
    }
    sorted.resize(all.size());
    for (const T& one : all) {
        Island& island = rows_.islandOfPair(one.a, one.b);
        sorted[island.*first + (island.*count)++] = one;
    }
}

void SubstepSolver::takeRows(std::span<Island> islands, float seconds) {
    rows_.joints.clear();
    rows_.points.clear();
    rows_.frictions.clear();
    rows_.angulars.clear();
    rows_.generals.clear();
    rows_.contacts.clear();
    for (Island& island : islands) {
        takeBodiesOf(island, seconds);
        takeLinksOf(island, seconds);
        takeTouchesOf(island, seconds);
    }
}

void SubstepSolver::takeBodiesOf(const Island& island, float seconds) {
    const std::span bodies = rows_.bodiesOf(island);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (i + 1 < bodies.size()) fetchAhead(bodies[i + 1].body, sizeof(btRigidBody));
        takeBody(bodies[i], seconds);
    }
}

void SubstepSolver::takeLinksOf(Island& island, float seconds) {
    island.firstJoint = static_cast<int>(rows_.joints.size());
    const std::span links = std::span(links_).subspan(island.firstLink, island.links);
    for (std::size_t i = 0; i < links.size(); ++i) {
        const Link& link = links[i];
        if (i + 1 < links.size()) fetchAhead(links[i + 1].what, sizeof(RagdollJoint));
        if (link.what->getUserConstraintType() == RagdollJoint::kUserType)
            takeRagdollJoint(static_cast<RagdollJoint&>(*link.what), link, seconds);
        else
            takeConstraint(link, seconds);
    }
    island.joints = static_cast<int>(rows_.joints.size()) - island.firstJoint;
}

void SubstepSolver::takeTouchesOf(Island& island, float seconds) {
    island.firstContact = static_cast<int>(rows_.contacts.size());
    const std::span touches = std::span(touches_).subspan(island.firstTouch, island.touches);
    for (std::size_t k = 0; k < touches.size(); ++k) {
        const Touch& touch = touches[k];
        if (k + 1 < touches.size()) fetchAhead(touches[k + 1].what, 2 * sizeof(btManifoldPoint));
        for (int i = 0; i < touch.what->getNumContacts(); ++i)
            takeContact(touch.what->getContactPoint(i), touch.a, touch.b, seconds);
    }
    island.contacts = static_cast<int>(rows_.contacts.size()) - island.firstContact;
}

void SubstepSolver::takeRagdollJoint(RagdollJoint& constraint, const Link& link, float seconds) {
    Joint joint;
    joint.a = link.a;
    joint.b = link.b;
    constraint.prepare();
    joint.constraint = &constraint;
    joint.ragdoll = &constraint;
    joint.point = static_cast<int>(rows_.points.size());
    joint.firstAngular = static_cast<int>(rows_.angulars.size());
    const int rows = static_cast<int>(constraint.angularRows().size());
    const int frictionRows = constraint.frictionRows();
    joint.angulars = rows - frictionRows;
    takePoint(constraint, joint, 1.0F / seconds);
    if (frictionRows > 0) {
        joint.friction = static_cast<int>(rows_.frictions.size());
        takeFriction(constraint, joint, 1.0F / seconds);
    }
    for (int i = frictionRows; i < rows; ++i)
        takeAngular(constraint, joint, i, 1.0F / seconds);
    rows_.joints.push_back(joint);
}

void SubstepSolver::takeFriction(const RagdollJoint& constraint, const Joint& joint, float rate) {
    TurnFriction& friction = rows_.frictions.emplace_back();
    const M4& a = rows_.bodies[joint.a].inverseInertia;
    const M4& b = rows_.bodies[joint.b].inverseInertia;
    friction.mass = inverseOfSymmetric({a.x + b.x, a.y + b.y, a.z + b.z});
    friction.bound = constraint.targetOf(constraint.angularRows()[0], rate).high;
    if (!tuning_.warmStart) return;
    for (int i = 0; i < 3; ++i)
        friction.impulse[i] = constraint.storedImpulse(3 + i);
}

void SubstepSolver::takePoint(const RagdollJoint& constraint, const Joint& joint, float rate) {
    PointRows& rows = rows_.points.emplace_back();
    rows.armA = toF4(constraint.parentArm());
    rows.armB = toF4(constraint.childArm());
    const SolverBody& a = rows_.bodies[joint.a];
    const SolverBody& b = rows_.bodies[joint.b];
    rows.turnA = turnBy(a, rows.armA);
    rows.turnB = turnBy(b, rows.armB);
    // Change of the anchors' relative velocity by an impulse between them.
    const float mass = a.inverseMass + b.inverseMass;
    rows.inverse = inverseOfSymmetric({
        F4{mass, 0, 0, 0} + crossDifference(rows.turnA.x, rows.armA, rows.armB, rows.turnB.x),
        F4{0, mass, 0, 0} + crossDifference(rows.turnA.y, rows.armA, rows.armB, rows.turnB.y),
        F4{0, 0, mass, 0} + crossDifference(rows.turnA.z, rows.armA, rows.armB, rows.turnB.z),
    });
    rows.mendTarget = -toF4(constraint.mendVelocity(rate));
    if (!tuning_.warmStart) return;
    for (int i = 0; i < 3; ++i)
        rows.impulse[i] = constraint.storedImpulse(i);
}

void SubstepSolver::takeAngular(const RagdollJoint& constraint, const Joint& joint, int index, float rate) {
    const RagdollJoint::AngularRow& given = constraint.angularRows()[index];
    const RagdollJoint::AngularTarget wanted = constraint.targetOf(given, rate);
    AngularRow& row = rows_.angulars.emplace_back();
    row.axis = toF4(given.axis);
    row.turnA = rows_.bodies[joint.a].inverseInertia * row.axis;
    row.turnB = rows_.bodies[joint.b].inverseInertia * row.axis;
    row.inverseEffectiveMass = inverseOf(dot(row.axis, row.turnA + row.turnB), 0.0F);
    row.duty = constraint.dutyOf(3 + index);
    row.mendTarget = wanted.speed;
    row.keepTarget = row.duty == RowDuty::mends ? 0.0F : wanted.speed;
    row.low = wanted.low;
    row.high = wanted.high;
    if (tuning_.warmStart) row.impulse = std::clamp(constraint.storedImpulse(3 + index), row.low, row.high);
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

void SubstepSolver::takeConstraint(const Link& link, float seconds) {
    Joint joint;
    joint.generals = askRows(*link.what, seconds);
    if (joint.generals == 0) return;
    joint.a = link.a;
    joint.b = link.b;
    joint.firstGeneral = static_cast<int>(rows_.generals.size());
    joint.constraint = link.what;
    joint.warm = dynamic_cast<WarmStarted*>(link.what);
    const SolverBody& a = rows_.bodies[joint.a];
    const SolverBody& b = rows_.bodies[joint.b];
    for (int i = 0; i < joint.generals; ++i) {
        const btSolverConstraint& given = scratch_[i];
        GeneralRow& row = rows_.generals.emplace_back();
        row.linearA = toF4(given.m_contactNormal1);
        row.angularA = toF4(given.m_relpos1CrossNormal);
        row.linearB = toF4(given.m_contactNormal2);
        row.angularB = toF4(given.m_relpos2CrossNormal);
        row.turnA = a.inverseInertia * row.angularA;
        row.turnB = b.inverseInertia * row.angularB;
        if (joint.warm != nullptr) {
            row.duty = joint.warm->dutyOf(i);
            row.softness = joint.warm->softnessOf(i);
        }
        row.inverseEffectiveMass =
            inverseOf(a.inverseMass * dot(row.linearA, row.linearA) + dot(row.angularA, row.turnA) +
                          b.inverseMass * dot(row.linearB, row.linearB) + dot(row.angularB, row.turnB),
                      row.softness);
        row.mendTarget = given.m_rhs;
        row.keepTarget = row.duty == RowDuty::mends ? 0.0F : given.m_rhs;
        row.low = given.m_lowerLimit;
        row.high = given.m_upperLimit;
        if (joint.warm != nullptr && tuning_.warmStart)
            row.impulse = std::clamp(joint.warm->storedImpulse(i), row.low, row.high);
    }
    rows_.joints.push_back(joint);
}

void SubstepSolver::takeContact(btManifoldPoint& point, int a, int b, float seconds) {
    ContactRows& contact = rows_.contacts.emplace_back();
    // Always the same way round as long as the two touch, so that impulses mean the same in the next substep.
    const bool swapped = a == kFixed;
    if (swapped) std::swap(a, b);
    contact.a = a;
    contact.b = b;
    contact.point = &point;
    contact.friction = point.m_combinedFriction;
    const SolverBody& bodyA = rows_.bodies[a];
    const SolverBody& bodyB = rows_.bodies[b];
    const F4 normal = swapped ? -toF4(point.m_normalWorldOnB) : toF4(point.m_normalWorldOnB);
    const F4 middle = allF4(0.5F) * (toF4(point.getPositionWorldOnA()) + toF4(point.getPositionWorldOnB()));
    contact.armA = middle - toF4(bodyA.body->getCenterOfMassPosition());
    if (b != kFixed) contact.armB = middle - toF4(bodyB.body->getCenterOfMassPosition());
    const auto both = [&](auto&& take) { b == kFixed ? take(bodyA) : take(bodyA, bodyB); };
    both([&](auto&... moving) { setRow(contact.normal, normal, contact, moving...); });
    const float distance = point.getDistance();
    if (distance > 0.0F) {
        // Not there yet: only the speed that would arrive within the substep is bounded.
        contact.mendTarget = contact.keepTarget = -distance / seconds;
    } else {
        contact.mendTarget = std::min(-tuning_.contactErp * std::min(distance + tuning_.contactSlop, 0.0F) / seconds,
                                      tuning_.maxPushSpeed);
    }
    constexpr float kBounceSpeed = 0.5F;  // m/s: slower impacts don't bounce
    if (point.m_combinedRestitution > 0.0F) {
        const float approach = speedOf(bodyA, bodyB, contact.normal);
        if (approach < -kBounceSpeed) contact.bounceTarget = -point.m_combinedRestitution * approach;
    }
    if (tuning_.warmStart && point.m_appliedImpulse > 0.0F) {
        contact.normal.impulse = point.m_appliedImpulse;
        contact.tangents[0].impulse = point.m_appliedImpulseLateral1;
        contact.tangents[1].impulse = point.m_appliedImpulseLateral2;
        contact.rolling = rollingImpulse(point);
        both([&](auto&... moving) { setFriction(contact, moving...); });
    }
}

void SubstepSolver::storeFeedback(const Joint& joint, float seconds) const {
    btJointFeedback* feedback = joint.constraint->getJointFeedback();
    if (feedback == nullptr) return;
    PushSum onA;
    PushSum onB;
    const auto add = [&](const GeneralRow& row) {
        onA.linear += row.linearA * allF4(row.impulse / seconds);
        onA.angular += row.angularA * allF4(row.impulse / seconds);
        onB.linear += row.linearB * allF4(row.impulse / seconds);
        onB.angular += row.angularB * allF4(row.impulse / seconds);
    };
    for (int i = 0; i < joint.generals; ++i)
        add(rows_.generals[joint.firstGeneral + i]);
    feedback->m_appliedForceBodyA = toBullet(onA.linear);
    feedback->m_appliedTorqueBodyA = toBullet(onA.angular);
    feedback->m_appliedForceBodyB = toBullet(onB.linear);
    feedback->m_appliedTorqueBodyB = toBullet(onB.angular);
}

void SubstepSolver::store(std::span<const Island> islands, float seconds) {
    for (const Joint& joint : rows_.joints) {
        if (joint.ragdoll != nullptr) {
            for (int i = 0; i < 3; ++i)
                joint.ragdoll->storeImpulse(i, rows_.points[joint.point].impulse[i]);
            const int others = joint.friction >= 0 ? 6 : 3;
            for (int i = 3; i < others; ++i)
                joint.ragdoll->storeImpulse(i, rows_.frictions[joint.friction].impulse[i - 3]);
            for (int i = 0; i < joint.angulars; ++i)
                joint.ragdoll->storeImpulse(others + i, rows_.angulars[joint.firstAngular + i].impulse);
            joint.ragdoll->finishStoring();
            continue;
        }
        storeFeedback(joint, seconds);
        if (joint.warm == nullptr) continue;
        for (int i = 0; i < joint.generals; ++i)
            joint.warm->storeImpulse(i, rows_.generals[joint.firstGeneral + i].impulse);
        joint.warm->finishStoring();
    }
    for (const ContactRows& contact : rows_.contacts) {
        contact.point->m_appliedImpulse = contact.normal.impulse;
        contact.point->m_appliedImpulseLateral1 = contact.tangents[0].impulse;
        contact.point->m_appliedImpulseLateral2 = contact.tangents[1].impulse;
        setRollingImpulse(*contact.point, contact.rolling);
    }
    for (const Island& island : islands) {
        for (const SolverBody& body : rows_.bodiesOf(island)) {
            body.body->setLinearVelocity(toBullet(body.velocity));
            body.body->setAngularVelocity(toBullet(body.turn));
        }
    }
}

void SubstepSolver::move(std::span<const Island> islands, float seconds) {
    for (const Island& island : islands) {
        for (const SolverBody& body : rows_.bodiesOf(island)) {
            btTransform moved;
            btTransformUtil::integrateTransform(body.body->getWorldTransform(), toBullet(body.velocity),
                                                toBullet(body.turn), seconds, moved);
            body.body->proceedToTransform(moved);
        }
    }
}

void SubstepSolver::solve(std::span<btRigidBody* const> bodies, std::span<btTypedConstraint* const> constraints,
                          btDispatcher& dispatcher, float seconds) {
    takeBodies(bodies);
    takeLinks(constraints);
    takeTouches(dispatcher);
    for (std::size_t first = 0; first < rows_.islands.size(); first += SubstepSweeps::kTogether)
        solve(std::span(rows_.islands).subspan(first, std::min(SubstepSweeps::kTogether, rows_.islands.size() - first)),
              seconds);
}

// Whether nothing but its own bodies can push an island's. What calm() brings to rest is none: it would tumble on.
bool SubstepSolver::isFree(const Island& island) const {
    const auto within = [](const auto& row) { return row.a != kFixed && row.b != kFixed; };
    const std::span joints = std::span(rows_.joints).subspan(island.firstJoint, island.joints);
    const std::span contacts = std::span(rows_.contacts).subspan(island.firstContact, island.contacts);
    return island.joints > 0 && !island.isSlowerThan(tuning_.quietSpeed) &&
           std::all_of(joints.begin(), joints.end(), within) && std::all_of(contacts.begin(), contacts.end(), within);
}

void SubstepSolver::solve(std::span<Island> islands, float seconds) {
    takeRows(islands, seconds);
    std::array<std::optional<glm::dvec3>, SubstepSweeps::kTogether> momenta;
    for (std::size_t i = 0; i < islands.size(); ++i) {
        sweeps_.calm(islands[i], seconds);
        if (isFree(islands[i])) momenta[i] = momentumBefore(rows_.bodiesOf(islands[i]), seconds);
    }
    if (tuning_.warmStart) sweeps_.warmStart(islands);
    sweeps_.iterate(islands, false);
    sweeps_.bounce();
    store(islands, seconds);
    sweeps_.iterate(islands, true);
    move(islands, seconds);
    for (std::size_t i = 0; i < islands.size(); ++i)
        if (momenta[i]) restoreMomentum(rows_.bodiesOf(islands[i]), *momenta[i]);
}

}  // namespace lutka::physics
