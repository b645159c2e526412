#pragma once

#include <algorithm>

namespace lutka::animation {

/// Log-density of a normal distribution without its constant: 0 at `mean`, never below `-worst`.
[[nodiscard]] inline float near(float value, float mean, float deviation, float worst = 6.0F) {
    const float z = (value - mean) / deviation;
    return std::max(-0.5F * z * z, -worst);
}

/// As near(), but 0 for all values up to `limit`.
[[nodiscard]] inline float atMost(float value, float limit, float deviation, float worst = 6.0F) {
    return value <= limit ? 0.0F : near(value, limit, deviation, worst);
}

/// As near(), but 0 for all values from `limit` on.
[[nodiscard]] inline float atLeast(float value, float limit, float deviation, float worst = 6.0F) {
    return value >= limit ? 0.0F : near(value, limit, deviation, worst);
}

}  // namespace lutka::animation
