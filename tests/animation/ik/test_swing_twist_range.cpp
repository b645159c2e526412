#include "animation/ik/swing_twist_range.hpp"

#include <glm/geometric.hpp>

#include "random_chain.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

SwingTwistRange randomRange(Random& random) {
    SwingTwistRange range;
    range.parentFromNeutral = test::randomTurn(random, kPi);
    range.jointFromNeutral = test::randomTurn(random, kPi);
    range.mostSwingY = random.uniform(0.2F, 1.5F);
    range.mostSwingZ = random.uniform(0.2F, 1.5F);
    range.leastTwist = random.uniform(-1.0F, -0.1F);
    range.mostTwist = random.uniform(0.1F, 1.0F);
    return range;
}

quat within(const SwingTwistRange& range, const vec3& swing, float twist) {
    const float angle = glm::length(swing);
    const quat turn = angle > 0.0F ? glm::angleAxis(angle, swing / angle) : quat(1, 0, 0, 0);
    return range.parentFromNeutral * turn * glm::angleAxis(twist, vec3(1, 0, 0)) *
           glm::conjugate(range.jointFromNeutral);
}

}  // namespace

TEST_CASE("a rotation within its range is left alone, and any other comes to its edge") {
    Random random(1);
    for (int i = 0; i < 500; ++i) {
        const SwingTwistRange range = randomRange(random);
        const float angle = random.uniform(-kPi, kPi);
        const float share = random.uniform(0.0F, 0.99F);
        const vec3 swing(0, range.mostSwingY * share * std::cos(angle), range.mostSwingZ * share * std::sin(angle));
        const quat inside = within(range, swing, random.uniform(range.leastTwist, range.mostTwist) * 0.99F);
        CHECK(clampedTo(range, inside) == inside);
        CHECK(excessOf(range, inside) < 1e-4F);
        const quat any = test::randomTurn(random, kPi);
        CHECK(excessOf(range, clampedTo(range, any)) < 1e-3F);
        CHECK(glm::length(clampedTo(range, any)) == Approx(1.0F));
    }
}

TEST_CASE("twist and swing are clamped each for itself") {
    SwingTwistRange range;
    range.mostSwingY = 0.5F;
    range.mostSwingZ = 1.0F;
    range.leastTwist = -0.2F;
    range.mostTwist = 0.4F;
    const quat clamped = clampedTo(range, within(range, {0, 1.0F, 0}, 1.0F));
    CHECK(glm::length(rotationVector(glm::conjugate(within(range, {0, 0.5F, 0}, 0.4F)) * clamped)) < 1e-4F);
    CHECK(excessOf(range, within(range, {0, 0, 1.3F}, 0.0F)) == Approx(0.3F).margin(1e-4));
}

TEST_CASE("a soft clamp is the value inside, never passes an end and has no corner") {
    CHECK(softlyClamped(0.5F, 0.0F, 1.0F, 0.1F) == 0.5F);
    CHECK(softlyClamped(5.0F, 0.0F, 1.0F, 0.0F) == 1.0F);
    float last = softlyClamped(-1.0F, 0.0F, 1.0F, 0.1F);
    float lastSlope = 0.0F;
    for (float value = -1.0F; value < 2.0F; value += 0.01F) {
        const float now = softlyClamped(value, 0.0F, 1.0F, 0.1F);
        CHECK(now >= 0.0F);
        CHECK(now <= 1.0F);
        CHECK(now >= last - 1e-6F);
        const float slope = (now - last) / 0.01F;
        CHECK(std::abs(slope - lastSlope) < 0.12F);
        lastSlope = slope;
        last = now;
    }
}
