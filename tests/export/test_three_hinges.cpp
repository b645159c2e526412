#include "export/three_hinges.hpp"

#include <glm/geometric.hpp>

#include "core/swing_twist.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::exporting;

namespace {

physics::ConeTwistLimits cone(float swingYDeg, float swingZDeg, float twistDeg) {
    return {radians(swingYDeg), radians(swingZDeg), radians(twistDeg)};
}

}  // namespace

TEST_CASE("the angles of three hinges make the rotation that they were taken from, in both orders") {
    for (const bool yFirst : {true, false}) {
        for (const float first : {-1.2F, 0.0F, 0.4F, 2.0F}) {
            for (const float second : {-1.3F, -0.2F, 0.0F, 1.0F}) {
                for (const float twist : {-2.0F, 0.0F, 0.7F}) {
                    const quat rotation = rotationOfHinges({first, second, twist}, yFirst);
                    const quat again = rotationOfHinges(hingeAngles(rotation, yFirst), yFirst);
                    CHECK(std::abs(glm::dot(rotation, again)) == Approx(1.0F).margin(1e-5));
                }
            }
        }
    }
}

TEST_CASE("a swing about one axis alone is one angle, also past the right angle") {
    for (const float angle : {0.3F, 1.5F, 1.7F, 2.2F}) {
        for (const bool yFirst : {true, false}) {
            const auto aboutY = hingeAngles(glm::angleAxis(angle, vec3(0, 1, 0)), yFirst);
            CHECK(aboutY[yFirst ? 0 : 1] == Approx(angle).margin(2e-3));
            CHECK(aboutY[yFirst ? 1 : 0] == Approx(0.0F).margin(2e-3));
        }
    }
}

TEST_CASE("the octagon holds the whole ellipse and is much nearer to it than the rectangle") {
    for (const auto& limits : {cone(30, 30, 20), cone(85, 85, 75), cone(25, 75, 80), cone(110, 40, 30)}) {
        const ThreeHinges three = threeHinges(limits);
        CHECK(three.yFirst == (limits.swingY >= limits.swingZ));
        for (int i = 0; i < 100; ++i) {
            const float at = 0.0628F * static_cast<float>(i);
            const vec3 swing(0, limits.swingY * std::cos(at), limits.swingZ * std::sin(at));
            const auto angles = hingeAngles(rotationOf({swing, 0.0F}), three.yFirst);
            CHECK(std::abs(angles[0]) <= three.firstMax + 1e-4F);
            CHECK(std::abs(angles[1]) <= three.secondMax + 1e-4F);
            CHECK(std::abs(angles[0] * three.sumFirst) + std::abs(angles[1] * three.sumSecond) <= 1.0F + 1e-3F);
        }
        CHECK(three.octagonExcess < 0.12F * std::max(limits.swingY, limits.swingZ));
        CHECK(three.octagonExcess < three.rectangleExcess);
        CHECK(three.twistMax == limits.twist);
    }
}

TEST_CASE("for a narrow cone the octagon is the regular one about a circle") {
    const ThreeHinges three = threeHinges(cone(5, 5, 5));
    CHECK(three.firstMax == Approx(radians(5.0F)).epsilon(1e-3));
    // Its corners lie 1 / cos(22.5°) from the middle.
    CHECK(three.octagonExcess == Approx(radians(5.0F) * 0.0824F).epsilon(0.03));
    CHECK(three.rectangleExcess == Approx(radians(5.0F) * 0.4142F).epsilon(0.03));
    CHECK(three.twistError < radians(0.3F));
}
