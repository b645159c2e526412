#include "physics/bullet/substep_sweeps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/bullet/led_bodies.hpp"

namespace lutka::physics {

// Old impulses in a new geometry can be far from the answer, and too few sweeps don't take back what they added: a doll
// that lands hard would be thrown up. So an island takes them only as far as they lessen what the sweeps minimise, the
// energy of D(s) = s²/2 |M⁻¹p|² + s (p·v - target·impulse): its minimum is at s = (target·impulse - p·v) / |M⁻¹p|².
// From there every row's step lessens it further, so that no substep adds energy, whatever the number of sweeps.
void SubstepSweeps::warmStart(std::span<SubstepIsland> islands) {
    pushes_.resize(rows_.bodies.size());
    for (const SubstepIsland& island : islands)
        std::fill_n(pushes_.begin() + island.firstBody, island.bodies, PushSum{});
    gatherPushes();
    for (SubstepIsland& island : islands) {
        for (int i = island.firstBody; i < island.firstBody + island.bodies; ++i) {
            const SolverBody& body = rows_.bodies[i];
            const PushSum& push = pushes_[i];
            island.gain -= dot(push.linear, body.velocity) + dot(push.angular, body.turn);
            island.square += body.inverseMass * dot(push.linear, push.linear) +
                             dot(push.angular, body.inverseInertia * push.angular);
        }
        island.share = island.square > 0.0F ? std::clamp(island.gain / island.square, 0.0F, 1.0F) : 0.0F;
    }
    applyShares();
}

template <class Visit>
void SubstepSweeps::forRows(const SubstepJoint& joint, const Visit& visit) {
    if (joint.point >= 0) visit(rows_.points[joint.point]);
    if (joint.friction >= 0) visit(rows_.frictions[joint.friction]);
    for (int i = 0; i < joint.angulars; ++i)
        visit(rows_.angulars[joint.firstAngular + i]);
    for (int i = 0; i < joint.generals; ++i)
        visit(rows_.generals[joint.firstGeneral + i]);
}

void SubstepSweeps::gatherPushes() {
    const auto gatherRows = [this](int a, int b, const auto& rows) {
        SubstepIsland& island = rows_.islandOfPair(a, b);
        gather(pushes_[a], pushes_[b], rows);
        island.gain += targetWork(rows);
        island.square += softnessWork(rows);
    };
    for (const SubstepJoint& joint : rows_.joints)
        forRows(joint, [&](const auto& rows) { gatherRows(joint.a, joint.b, rows); });
    for (const ContactRows& contact : rows_.contacts)
        if (contact.normal.impulse > 0.0F) gatherRows(contact.a, contact.b, contact);
}

void SubstepSweeps::applyShares() {
    const auto applyRows = [this](int a, int b, auto& rows) {
        applyShare(rows_.bodies[a], rows_.bodies[b], rows, rows_.islandOfPair(a, b).share);
    };
    for (const SubstepJoint& joint : rows_.joints)
        forRows(joint, [&](auto& rows) { applyRows(joint.a, joint.b, rows); });
    for (ContactRows& contact : rows_.contacts)
        if (contact.normal.impulse > 0.0F) applyRows(contact.a, contact.b, contact);
}

float SubstepSweeps::solveJoint(const SubstepJoint& joint, bool mending) {
    SolverBody& a = rows_.bodies[joint.a];
    SolverBody& b = rows_.bodies[joint.b];
    float residual = 0;
    if (joint.friction >= 0 && !mending) residual = physics::solve(a, b, rows_.frictions[joint.friction]);
    for (int i = 0; i < joint.angulars; ++i)
        residual = std::max(residual, physics::solve(a, b, rows_.angulars[joint.firstAngular + i], mending));
    for (int i = 0; i < joint.generals; ++i)
        residual = std::max(residual, physics::solve(a, b, rows_.generals[joint.firstGeneral + i], mending));
    if (joint.point >= 0) residual = std::max(residual, physics::solve(a, b, rows_.points[joint.point], mending));
    return residual;
}

float SubstepSweeps::solveContact(ContactRows& contact, bool mending) {
    SolverBody& a = rows_.bodies[contact.a];
    if (contact.b == 0) return physics::solve(contact, mending, tuning_.rollingArm, a);
    return physics::solve(contact, mending, tuning_.rollingArm, a, rows_.bodies[contact.b]);
}

// One sweep of some islands, forth or back: impulses travel up a limb as fast as down. The joints of a doll wait for
// one another; those of another island between them don't, and fill the time.
void SubstepSweeps::sweep(std::span<Sweeping> sweepings, bool mending, bool forth) {
    int joints = 0;
    int contacts = 0;
    for (Sweeping& sweeping : sweepings) {
        sweeping.residual = 0;
        joints = std::max(joints, sweeping.island->joints);
        contacts = std::max(contacts, sweeping.island->contacts);
    }
    for (int i = 0; i < joints; ++i) {
        for (Sweeping& sweeping : sweepings) {
            const SubstepIsland& island = *sweeping.island;
            if (i >= island.joints) continue;
            const int at = island.firstJoint + (forth ? i : island.joints - 1 - i);
            sweeping.residual = std::max(sweeping.residual, solveJoint(rows_.joints[at], mending));
        }
    }
    for (int i = 0; i < contacts; ++i) {
        for (Sweeping& sweeping : sweepings) {
            const SubstepIsland& island = *sweeping.island;
            if (i >= island.contacts) continue;
            const int at = island.firstContact + (forth ? i : island.contacts - 1 - i);
            sweeping.residual = std::max(sweeping.residual, solveContact(rows_.contacts[at], mending));
        }
    }
}

// A doll that lies still is solved in a few sweeps, one that hits the floor needs many. Near rest the error that is
// left must be less than the speeds themselves: limits and edges would otherwise push each other on and on.
void SubstepSweeps::iterate(std::span<const SubstepIsland> islands, bool mending) {
    const int most = mending ? tuning_.mendSweeps : tuning_.sweeps;
    std::array<Sweeping, kTogether> sweepings;
    std::size_t count = islands.size();
    for (std::size_t i = 0; i < count; ++i) {
        const float tolerance = islands[i].isSlowerThan(tuning_.restSpeed) ? tuning_.restTolerance : tuning_.tolerance;
        sweepings[i] = {&islands[i], tolerance * tolerance};
    }
    for (int i = 0; i < most && count > 0; ++i) {
        sweep(std::span(sweepings).first(count), mending, i % 2 == 0);
        if (i + 1 < tuning_.leastSweeps) continue;
        const auto done = [](const Sweeping& s) { return s.residual < s.tolerance; };
        const auto end = sweepings.begin() + static_cast<std::ptrdiff_t>(count);
        count = static_cast<std::size_t>(std::remove_if(sweepings.begin(), end, done) - sweepings.begin());
    }
}

// What lies nearly still is brought to rest: capsules would roll on for long, which skin and cloth never do. Where all
// of an island but a foot or a hand rests, that one is calmed as well: it would swing from its joint for seconds.
void SubstepSweeps::calm(SubstepIsland& island, float seconds) {
    for (const SolverBody& body : rows_.bodiesOf(island)) {
        if (LedBodies::isHeavy(*body.body)) continue;
        const float mass = 1.0F / body.inverseMass;
        island.mass += mass;
        island.motion += mass * dot(body.velocity, body.velocity);
    }
    if (island.contacts == 0) return;
    const F4 keep = allF4(std::max(1.0F - tuning_.restDamping * seconds, 0.0F));
    const bool amongResting = island.isSlowerThan(tuning_.quietSpeed);
    for (SolverBody& body : rows_.bodiesOf(island)) {
        const bool slow = dot(body.velocity, body.velocity) < tuning_.restSpeed * tuning_.restSpeed &&
                          dot(body.turn, body.turn) < tuning_.restTurn * tuning_.restTurn;
        if ((!slow && !amongResting) || LedBodies::isHeavy(*body.body)) continue;
        body.velocity *= keep;
        body.turn *= keep;
    }
}

void SubstepSweeps::bounce() {
    for (ContactRows& contact : rows_.contacts) {
        if (contact.bounceTarget <= 0.0F || contact.normal.impulse <= 0.0F) continue;
        SolverBody& a = rows_.bodies[contact.a];
        SolverBody& b = rows_.bodies[contact.b];
        const float more = std::max(contact.bounceTarget - speedOf(a, b, contact.normal), 0.0F);
        const float impulse = more * contact.normal.inverseEffectiveMass;
        push(a, b, contact.normal, impulse);
        contact.normal.impulse += impulse;
    }
}

}  // namespace lutka::physics
