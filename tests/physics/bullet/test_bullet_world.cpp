#include "physics/bullet/bullet_world.hpp"
#include "physics/rig/rig.hpp"

#include <glm/geometric.hpp>

#include "core/random.hpp"
#include "physics/profile/constraint_state.hpp"
#include "physics/world/quality.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using physics::BodyState;
using physics::Quality;
using physics::QualityMeter;
using physics::RagdollProfile;
using physics::SolverKind;
using physics::StaticShape;
using physics::World;
using physics::WorldSettings;

namespace {

constexpr float kDt = 1.0F / 60.0F;
const vec3 kGravity(0, -9.81F, 0);

const RagdollProfile& doll() {
    static const RagdollProfile profile = test::makeDoll();
    return profile;
}

std::vector<BodyState> standing(const RigidTransform& worldFromModel, const vec3& velocity = vec3(0)) {
    static const animation::Skeleton skeleton = test::makeBiped().skeleton;
    const auto rig = physics::bindRig(doll(), skeleton);
    REQUIRE(rig.ok());
    std::vector<BodyState> bodies(doll().bodies.size());
    bodiesFromPose(rig.value(), skeleton.bindModelFromJoint, worldFromModel, bodies);
    for (BodyState& body : bodies)
        body.linearVelocity = velocity;
    return bodies;
}

std::vector<BodyState> standingAt(const vec3& position, const vec3& velocity = vec3(0)) {
    return standing({quat(1, 0, 0, 0), position}, velocity);
}

std::unique_ptr<World> makeWorld(SolverKind solver, const vec3& gravity = kGravity, bool sleeping = true) {
    WorldSettings settings;
    settings.solver = solver;
    settings.gravity = gravity;
    settings.sleeping = sleeping;
    return createBulletWorld(settings);
}

StaticShape box(const vec3& centre, const vec3& halfExtents) {
    StaticShape shape;
    shape.kind = StaticShape::Kind::box;
    shape.worldFromShape.translation = centre;
    shape.halfExtents = halfExtents;
    return shape;
}

std::vector<BodyState> bodiesOf(const World& world, int index = 0) {
    const physics::DollId id = world.dolls()[index];
    std::vector<BodyState> bodies(world.profileOf(id).bodies.size());
    world.getBodies(id, bodies);
    return bodies;
}

float fastestOf(const World& world) {
    float fastest = 0;
    for (int i = 0; i < static_cast<int>(world.dolls().size()); ++i) {
        for (const BodyState& body : bodiesOf(world, i))
            fastest = std::max(fastest, glm::length(body.linearVelocity));
    }
    return fastest;
}

// Runs a world with its meter; the statics must be in the world already.
Quality run(World& world, const std::vector<StaticShape>& statics, float seconds) {
    QualityMeter meter(world, statics, kGravity);
    double time = 0;
    const double substep = static_cast<double>(kDt) / world.substepsPerStep();
    for (int i = 0; i < static_cast<int>(seconds / kDt); ++i) {
        world.step(kDt, [&] {
            time += substep;
            meter.sample(time);
        });
    }
    return meter.result();
}

void requireSound(const Quality& quality) {
    CHECK(quality.nonFinite == 0);
    CHECK(quality.jointSeparationM.max < 0.010F);
    CHECK(quality.jointSeparationM.p99 < 0.002F);
    CHECK(quality.limitViolationDeg.p99 < 5.0F);
    CHECK(quality.floorPenetrationM < 0.010F);
    CHECK(quality.energyGrowthJ < 0.01F * quality.initialEnergyJ);
}

std::uint64_t hashOf(const World& world) {
    std::uint64_t hash = kHashStart;
    for (const BodyState& body : bodiesOf(world))
        hash = hashBytes(&body, sizeof body, hash);
    return hash;
}

// Two bodies in free space; the child turns with `turn` (rad/s) about the joint, from a start that is turned already.
struct Swung {
    float largestViolation = 0;
    float largestHinge = -10;
    float smallestHinge = 10;
    float largestSwing = 0;
};
// The parent is so heavy that it stays where it is.
Swung swing(SolverKind solver, RagdollProfile pair, const quat& start, const vec3& turn) {
    pair.bodies[0].massKg *= 1000.0F;
    pair.bodies[0].inertia *= 1000.0F;
    const auto world = makeWorld(solver, vec3(0), false);
    const physics::ConstraintProfile& c = pair.constraints[0];
    std::vector<BodyState> bodies(2);
    bodies[0].worldFromBody = inverse(c.parentFromFrame);
    bodies[1].worldFromBody = RigidTransform{start, vec3(0)} * inverse(c.childFromFrame);
    bodies[1].angularVelocity = turn;
    bodies[1].linearVelocity = glm::cross(turn, bodies[1].worldFromBody.translation);
    world->addDoll(pair, bodies);
    Swung swung;
    for (int i = 0; i < 60; ++i) {
        world->step(kDt, [&] {
            const std::vector<BodyState> now = bodiesOf(*world);
            const physics::ConstraintState state = measureConstraint(c, now[0].worldFromBody, now[1].worldFromBody);
            swung.largestViolation = std::max(swung.largestViolation, state.violation);
            swung.largestHinge = std::max(swung.largestHinge, state.hingeAngle);
            swung.smallestHinge = std::min(swung.smallestHinge, state.hingeAngle);
            swung.largestSwing = std::max(swung.largestSwing, glm::length(state.swing));
        });
    }
    return swung;
}

}  // namespace

TEST_CASE("a hinge stops at its own limits, positive about frame z, in both worlds", "[bullet]") {
    const RagdollProfile pair = test::makePair(physics::HingeLimits{radians(-10.0F), radians(60.0F)});
    for (const SolverKind solver : {SolverKind::stock, SolverKind::bullet}) {
        const float slack = solver == SolverKind::stock ? 10.0F : 1.0F;  // degrees
        const Swung up = swing(solver, pair, {1, 0, 0, 0}, {0, 0, 9});
        CHECK(degrees(up.largestHinge) == Approx(60.0F).margin(slack));
        const Swung down = swing(solver, pair, {1, 0, 0, 0}, {0, 0, -9});
        CHECK(degrees(down.smallestHinge) == Approx(-10.0F).margin(slack));
    }
}

TEST_CASE("a twisted child swings to the ellipse of the parent's frame and no further", "[bullet]") {
    const RagdollProfile pair = test::makePair(physics::ConeTwistLimits{radians(80), radians(20), radians(45)});
    struct Case {
        float twistDeg;
        vec3 turn;
        float stopDeg;
    };
    const Case cases[] = {{0, {0, 14, 0}, 80},   {0, {0, 0, 14}, 20},    {45, {0, 14, 0}, 80},
                          {45, {0, 0, -14}, 20}, {-45, {0, -14, 0}, 80}, {-45, {0, 0, 14}, 20}};
    for (const Case& c : cases) {
        INFO("twist " << c.twistDeg << ", turn " << c.turn.y << " " << c.turn.z);
        const quat start = glm::angleAxis(radians(c.twistDeg), vec3(1, 0, 0));
        const Swung swung = swing(SolverKind::bullet, pair, start, c.turn);
        CHECK(degrees(swung.largestViolation) < 1.5F);
        CHECK(degrees(swung.largestSwing) == Approx(c.stopDeg).margin(4.0F));
    }
}

TEST_CASE("a fast spin stops at the twist's limit", "[bullet]") {
    const RagdollProfile pair = test::makePair(physics::ConeTwistLimits{radians(60), radians(60), radians(30)});
    for (const float speed : {3.0F, 30.0F, -100.0F}) {
        const Swung swung = swing(SolverKind::bullet, pair, {1, 0, 0, 0}, {speed, 0, 0});
        CHECK(degrees(swung.largestViolation) < 2.0F);
    }
}

TEST_CASE("a doll that falls is sound all the way and falls asleep", "[bullet]") {
    for (const float lean : {0.0F, 0.3F, 1.5F}) {
        const auto world = makeWorld(SolverKind::bullet);
        const std::vector<StaticShape> statics{StaticShape{}};
        world->addStatic(statics[0]);
        world->addDoll(doll(), standing({glm::angleAxis(lean, vec3(0.6F, 0, 0.8F)), {0, 1, 0}}));
        const Quality quality = run(*world, statics, 7.0F);
        requireSound(quality);
        REQUIRE(quality.settleSeconds);
        CHECK(*quality.settleSeconds < 6.0F);
        CHECK(world->isAsleep(world->dolls()[0]));
    }
}

TEST_CASE("resistance to rolling holds a ball on a slope up to its arm over the radius", "[bullet]") {
    // The normal force may move by 1 cm ahead of the ball's centre: 2.9 degrees at a radius of 20 cm.
    for (const float slopeDeg : {2.0F, 4.5F}) {
        const auto world = makeWorld(SolverKind::bullet, kGravity, false);
        StaticShape slope;
        slope.worldFromShape.rotation = glm::angleAxis(radians(slopeDeg), vec3(0, 0, 1));
        world->addStatic(slope);
        physics::DynamicProp ball;
        ball.shape.kind = physics::BodyShape::Kind::sphere;
        ball.shape.radius = 0.2F;
        ball.massKg = 5.0F;
        ball.state.worldFromBody.translation = slope.worldFromShape.rotation * vec3(0, 0.2F, 0);
        world->addProp(ball);
        for (int i = 0; i < 240; ++i)
            world->step(kDt);
        const float moved = glm::distance(world->propState(world->props()[0]).worldFromBody.translation,
                                          ball.state.worldFromBody.translation);
        INFO(slopeDeg << " degrees: " << moved << " m");
        CHECK((slopeDeg < 2.9F ? moved < 0.002F : moved > 0.1F));
    }
}

TEST_CASE("what hangs from a body at rest soon stops swinging", "[bullet]") {
    // The heavy parent lies on a table, the child hangs beyond its edge and is pushed along it.
    RagdollProfile pair = test::makePair(physics::ConeTwistLimits{radians(120), radians(120), radians(60)});
    pair.bodies[0].massKg *= 100.0F;
    pair.bodies[0].inertia *= 100.0F;
    const physics::ConstraintProfile& c = pair.constraints[0];
    std::vector<BodyState> bodies(2);
    bodies[0].worldFromBody = inverse(c.parentFromFrame);
    bodies[1].worldFromBody =
        RigidTransform{glm::angleAxis(radians(-90), vec3(0, 0, 1)), vec3(0)} * inverse(c.childFromFrame);
    const float radius = pair.bodies[0].shape.radius;
    const auto framesToSleep = [&](float quietSpeed) {
        physics::BulletTuning tuning;
        tuning.quietSpeed = quietSpeed;
        const auto world = createBulletWorld({}, tuning);
        world->addStatic(box({-1.1F, -radius - 0.5F, 0}, {1.0F, 0.5F, 1.0F}));
        world->addDoll(pair, bodies);
        world->applyImpulse(world->dolls()[0], 1, {0, 0, 0.5F * pair.bodies[1].massKg},
                            bodiesOf(*world)[1].worldFromBody.translation);
        int frames = 0;
        for (; !world->isAsleep(world->dolls()[0]) && frames < 1200; ++frames)
            world->step(kDt);
        return frames;
    };
    const int calmed = framesToSleep(physics::BulletTuning{}.quietSpeed);
    const int free = framesToSleep(0.0F);
    INFO(calmed << " and " << free << " frames");
    CHECK(calmed < 300);
    CHECK(free > calmed + 120);
}

TEST_CASE("the same calls give the same bits", "[bullet]") {
    for (const SolverKind solver : {SolverKind::stock, SolverKind::bullet}) {
        std::uint64_t hashes[2];
        for (std::uint64_t& hash : hashes) {
            const auto world = makeWorld(solver);
            world->addStatic({});
            world->addDoll(doll(), standingAt({0, 0.5F, 0}));
            world->addDoll(doll(), standingAt({0.2F, 2.5F, 0.1F}));
            for (int i = 0; i < 120; ++i)
                world->step(kDt);
            hash = hashOf(*world);
        }
        CHECK(hashes[0] == hashes[1]);
    }
}

TEST_CASE("a thin wall stops a doll at eight metres a second", "[bullet]") {
    const auto world = makeWorld(SolverKind::bullet);
    const std::vector<StaticShape> statics{StaticShape{}, box({0, 1.5F, 2.0F}, {3, 1.5F, 0.025F})};
    for (const StaticShape& shape : statics)
        world->addStatic(shape);
    world->addDoll(doll(), standing({glm::angleAxis(1.2F, vec3(1, 0, 0)), {0, 1.2F, -0.3F}}, {0, 0, 8}));
    requireSound(run(*world, statics, 4.0F));
    for (const BodyState& body : bodiesOf(*world))
        CHECK(body.worldFromBody.translation.z < 2.0F);
}

TEST_CASE("a thin wall stops a doll at sixty metres a second", "[bullet]") {
    const auto world = makeWorld(SolverKind::bullet);
    world->addStatic({});
    world->addStatic(box({0, 1.5F, 4.0F}, {3, 1.5F, 0.025F}));
    world->addDoll(doll(), standing({glm::angleAxis(1.2F, vec3(1, 0, 0)), {0, 1.2F, -0.3F}}, {0, 0, 60}));
    for (int i = 0; i < 60; ++i)
        world->step(kDt);
    for (const BodyState& body : bodiesOf(*world))
        CHECK(body.worldFromBody.translation.z < 4.0F);
}

TEST_CASE("a doll that starts inside the floor is pushed out calmly", "[bullet]") {
    const auto world = makeWorld(SolverKind::bullet);
    world->addStatic({});
    world->addDoll(doll(), standingAt({0, -0.5F, 0}));
    float fastest = 0;  // upwards: what is not held falls as usual
    for (int i = 0; i < 300; ++i) {
        world->step(kDt);
        for (const BodyState& body : bodiesOf(*world))
            fastest = std::max(fastest, body.linearVelocity.y);
    }
    CHECK(fastest < 1.5F);
    for (const BodyState& body : bodiesOf(*world))
        CHECK(body.worldFromBody.translation.y > 0.0F);
}

TEST_CASE("a doll that starts inside another parts from it calmly", "[bullet]") {
    const auto world = makeWorld(SolverKind::bullet, vec3(0));
    world->addDoll(doll(), standingAt({0, 0, 0}));
    world->addDoll(doll(), standingAt({0.05F, 0.02F, 0.03F}));
    float fastest = 0;
    for (int i = 0; i < 120; ++i) {
        world->step(kDt);
        fastest = std::max(fastest, fastestOf(*world));
    }
    CHECK(fastest < 2.0F);
    const vec3 apart =
        bodiesOf(*world, 0)[0].worldFromBody.translation - bodiesOf(*world, 1)[0].worldFromBody.translation;
    CHECK(glm::length(apart) > 0.1F);
}

TEST_CASE("dragging by the hand at any speed keeps the doll together", "[bullet]") {
    for (const float speed : {2.0F, 20.0F, 400.0F}) {
        const auto world = makeWorld(SolverKind::bullet);
        const std::vector<StaticShape> statics{StaticShape{}};
        world->addStatic(statics[0]);
        world->addDoll(doll(), standingAt({0, 0, 0}));
        const int hand = bodyOf(doll(), animation::Role::leftHand);
        QualityMeter meter(*world, statics, kGravity);
        double time = 0;
        physics::Drag drag{world->dolls()[0], hand};
        const physics::DragId pull = world->addDrag(drag);
        for (int i = 0; i < 240; ++i) {
            const float angle = speed * kDt * static_cast<float>(i);
            drag.worldTarget = vec3(std::sin(angle), 1.5F + 0.5F * std::cos(angle), 0);
            world->setDrag(pull, drag);
            world->step(kDt, [&] { meter.sample(time += static_cast<double>(kDt) / world->substepsPerStep()); });
        }
        const Quality quality = meter.result();
        CHECK(quality.nonFinite == 0);
        CHECK(quality.jointSeparationM.max < 0.050F);
        CHECK(quality.jointSeparationM.p99 < 0.010F);
        CHECK(quality.limitViolationDeg.p99 < 25.0F);
        CHECK(world->dragWork() > 10.0);
        world->removeDrag(pull);
        CHECK_FALSE(world->has(pull));
        const double work = world->dragWork();
        world->step(kDt);
        CHECK(world->dragWork() == work);
    }
}

TEST_CASE("linked and filtered bodies don't touch, other dolls do", "[bullet]") {
    for (const SolverKind solver : {SolverKind::stock, SolverKind::bullet}) {
        const auto world = makeWorld(solver, vec3(0));
        world->addDoll(doll(), standingAt({0, 0, 0}));
        std::vector<physics::ContactPoint> contacts;
        world->step(kDt);
        world->getContacts(contacts);
        CHECK(contacts.empty());
        world->addDoll(doll(), standingAt({0, 0.3F, 0}));
        world->step(kDt);
        world->getContacts(contacts);
        CHECK_FALSE(contacts.empty());
    }
}

TEST_CASE("a ray finds the body that it meets first", "[bullet]") {
    for (const SolverKind solver : {SolverKind::stock, SolverKind::bullet}) {
        const auto world = makeWorld(solver, vec3(0));
        world->addStatic({});
        world->addDoll(doll(), standingAt({5, 0, 0}));
        world->addDoll(doll(), standingAt({0, 0, 0}));
        const auto chest = world->rayTest({0, 1.33F, 5}, {0, 1.33F, -5});
        REQUIRE(chest);
        CHECK(chest->doll == world->dolls()[1]);
        CHECK(doll().bodies[chest->body].role == animation::Role::chest);
        CHECK(chest->position.z == Approx(0.13F).margin(0.01));
        CHECK(chest->normal.z == Approx(1.0F).margin(0.01));
        CHECK(chest->fraction == Approx((5 - 0.13F) / 10).margin(0.001));
        const auto floor = world->rayTest({9, 3, 9}, {9, -3, 9});
        REQUIRE(floor);
        CHECK_FALSE(floor->doll.isSet());
        CHECK_FALSE(world->rayTest({9, 3, 9}, {9, 2, 9}));
    }
}

TEST_CASE("an impulse changes the momentum by itself and wakes the doll", "[bullet]") {
    const auto world = makeWorld(SolverKind::bullet);
    world->addStatic({});
    world->addDoll(doll(), standingAt({0, 0.2F, 0}));
    for (int i = 0; i < 600 && !world->isAsleep(world->dolls()[0]); ++i)
        world->step(kDt);
    REQUIRE(world->isAsleep(world->dolls()[0]));
    const std::uint64_t asleep = hashOf(*world);
    world->step(kDt);
    CHECK(hashOf(*world) == asleep);
    const vec3 impulse(30, 60, 0);
    world->applyImpulse(world->dolls()[0], 0, impulse, bodiesOf(*world)[0].worldFromBody.translation);
    CHECK_FALSE(world->isAsleep(world->dolls()[0]));
    vec3 momentum(0);
    const std::vector<BodyState> bodies = bodiesOf(*world);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        momentum += bodies[i].linearVelocity * doll().bodies[i].massKg;
    CHECK(glm::distance(momentum, impulse) < 0.01F);
}

TEST_CASE("a doll that is placed anew starts as if it had always been there", "[bullet]") {
    std::uint64_t hashes[2];
    for (int moved = 0; moved < 2; ++moved) {
        const auto world = makeWorld(SolverKind::bullet);
        world->addStatic({});
        world->addDoll(doll(), standingAt({0, moved == 1 ? 0.0F : 1.0F, 0}));
        if (moved == 1) {
            for (int i = 0; i < 90; ++i)
                world->step(kDt);
            world->setBodies(world->dolls()[0], standingAt({0, 1, 0}));
        }
        for (int i = 0; i < 20; ++i)
            world->step(kDt);
        hashes[moved] = hashOf(*world);
    }
    CHECK(hashes[0] == hashes[1]);
}

TEST_CASE("a prop pushes a doll and keeps what it was made as", "[bullet]") {
    const auto world = makeWorld(SolverKind::bullet, vec3(0));
    world->addDoll(doll(), standingAt({0, 0, 0}));
    physics::DynamicProp ball;
    ball.shape.kind = physics::BodyShape::Kind::sphere;
    ball.shape.radius = 0.12F;
    ball.massKg = 4.0F;
    ball.state.worldFromBody.translation = {0, 1.33F, 1.0F};
    ball.state.linearVelocity = {0, 0, -6};
    const physics::PropId added = world->addProp(ball);
    CHECK(added == world->props()[0]);
    for (int i = 0; i < 30; ++i)
        world->step(kDt);
    CHECK(world->props().size() == 1);
    CHECK(world->propOf(world->props()[0]).massKg == 4.0F);
    CHECK(world->propState(world->props()[0]).linearVelocity.z > -3.0F);
    CHECK(bodiesOf(*world)[bodyOf(doll(), animation::Role::chest)].linearVelocity.z < -0.1F);
}

TEST_CASE("a doll that falls asleep while it is held stays asleep and whole") {
    const auto world = makeWorld(SolverKind::bullet, vec3(0));
    const auto start = standingAt({0, 1, 0});
    world->addDoll(doll(), start);
    const int hand = physics::bodyOf(doll(), physics::Role::leftHand);
    world->addDrag({world->dolls()[0], hand, vec3(0), start[hand].worldFromBody.translation, 500.0F});
    for (int i = 0; i < 600; ++i)
        world->step(kDt);
    CHECK(world->isAsleep(world->dolls()[0]));
    const auto bodies = bodiesOf(*world);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        CHECK(glm::distance(bodies[i].worldFromBody.translation, start[i].worldFromBody.translation) < 1e-3F);
}
