#include "physics/collision/static_distance.hpp"
#include "physics/profile/constraint_state.hpp"
#include "physics/world/doll_overlap.hpp"
#include "physics/world/quality.hpp"

#include <glm/geometric.hpp>

#include "physics/rig/rig.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using physics::BodyShape;
using physics::BodyState;
using physics::ConstraintState;
using physics::measureConstraint;
using physics::RagdollProfile;
using physics::StaticShape;

namespace {

const RigidTransform kIdentity;

// The child's frame relative to the parent's; makePair()'s anchors lie at the world's origin in the bind pose.
ConstraintState measured(const RagdollProfile& pair, const quat& parentFromChild, const vec3& gap = vec3(0)) {
    const RigidTransform childFrame{parentFromChild, gap};
    const physics::ConstraintProfile& c = pair.constraints[0];
    return measureConstraint(c, inverse(c.parentFromFrame), childFrame * inverse(c.childFromFrame));
}

quat turn(float angleDeg, const vec3& axis) {
    return glm::angleAxis(radians(angleDeg), glm::normalize(axis));
}

BodyShape capsuleShape(float radius, float halfLength) {
    BodyShape shape;
    shape.radius = radius;
    shape.halfLength = halfLength;
    return shape;
}

// A world that shows what it is told to.
class PuppetWorld final : public physics::WorldView {
  public:
    explicit PuppetWorld(const RagdollProfile& profile) : profile_(profile), bodies(profile.bodies.size()) {
        dollIds_.add();
    }
    [[nodiscard]] int substepsPerStep() const override { return 1; }
    [[nodiscard]] double dragWork() const override { return work; }

    // Both bodies of makePair(), lying along x at a height.
    void lieAt(float height) {
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            bodies[i].worldFromBody = profile_.bodies[i].jointFromBody;
            bodies[i].worldFromBody.translation.y += height;
        }
    }

  private:
    [[nodiscard]] const RagdollProfile& profileAt(int /*doll*/) const override { return profile_; }
    [[nodiscard]] vec3 inertiaAt(int /*doll*/, int body) const override { return profile_.bodies[body].inertia; }
    void getBodiesAt(int /*doll*/, std::span<BodyState> out) const override {
        std::copy(bodies.begin(), bodies.end(), out.begin());
    }
    [[nodiscard]] bool isAsleepAt(int /*doll*/) const override { return asleep; }
    [[nodiscard]] const physics::DynamicProp& propAt(int /*prop*/) const override { return noProp_; }
    [[nodiscard]] BodyState propStateAt(int /*prop*/) const override { return {}; }

    const RagdollProfile& profile_;
    physics::DynamicProp noProp_;

  public:
    std::vector<BodyState> bodies;
    double work = 0;
    bool asleep = false;
};

const std::vector<StaticShape> kFloorOnly{StaticShape{}};
const vec3 kGravity(0, -10, 0);

}  // namespace

TEST_CASE("separation is the distance of the two anchors", "[quality]") {
    const RagdollProfile pair = test::makePair(physics::ConeTwistLimits{1, 1, 1});
    CHECK(measured(pair, {1, 0, 0, 0}).separationM == Approx(0.0F).margin(1e-6));
    CHECK(measured(pair, turn(50, {1, 2, 3}), {0.03F, 0, 0.04F}).separationM == Approx(0.05F));
}

TEST_CASE("a hinge's angle has the sign of a rotation about frame z and violates what lies past its limits",
          "[quality]") {
    const RagdollProfile pair = test::makePair(physics::HingeLimits{radians(-20.0F), radians(30.0F)});
    for (const float angleDeg : {-100.0F, -20.0F, -5.0F, 0.0F, 29.0F, 45.0F, 150.0F}) {
        const ConstraintState state = measured(pair, turn(angleDeg, {0, 0, 1}));
        CHECK(degrees(state.hingeAngle) == Approx(angleDeg).margin(1e-3));
        const float excess = angleDeg < -20.0F ? -20.0F - angleDeg : std::max(0.0F, angleDeg - 30.0F);
        CHECK(degrees(state.violation) == Approx(excess).margin(1e-3));
    }
}

TEST_CASE("swing and twist of a cone are told apart, and the larger excess counts", "[quality]") {
    const RagdollProfile pair =
        test::makePair(physics::ConeTwistLimits{radians(80.0F), radians(20.0F), radians(30.0F)});
    struct Case {
        vec3 swingDeg;
        float twistDeg;
        float excessDeg;
    };
    const Case cases[] = {{{0, 0, 0}, 0, 0},   {{0, 70, 0}, 0, 0},   {{0, 90, 0}, 0, 10},
                          {{0, 0, 25}, 0, 5},  {{0, 0, -25}, 20, 5}, {{0, 0, 0}, 50, 20},
                          {{0, 0, 0}, -31, 1}, {{0, 90, 0}, 45, 15}, {{0, 72, 0}, -29.9F, 0}};
    for (const Case& c : cases) {
        const float swing = glm::length(c.swingDeg);
        const quat q = (swing > 0 ? turn(swing, c.swingDeg) : quat(1, 0, 0, 0)) * turn(c.twistDeg, {1, 0, 0});
        const ConstraintState state = measured(pair, q);
        CHECK(degrees(state.swing.y) == Approx(c.swingDeg.y).margin(2e-3));
        CHECK(degrees(state.swing.z) == Approx(c.swingDeg.z).margin(2e-3));
        CHECK(degrees(state.twist) == Approx(c.twistDeg).margin(2e-3));
        CHECK(degrees(state.violation) == Approx(c.excessDeg).margin(2e-3));
    }
}

TEST_CASE("an oblique swing's excess is measured along the ray from the centre", "[quality]") {
    const RagdollProfile pair =
        test::makePair(physics::ConeTwistLimits{radians(80.0F), radians(20.0F), radians(30.0F)});
    // On the ray at 45 degrees the ellipse ends at 1 / sqrt(cos²/80² + sin²/20²).
    const float edge = 1.0F / std::sqrt(0.5F / 6400.0F + 0.5F / 400.0F);
    const ConstraintState state = measured(pair, turn(edge + 7.0F, {0, 1, 1}));
    CHECK(degrees(state.violation) == Approx(7.0F).margin(1e-3));
}

TEST_CASE("distances to a plane are those of the lowest point", "[quality]") {
    const StaticShape floor;
    CHECK(distanceToStatic(capsuleShape(0.1F, 0.3F), {quat(1, 0, 0, 0), {0, 1, 0}}, floor) == Approx(0.6F));
    CHECK(distanceToStatic(capsuleShape(0.1F, 0.3F), {turn(90, {0, 0, 1}), {5, 0.05F, 0}}, floor) == Approx(-0.05F));
    BodyShape box;
    box.kind = BodyShape::Kind::box;
    box.halfExtents = {0.1F, 0.1F, 0.1F};
    CHECK(distanceToStatic(box, {turn(45, {0, 0, 1}), {0, 0.1F, 0}}, floor) == Approx(0.1F - 0.1F * std::sqrt(2.0F)));
    StaticShape wall;
    wall.worldFromShape = {turn(-90, {0, 0, 1}), {2, 0, 0}};  // its upper side looks towards +x
    BodyShape ball;
    ball.kind = BodyShape::Kind::sphere;
    ball.radius = 0.25F;
    CHECK(distanceToStatic(ball, {quat(1, 0, 0, 0), {3, 7, 9}}, wall) == Approx(0.75F));
}

TEST_CASE("distances to a box are those to its nearest face, edge or corner", "[quality]") {
    StaticShape block;
    block.kind = StaticShape::Kind::box;
    block.halfExtents = {1, 0.5F, 1};
    const quat upright(1, 0, 0, 0);
    CHECK(distanceToStatic(capsuleShape(0.1F, 0.3F), {upright, {0, 1.5F, 0}}, block) == Approx(0.6F));
    CHECK(distanceToStatic(capsuleShape(0.1F, 0.3F), {turn(90, {0, 0, 1}), {0, 0.58F, 0}}, block) ==
          Approx(-0.02F).margin(1e-5));
    const vec3 corner = vec3(1, 0.5F, 1) + glm::normalize(vec3(1, 1, 1)) * 0.7F;
    BodyShape ball;
    ball.kind = BodyShape::Kind::sphere;
    ball.radius = 0.2F;
    CHECK(distanceToStatic(ball, {upright, corner}, block) == Approx(0.5F));
    // Across an edge: neither end is near it.
    const vec3 aboveEdge = vec3(1, 0.5F, 0) + glm::normalize(vec3(1, 1, 0)) * 0.3F;
    CHECK(distanceToStatic(capsuleShape(0.1F, 1.0F), {turn(45, {0, 0, 1}), aboveEdge}, block) ==
          Approx(0.2F).margin(1e-4));
}

TEST_CASE("energy growth is the largest rise over the running minimum, less the work of drags", "[quality]") {
    const RagdollProfile pair = test::makePair(physics::ConeTwistLimits{1, 1, 1}, 2.0F);  // 4 kg in all
    PuppetWorld world(pair);
    world.lieAt(1.0F);
    physics::QualityMeter meter(world, kFloorOnly, kGravity);
    CHECK(meter.result().initialEnergyJ == Approx(40.0F));
    world.lieAt(0.5F);  // 20 J
    meter.sample(0.1);
    CHECK(meter.result().energyGrowthJ == Approx(0.0F).margin(1e-4));
    world.lieAt(0.6F);  // 24 J
    meter.sample(0.2);
    CHECK(meter.result().energyGrowthJ == Approx(4.0F));
    world.lieAt(0.9F);  // 36 J, of which a drag brought 14
    world.work = 14.0;
    meter.sample(0.3);
    CHECK(meter.result().energyGrowthJ == Approx(4.0F));
    for (BodyState& body : world.bodies)
        body.linearVelocity = {3, 0, 0};  // 18 J
    meter.sample(0.4);
    CHECK(meter.result().energyGrowthJ == Approx(20.0F));
}

TEST_CASE("turning energy is taken in the body's own axes", "[quality]") {
    const RagdollProfile pair = test::makePair(physics::ConeTwistLimits{1, 1, 1});
    PuppetWorld world(pair);
    world.lieAt(0.0F);
    for (BodyState& body : world.bodies)
        body.angularVelocity = {4, 0, 0};  // about the capsules' own axes, which lie along x
    const physics::QualityMeter meter(world, kFloorOnly, kGravity);
    CHECK(meter.result().initialEnergyJ == Approx(2 * 0.5F * pair.bodies[0].inertia.y * 16.0F));
}

TEST_CASE("settling counts from the first contact and starts anew when something moves", "[quality]") {
    const RagdollProfile pair = test::makePair(physics::ConeTwistLimits{1, 1, 1});
    PuppetWorld world(pair);
    physics::QualityMeter meter(world, kFloorOnly, kGravity);
    const auto sample = [&](double seconds, float height, float speed) {
        world.lieAt(height);
        for (BodyState& body : world.bodies)
            body.linearVelocity = {speed, 0, 0};
        meter.sample(seconds);
    };
    sample(0.5, 1.0F, 0.0F);  // at rest in the air is not settled
    CHECK_FALSE(meter.result().settleSeconds);
    sample(1.0, 0.05F, 2.0F);
    sample(2.0, 0.05F, 0.005F);
    sample(3.0, 0.05F, 0.02F);
    CHECK_FALSE(meter.result().settleSeconds);
    sample(4.0, 0.05F, 0.009F);
    sample(5.0, 0.05F, 0.001F);
    REQUIRE(meter.result().settleSeconds);
    CHECK(*meter.result().settleSeconds == Approx(3.0F));
    CHECK(meter.result().residualSpeedMps == Approx(0.001F));
}

TEST_CASE("the percentile ends three seconds after the first contact, the maximum does not", "[quality]") {
    const RagdollProfile pair = test::makePair(physics::ConeTwistLimits{1, 1, 1});
    PuppetWorld world(pair);
    physics::QualityMeter meter(world, kFloorOnly, kGravity);
    const auto sample = [&](double seconds, float gap) {
        world.lieAt(0.05F);
        world.bodies[1].worldFromBody.translation.x += gap;
        meter.sample(seconds);
    };
    for (int i = 0; i < 300; ++i)
        sample(0.01 * i, i < 6 ? 0.008F : 0.002F);  // 2 % of the samples are large
    sample(3.5, 0.030F);
    const physics::Quality quality = meter.result();
    CHECK(quality.jointSeparationM.max == Approx(0.030F).epsilon(1e-3));
    CHECK(quality.jointSeparationM.p99 == Approx(0.008F).epsilon(0.011));
    CHECK(quality.jointSeparationM.mean == Approx(0.002F + 0.02F * 0.006F).epsilon(1e-3));
}

TEST_CASE("a lasting violation is what a joint held for two frames, not a peak", "[quality]") {
    const RagdollProfile pair = test::makePair(physics::HingeLimits{radians(-20.0F), radians(30.0F)});
    PuppetWorld world(pair);
    physics::QualityMeter meter(world, kFloorOnly, kGravity);
    int samples = 0;
    const auto hold = [&](float angleDeg, int count) {
        const physics::ConstraintProfile& c = pair.constraints[0];
        world.lieAt(1.0F);
        const RigidTransform parentFrame = world.bodies[0].worldFromBody * c.parentFromFrame;
        world.bodies[1].worldFromBody =
            parentFrame * RigidTransform{turn(angleDeg, {0, 0, 1}), vec3(0)} * inverse(c.childFromFrame);
        for (int i = 0; i < count; ++i)
            meter.sample(++samples / 360.0);
    };
    hold(130, 12);  // from the first to the last less than two frames
    hold(0, 1);
    CHECK(meter.result().limitViolationDeg.max == Approx(100).epsilon(1e-3));
    CHECK(meter.result().limitViolationDeg.lasting == 0.0F);
    hold(75, 6);
    hold(50, 6);
    hold(90, 1);  // never below 20 for two frames
    CHECK(meter.result().limitViolationDeg.lasting == Approx(20).epsilon(1e-3));
    hold(90, 12);
    CHECK(meter.result().limitViolationDeg.lasting == Approx(60).epsilon(1e-3));
    hold(35, 30);
    CHECK(meter.result().limitViolationDeg.lasting == Approx(60).epsilon(1e-3));
}

TEST_CASE("states that are not finite are counted and spoil nothing else", "[quality]") {
    const RagdollProfile pair = test::makePair(physics::ConeTwistLimits{1, 1, 1});
    PuppetWorld world(pair);
    world.lieAt(0.04F);
    physics::QualityMeter meter(world, kFloorOnly, kGravity);
    world.bodies[1].worldFromBody.translation.x = std::numeric_limits<float>::quiet_NaN();
    meter.sample(0.1);
    CHECK(meter.result().nonFinite == 1);
    world.lieAt(0.04F);
    meter.sample(0.2);
    CHECK(meter.result().nonFinite == 1);
    CHECK(meter.result().floorPenetrationM == Approx(0.01F));
    CHECK(meter.result().jointSeparationM.max == Approx(0.0F).margin(1e-6));
}

TEST_CASE("dolls in each other are measured pair by pair, a doll's own bodies and distant ones are not", "[quality]") {
    RagdollProfile ball = test::makePair(physics::ConeTwistLimits{1, 1, 1});
    for (physics::BodyProfile& body : ball.bodies) {
        body.shape = {};
        body.shape.kind = BodyShape::Kind::sphere;
        body.shape.radius = 0.1F;
    }
    const auto at = [](float x, float z) {
        BodyState state;
        state.worldFromBody.translation = {x, 0, z};
        return state;
    };
    physics::DollOverlap overlap;
    overlap.add(0, ball, std::vector{at(0, 0), at(0.02F, 0)});    // deep in itself
    overlap.add(1, ball, std::vector{at(0.17F, 0), at(5, 0)});    // 30 mm and 50 mm into the first
    overlap.add(2, ball, std::vector{at(5, 0.205F), at(5, -1)});  // 5 mm from the second
    const std::span<const float> depths = overlap.depths();
    REQUIRE(depths.size() == 3);
    CHECK(overlap.deepest() == Approx(0.05F).margin(1e-5));
    CHECK(*std::min_element(depths.begin(), depths.end()) == 0.0F);
    overlap.clear();
    CHECK(overlap.depths().empty());
    CHECK(overlap.deepest() == 0.0F);
}
