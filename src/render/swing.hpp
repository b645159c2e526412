#pragma once

#include "core/math.hpp"

namespace lutka::render {

/// Segments of the rim of every drawn swing cone.
inline constexpr int kSwingRimSegments = 32;

/// Unit x turned by the rotation vector (0, swingY cos t, swingZ sin t): the rim of a cone-twist joint's swing limit in
/// its parent frame, t in radians around the rim.
[[nodiscard]] inline vec3 swungX(float swingY, float swingZ, float t) {
    const vec3 rotation(0.0F, swingY * std::cos(t), swingZ * std::sin(t));
    const float angle = std::sqrt(rotation.y * rotation.y + rotation.z * rotation.z);
    if (angle < 1e-6F) return {1, 0, 0};
    return glm::angleAxis(angle, rotation / angle) * vec3(1, 0, 0);
}

}  // namespace lutka::render
