#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>

#include "physics/collision/shape.hpp"
#include "physics/profile/constraint_state.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"
#include "world_table.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::BodyState;
using physics::ContactReport;
using physics::JointMotor;
using physics::RagdollProfile;
using physics::SolverKind;

namespace {

const quat kLying = glm::angleAxis(0.5F * kPi, vec3(0, 0, 1));
const quat kUnturned(1, 0, 0, 0);

physics::WorldSettings weightless() {
    physics::WorldSettings settings;
    settings.gravity = vec3(0);
    return settings;
}

// Both bodies of makePair() as their joint has them in its neutral pose.
std::vector<BodyState> pairBodies(const RagdollProfile& pair, const vec3& joint = vec3(0)) {
    std::vector<BodyState> bodies(2);
    bodies[0].worldFromBody = RigidTransform{kUnturned, joint} * inverse(pair.constraints[0].parentFromFrame);
    bodies[1].worldFromBody = RigidTransform{kUnturned, joint} * inverse(pair.constraints[0].childFromFrame);
    return bodies;
}

// Holds the parent where it is by its weight alone.
RagdollProfile withHeavyParent(RagdollProfile pair) {
    pair.bodies[0].massKg *= 30000.0F;
    pair.bodies[0].inertia *= 30000.0F;
    return pair;
}

float angleOf(const physics::World& world, const RagdollProfile& pair) {
    const auto bodies = bodiesOfDoll(world, 0);
    const auto state =
        physics::measureConstraint(pair.constraints[0], bodies[0].worldFromBody, bodies[1].worldFromBody);
    return pair.constraints[0].kind == physics::ConstraintProfile::Kind::hinge ? state.hingeAngle
                                                                               : glm::length(state.swing);
}

}  // namespace

TEST_CASE("a doll of 256 bodies hangs together in every world") {
    constexpr int kBodies = 256;
    constexpr float kLink = 0.1F;  // metres
    RagdollProfile chain = makePair(physics::ConeTwistLimits{0.7F, 0.7F, 0.5F}, 0.5F);
    const physics::BodyProfile link = chain.bodies[1];
    physics::ConstraintProfile joint = chain.constraints[0];
    joint.parentFromFrame = {quat(1, 0, 0, 0), vec3(0, 0.5F * kLink, 0)};
    joint.childFromFrame = {quat(1, 0, 0, 0), vec3(0, -0.5F * kLink, 0)};
    chain.bodies.clear();
    chain.constraints.clear();
    chain.totalMassKg = 0.0F;
    std::vector<BodyState> bodies;
    for (int i = 0; i < kBodies; ++i) {
        physics::BodyProfile& body = chain.bodies.emplace_back(link);
        body.role.reset();
        body.name = body.jointPath = "link " + std::to_string(i);
        body.shape.radius = 0.02F;
        body.shape.halfLength = 0.03F;
        body.inertia = physics::shapeInertia(body.shape, body.massKg);
        chain.totalMassKg += body.massKg;
        // Lying half a metre above the floor.
        bodies.push_back(
            stateAt(vec3(kLink * static_cast<float>(i), 0.5F, 0), glm::angleAxis(-0.5F * kPi, vec3(0, 0, 1))));
        if (i == 0) continue;
        joint.parent = i - 1;
        joint.child = i;
        chain.constraints.push_back(joint);
    }
    REQUIRE(physics::validate(chain).empty());
    for (const SolverKind solver : {SolverKind::bullet, SolverKind::crowd}) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver);
        world->addStatic(staticBoxAt({12, -0.5F, 0}, {20, 0.5F, 20}));
        world->addDoll(chain, bodies);
        stepSeconds(*world, 1.0F);
        float separation = 0.0F;
        const auto after = bodiesOfDoll(*world, 0);
        REQUIRE(after.size() == kBodies);
        for (const physics::ConstraintProfile& c : chain.constraints) {
            const auto state =
                physics::measureConstraint(c, after[c.parent].worldFromBody, after[c.child].worldFromBody);
            separation = std::max(separation, state.separationM);
        }
        CHECK(separation < 0.002F);
        for (const BodyState& body : after) {
            CHECK(physics::isFinite(body));
            CHECK(body.worldFromBody.translation.y > 0.0F);
            CHECK(body.worldFromBody.translation.y < 0.1F);
        }
    }
}

TEST_CASE("a force acts for one step at its point and does its work") {
    const auto rod = rodProfile(0.2F, 0.05F, 2.0F);
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver, weightless());
        world->addDoll(rod, std::vector<BodyState>{stateAt(vec3(0))});
        const auto energy = [&] {
            const BodyState now = bodyOfDoll(*world, 0);
            const vec3 turn = glm::conjugate(now.worldFromBody.rotation) * now.angularVelocity;
            return 0.5F * (2.0F * glm::dot(now.linearVelocity, now.linearVelocity) +
                           glm::dot(world->inertiaOf(world->dolls()[0], 0), turn * turn));
        };
        for (int i = 0; i < 6; ++i) {
            const RigidTransform at = bodyOfDoll(*world, 0).worldFromBody;
            world->applyForce(world->dolls()[0], 0, {10, 0, 0}, at * vec3(0, 0.1F, 0));
            world->step(kFrame);
        }
        const float expected = 10.0F * 6.0F * kFrame / 2.0F;
        const BodyState pushed = bodyOfDoll(*world, 0);
        CHECK(pushed.linearVelocity.x == Approx(expected).epsilon(0.01));
        CHECK(pushed.angularVelocity.z < -0.1F);
        CHECK(world->motorWork() == Approx(energy()).epsilon(0.05));
        world->step(kFrame);
        CHECK(bodyOfDoll(*world, 0).linearVelocity.x == Approx(expected).epsilon(0.02));
    }
}

TEST_CASE("a force wakes a sleeping doll and can hold it up") {
    const auto rod = rodProfile(0.2F, 0.05F, 2.0F);
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver);
        world->addStatic({});
        world->addDoll(rod, std::vector<BodyState>{stateAt({0, 0.06F, 0}, kLying)});
        stepSeconds(*world, 6.0F);
        REQUIRE(world->isAsleep(world->dolls()[0]));
        for (int i = 0; i < 30; ++i) {
            const vec3 centre = bodyOfDoll(*world, 0).worldFromBody.translation;
            world->applyForce(world->dolls()[0], 0, {0, 2.0F * (9.81F + 4.0F), 0}, centre);
            world->step(kFrame);
        }
        CHECK_FALSE(world->isAsleep(world->dolls()[0]));
        CHECK(bodyOfDoll(*world, 0).worldFromBody.translation.y == Approx(0.05F + 0.5F * 4.0F * 0.25F).margin(0.06));
    }
}

TEST_CASE("a motor holds a joint against gravity where its spring says") {
    const RagdollProfile hinge = withHeavyParent(makePair(physics::HingeLimits{radians(-120), radians(120)}));
    const RagdollProfile cone =
        withHeavyParent(makePair(physics::ConeTwistLimits{radians(120), radians(120), radians(60)}));
    for (const SolverKind solver : kAllSolvers) {
        for (const RagdollProfile* pair : {&hinge, &cone}) {
            INFO(physics::solverName(solver) << (pair == &hinge ? " hinge" : " cone"));
            // Gravity pulls along -y; the joint turns about z.
            physics::WorldSettings settings = weightless();
            const auto world = worldOf(solver, settings);
            world->addDoll(*pair, pairBodies(*pair));
            JointMotor motor;
            motor.angle = radians(30);
            motor.target = glm::angleAxis(radians(30), vec3(0, 0, 1));
            motor.stiffness = 60.0F;
            motor.damping = 6.0F;
            world->setMotor(world->dolls()[0], 0, motor);
            stepSeconds(*world, 2.0F);
            CHECK(degrees(angleOf(*world, *pair)) == Approx(30.0F).margin(0.6));
            CHECK(std::abs(world->motorWork()) < 40.0);
            // A steady force on the child turns the spring by torque over stiffness.
            for (int i = 0; i < 240; ++i) {
                const RigidTransform at = bodyOfDoll(*world, 0, 1).worldFromBody;
                const vec3 along = at.translation;  // from the joint at the origin
                world->applyForce(world->dolls()[0], 1, 20.0F * glm::normalize(vec3(along.y, -along.x, 0)),
                                  at.translation);
                world->step(kFrame);
            }
            const float arm = glm::length(pair->constraints[0].childFromFrame.translation);
            const float sag = degrees(20.0F * arm / motor.stiffness);
            // Stock has the spring beside its solver, as if nothing else held the bodies: softer than asked for.
            if (solver != SolverKind::stock)
                CHECK(degrees(angleOf(*world, *pair)) == Approx(30.0F - sag).margin(0.1F * sag + 0.3F));
            CHECK(degrees(angleOf(*world, *pair)) < 30.0F - 0.5F * sag);
            world->setMotor(world->dolls()[0], 0, std::nullopt);
            const double work = world->motorWork();
            stepSeconds(*world, 0.2F);
            CHECK(world->motorWork() == work);
        }
    }
}

TEST_CASE("a joint's own spring pulls it to its rest, gives way to a motor and comes back after it") {
    RagdollProfile hinge = withHeavyParent(makePair(physics::HingeLimits{radians(-120), radians(120)}));
    RagdollProfile cone = withHeavyParent(makePair(physics::ConeTwistLimits{radians(120), radians(120), radians(60)}));
    for (RagdollProfile* pair : {&hinge, &cone})
        pair->constraints[0].spring = {60.0F, 6.0F, glm::angleAxis(radians(30), vec3(0, 0, 1))};
    for (const SolverKind solver : kAllSolvers) {
        for (const RagdollProfile* pair : {&hinge, &cone}) {
            INFO(physics::solverName(solver) << (pair == &hinge ? " hinge" : " cone"));
            const auto world = worldOf(solver, weightless());
            const physics::DollId doll = world->addDoll(*pair, pairBodies(*pair));
            stepSeconds(*world, 2.0F);
            CHECK(degrees(angleOf(*world, *pair)) == Approx(30.0F).margin(0.6));
            JointMotor motor;
            motor.angle = radians(60);
            motor.target = glm::angleAxis(radians(60), vec3(0, 0, 1));
            motor.stiffness = 60.0F;
            motor.damping = 6.0F;
            world->setMotor(doll, 0, motor);
            stepSeconds(*world, 2.0F);
            CHECK(degrees(angleOf(*world, *pair)) == Approx(60.0F).margin(0.6));
            world->setMotor(doll, 0, std::nullopt);
            stepSeconds(*world, 2.0F);
            CHECK(degrees(angleOf(*world, *pair)) == Approx(30.0F).margin(0.6));
            // A state without motors leaves the spring in the joint.
            world->setDollState(doll, {pairBodies(*pair), {}, {std::nullopt}, 0.0F, false});
            stepSeconds(*world, 2.0F);
            CHECK(degrees(angleOf(*world, *pair)) == Approx(30.0F).margin(0.6));
        }
    }
}

TEST_CASE("a joint's damper slows a swing and adds no energy, however strong it is") {
    for (const SolverKind solver : kOurSolvers) {
        for (const float damping : {0.5F, 5000.0F}) {
            INFO(physics::solverName(solver) << ", " << damping << " N m s");
            RagdollProfile pair = withHeavyParent(makePair(physics::HingeLimits{radians(-170), radians(170)}));
            const auto speedAfter = [&](const physics::JointSpring& spring) {
                pair.constraints[0].spring = spring;
                const auto world = worldOf(solver, weightless());
                std::vector<BodyState> bodies = pairBodies(pair);
                const vec3 spin(0, 0, 2.0F);
                bodies[1].angularVelocity = spin;
                bodies[1].linearVelocity = glm::cross(spin, bodies[1].worldFromBody.translation);
                world->addDoll(pair, bodies);
                stepSeconds(*world, 0.5F);
                return std::abs(bodyOfDoll(*world, 0, 1).angularVelocity.z);
            };
            const float free = speedAfter({});
            const float braked = speedAfter({0.0F, damping});
            CHECK(free > 1.5F);
            CHECK(braked < (damping > 1.0F ? 0.01F : 0.6F * free));
        }
    }
}

TEST_CASE("a motor's torque has its bound") {
    const RagdollProfile hinge = withHeavyParent(makePair(physics::HingeLimits{radians(-150), radians(150)}));
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver, weightless());
        world->addDoll(hinge, pairBodies(hinge));
        JointMotor motor;
        motor.angle = radians(140);
        motor.stiffness = 1e4F;
        motor.maxTorqueNm = 0.5F;
        world->setMotor(world->dolls()[0], 0, motor);
        stepSeconds(*world, 0.1F);
        const BodyState child = bodyOfDoll(*world, 0, 1);
        const float arm = glm::length(hinge.constraints[0].childFromFrame.translation);
        const float inertia = world->inertiaOf(world->dolls()[0], 1).z + hinge.bodies[1].massKg * arm * arm;
        CHECK(child.angularVelocity.z == Approx(0.5F * 0.1F / inertia).epsilon(0.1));
    }
}

TEST_CASE("motors of any stiffness hold a whole doll in its pose while it is thrown about") {
    const RagdollProfile profile = makeDoll();
    for (const SolverKind solver : kOurSolvers) {
        for (const float stiffness : {200.0F, 50000.0F}) {
            INFO(physics::solverName(solver) << ", N m/rad " << stiffness);
            const auto world = worldOf(solver);
            const std::vector<physics::StaticShape> statics{physics::StaticShape{}};
            world->addStatic(statics[0]);
            world->addDoll(profile, standingDoll(profile, {0, 0.8F, 0}, glm::angleAxis(0.6F, vec3(1, 0, 0))));
            const auto start = bodiesOfDoll(*world, 0);
            for (std::size_t i = 0; i < profile.constraints.size(); ++i) {
                const auto& c = profile.constraints[i];
                const auto state =
                    physics::measureConstraint(c, start[c.parent].worldFromBody, start[c.child].worldFromBody);
                JointMotor motor;
                motor.angle = state.hingeAngle;
                motor.target = glm::conjugate(start[c.parent].worldFromBody.rotation * c.parentFromFrame.rotation) *
                               (start[c.child].worldFromBody.rotation * c.childFromFrame.rotation);
                motor.stiffness = stiffness;
                motor.damping = 0.05F * stiffness;
                motor.maxTorqueNm = 400.0F;
                world->setMotor(world->dolls()[0], static_cast<int>(i), motor);
            }
            const physics::Quality quality = measureSeconds(*world, statics, 3.0F);
            CHECK(quality.nonFinite == 0);
            CHECK(quality.jointSeparationM.max < 0.015F);
            CHECK(quality.jointSeparationM.p99 < 0.004F);
            const auto end = bodiesOfDoll(*world, 0);
            // Hands are as far from the hips as at the start, within what the springs give.
            const int hips = physics::bodyOf(profile, physics::Role::hips);
            for (const physics::Role role : {physics::Role::leftHand, physics::Role::rightFoot}) {
                const int body = physics::bodyOf(profile, role);
                const float before =
                    glm::distance(start[body].worldFromBody.translation, start[hips].worldFromBody.translation);
                const float after =
                    glm::distance(end[body].worldFromBody.translation, end[hips].worldFromBody.translation);
                CHECK(after == Approx(before).margin(0.15));
            }
        }
    }
}

TEST_CASE("contact reports add up to the weight of what rests and name who it is") {
    const auto rod = rodProfile(0.2F, 0.05F, 3.0F);
    physics::WorldSettings settings;
    settings.contactReports = true;
    settings.sleeping = false;
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver, settings);
        CHECK(world->addStatic(staticBoxAt({9, 0, 0}, {1, 1, 1})).isSet());
        CHECK(world->addStatic({}).isSet());
        world->addDoll(rod, std::vector<BodyState>{stateAt({0, 0.05F, 0}, kLying)});
        physics::DynamicProp crate;
        crate.shape.kind = physics::BodyShape::Kind::box;
        crate.shape.halfExtents = vec3(0.1F);
        crate.massKg = 5.0F;
        crate.state = stateAt({0, 0.2F, 2});
        world->addProp(crate);
        stepSeconds(*world, 2.0F);
        float ofRod = 0;
        float ofCrate = 0;
        for (const ContactReport& report : world->contactReports()) {
            const bool first = report.a.kind != ContactReport::Side::Kind::fixed;
            const ContactReport::Side& mover = first ? report.a : report.b;
            const ContactReport::Side& floor = first ? report.b : report.a;
            CHECK(floor == ContactReport::Side{ContactReport::Side::Kind::fixed, {}, {}, world->statics()[1], 0});
            CHECK((first ? report.normal.y : -report.normal.y) > 0.99F);
            CHECK(std::abs(report.position.y) < 0.01F);
            CHECK(mover.doll.isSet() == (mover.kind == ContactReport::Side::Kind::doll));
            CHECK((world->has(mover.doll) || world->has(mover.prop)));
            (mover.kind == ContactReport::Side::Kind::doll ? ofRod : ofCrate) += report.impulse;
        }
        CHECK(ofRod == Approx(3.0F * 9.81F * kFrame).epsilon(0.05));
        CHECK(ofCrate == Approx(5.0F * 9.81F * kFrame).epsilon(0.05));
    }
}

TEST_CASE("a hit is reported between the two that hit each other, with the momentum that it took") {
    const auto ball = rodProfile(0.0F, 0.1F, 2.0F);
    physics::WorldSettings settings = weightless();
    for (const SolverKind solver : kAllSolvers) {
        for (const bool reports : {true, false}) {
            INFO(physics::solverName(solver));
            settings.contactReports = reports;
            const auto world = worldOf(solver, settings);
            world->addDoll(ball, std::vector<BodyState>{stateAt({-1, 0, 0}, kUnturned, {4, 0, 0})});
            world->addDoll(ball, std::vector<BodyState>{stateAt({0, 0, 0})});
            float sum = 0;
            for (int i = 0; i < 60; ++i) {
                world->step(kFrame);
                for (const ContactReport& report : world->contactReports()) {
                    CHECK(report.a.kind == ContactReport::Side::Kind::doll);
                    CHECK_FALSE(report.a.doll == report.b.doll);
                    CHECK((world->has(report.a.doll) && world->has(report.b.doll)));
                    CHECK(std::abs(report.normal.x) > 0.99F);
                    sum += report.impulse;
                }
            }
            const float took = 2.0F * (4.0F - bodyOfDoll(*world, 0).linearVelocity.x);
            CHECK(took > 2.0F);
            CHECK(sum == (reports ? Approx(took).epsilon(0.1) : Approx(0.0F)));
        }
    }
}

TEST_CASE("what is removed is gone, what rested on it falls, and later ones keep their order") {
    const auto rod = rodProfile(0.2F, 0.05F);
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver);
        world->addStatic(staticBoxAt({0, 0.9F, 0}, {1, 0.1F, 1}));
        world->addStatic({});
        physics::DollId dolls[3];
        for (int i = 0; i < 3; ++i) {
            const vec3 at(0.02F * static_cast<float>(i), 1.05F, 0.6F * static_cast<float>(i) - 0.6F);
            dolls[i] = world->addDoll(rod, std::vector<BodyState>{stateAt(at, kLying)});
        }
        physics::DynamicProp prop;
        prop.shape.halfLength = 0.0F;
        prop.shape.radius = 0.1F;
        prop.state = stateAt({4, 0.1F, 0});
        world->addProp(prop);
        prop.massKg = 7.0F;
        prop.state = stateAt({5, 0.1F, 0});
        world->addProp(prop);
        stepSeconds(*world, 5.0F);
        REQUIRE(world->isAsleep(world->dolls()[2]));
        const vec3 last = bodyOfDoll(*world, 2).worldFromBody.translation;
        const physics::DragId gone = world->addDrag({dolls[1], 0, vec3(0), {0, 2, 0}, 10.0F});
        const physics::DragId pull = world->addDrag({dolls[2], 0, vec3(0), last, 1.0F});
        world->removeDoll(dolls[1]);
        CHECK_FALSE(world->has(dolls[1]));
        CHECK_FALSE(world->has(gone));
        REQUIRE(world->dolls().size() == 2);
        CHECK(world->dolls()[1] == dolls[2]);
        CHECK(world->dragsOf(dolls[2]) == std::vector{pull});
        CHECK(glm::distance(bodyOfDoll(*world, 1).worldFromBody.translation, last) < 1e-3F);
        CHECK_FALSE(world->rayTest({0, 3, 0}, {0, 1.005F, 0}));
        world->removeDrag(pull);

        world->removeProp(world->props()[0]);
        REQUIRE(world->props().size() == 1);
        CHECK(world->propOf(world->props()[0]).massKg == 7.0F);
        CHECK(world->propState(world->props()[0]).worldFromBody.translation.x == Approx(5.0F).margin(0.01));

        stepSeconds(*world, 4.0F);
        REQUIRE(world->isAsleep(world->dolls()[0]));
        world->removeStatic(world->statics()[0]);
        stepSeconds(*world, 3.0F);
        for (int doll = 0; doll < 2; ++doll)
            CHECK(bodyOfDoll(*world, doll).worldFromBody.translation.y == Approx(0.05F).margin(0.02));
        // Its place is free for another.
        const physics::DollId next = world->addDoll(rod, std::vector<BodyState>{stateAt({0, 2, 0}, kLying)});
        CHECK(world->dolls()[2] == next);
        CHECK_FALSE(next == dolls[1]);
        CHECK_FALSE(world->has(dolls[1]));
        stepSeconds(*world, 2.0F);
        CHECK(bodyOfDoll(*world, 2).worldFromBody.translation.y < 0.3F);
    }
}

TEST_CASE("a doll that is woken by hand is awake and falls asleep again") {
    const auto rod = rodProfile(0.2F, 0.05F);
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver);
        world->addStatic({});
        world->addDoll(rod, std::vector<BodyState>{stateAt({0, 0.06F, 0}, kLying)});
        stepSeconds(*world, 6.0F);
        REQUIRE(world->isAsleep(world->dolls()[0]));
        world->wake(world->dolls()[0]);
        CHECK_FALSE(world->isAsleep(world->dolls()[0]));
        world->step(kFrame);
        CHECK_FALSE(world->isAsleep(world->dolls()[0]));
        stepSeconds(*world, 6.0F);
        CHECK(world->isAsleep(world->dolls()[0]));
    }
}

TEST_CASE("the parts of a step's time are parts of it, and finding contacts is one where there are some") {
    const RagdollProfile profile = makeDoll();
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver);
        world->addStatic({});
        CHECK(world->stepTimes().totalMs() == 0.0);
        world->addDoll(profile, standingDoll(profile, vec3(0)));
        for (int step = 0; step < 30; ++step) {
            const auto before = std::chrono::steady_clock::now();
            world->step(kFrame);
            const std::chrono::duration<double, std::milli> whole = std::chrono::steady_clock::now() - before;
            const physics::StepTimes times = world->stepTimes();
            CHECK(times.broadphaseMs >= 0.0);
            CHECK(times.narrowphaseMs >= 0.0);
            CHECK(times.solverMs >= 0.0);
            // Both are spans of one clock, the parts within the whole.
            CHECK(times.totalMs() <= whole.count());
            std::vector<physics::ContactPoint> contacts;
            world->getContacts(contacts);
            if (!contacts.empty()) CHECK(times.narrowphaseMs > 0.0);
        }
        std::vector<physics::ContactPoint> contacts;
        world->getContacts(contacts);
        CHECK_FALSE(contacts.empty());
        CHECK(world->stepTimes().islands == 1);
    }
}
