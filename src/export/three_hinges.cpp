#include "export/three_hinges.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/swing_twist.hpp"

namespace lutka::exporting {
namespace {

using physics::ConeTwistLimits;

constexpr int kSamples = 720;  // round an ellipse: half a degree apart
const vec3 kX(1, 0, 0);

float angleOfSample(int i) {
    return 2.0F * kPi * static_cast<float>(i) / kSamples;
}

// The swing angles (first, second) of a point on the limit's ellipse.
vec2 onEllipse(const ConeTwistLimits& limits, float at, bool yFirst) {
    const vec3 swing(0, limits.swingY * std::cos(at), limits.swingZ * std::sin(at));
    const auto angles = hingeAngles(rotationOf({swing, 0.0F}), yFirst);
    return {angles[0], angles[1]};
}

// Radians past the ellipse.
float excessOf(const ConeTwistLimits& limits, const vec2& angles, bool yFirst) {
    const vec3 swing = swingTwist(rotationOfHinges({angles.x, angles.y, 0.0F}, yFirst)).swing;
    const float filled = std::hypot(swing.y / limits.swingY, swing.z / limits.swingZ);
    return filled > 1.0F ? glm::length(swing) * (1.0F - 1.0F / filled) : 0.0F;
}

float twistOf(const vec2& angles, bool yFirst) {
    return std::abs(swingTwist(rotationOfHinges({angles.x, angles.y, 0.0F}, yFirst)).twist);
}

void measure(const ConeTwistLimits& limits, ThreeHinges& hinges) {
    for (int i = 0; i < kSamples; ++i) {
        const vec2 direction(std::cos(angleOfSample(i)), std::sin(angleOfSample(i)));
        const vec2 size = glm::abs(direction);
        const float toRectangle = 1.0F / std::max(size.x / hinges.firstMax, size.y / hinges.secondMax);
        const float toSum = 1.0F / (size.x * hinges.sumFirst + size.y * hinges.sumSecond);
        hinges.rectangleExcess =
            std::max(hinges.rectangleExcess, excessOf(limits, toRectangle * direction, hinges.yFirst));
        hinges.octagonExcess =
            std::max(hinges.octagonExcess, excessOf(limits, std::min(toRectangle, toSum) * direction, hinges.yFirst));
    }
}

}  // namespace

quat rotationOfHinges(const std::array<float, 3>& angles, bool yFirst) {
    const vec3 first = yFirst ? vec3(0, 1, 0) : vec3(0, 0, 1);
    const vec3 second = yFirst ? vec3(0, 0, 1) : vec3(0, 1, 0);
    return glm::angleAxis(angles[0], first) * glm::angleAxis(angles[1], second) * glm::angleAxis(angles[2], kX);
}

std::array<float, 3> hingeAngles(const quat& rotation, bool yFirst) {
    const vec3 d = rotation * kX;
    float first = yFirst ? std::atan2(-d.z, d.x) : std::atan2(d.y, d.x);
    float second = std::asin(std::clamp(yFirst ? d.y : -d.z, -1.0F, 1.0F));
    // The same direction with the second past the right angle.
    const float otherFirst = first > 0.0F ? first - kPi : first + kPi;
    const float otherSecond = second > 0.0F ? kPi - second : -kPi - second;
    if (std::hypot(otherFirst, otherSecond) < std::hypot(first, second)) {
        first = otherFirst;
        second = otherSecond;
    }
    const quat swing = rotationOfHinges({first, second, 0.0F}, yFirst);
    const quat twist = glm::conjugate(swing) * rotation;
    return {first, second, std::remainder(2.0F * std::atan2(twist.x, twist.w), 2.0F * kPi)};
}

ThreeHinges threeHinges(const ConeTwistLimits& limits) {
    ThreeHinges hinges;
    hinges.yFirst = limits.swingY >= limits.swingZ;
    hinges.twistMax = limits.twist;
    hinges.firstMax = hinges.yFirst ? limits.swingY : limits.swingZ;
    hinges.secondMax = hinges.yFirst ? limits.swingZ : limits.swingY;
    for (int i = 0; i < kSamples; ++i) {
        const vec2 angles = glm::abs(onEllipse(limits, angleOfSample(i), hinges.yFirst));
        hinges.firstMax = std::max(hinges.firstMax, angles.x);
        hinges.secondMax = std::max(hinges.secondMax, angles.y);
    }
    float sum = 0.0F;  // of both angles, each as a share of its range
    for (int i = 0; i < kSamples; ++i) {
        const vec2 angles = glm::abs(onEllipse(limits, angleOfSample(i), hinges.yFirst));
        sum = std::max(sum, angles.x / hinges.firstMax + angles.y / hinges.secondMax);
        hinges.twistError =
            std::max(hinges.twistError, twistOf(onEllipse(limits, angleOfSample(i), hinges.yFirst), hinges.yFirst));
    }
    hinges.sumFirst = 1.0F / (hinges.firstMax * sum);
    hinges.sumSecond = 1.0F / (hinges.secondMax * sum);
    measure(limits, hinges);
    return hinges;
}

}  // namespace lutka::exporting
