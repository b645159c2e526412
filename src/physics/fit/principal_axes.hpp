#pragma once

#include <array>
#include <span>

#include "physics/fit/skin_point.hpp"

namespace lutka::physics {

/// The area-weighted centroid of skin points and the directions of their spread, widest first.
struct PrincipalAxes {
    vec3 centroid{0, 0, 0};
    std::array<vec3, 3> axis{vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)};  ///< Unit, across one another.
    std::array<float, 3> spread{0, 0, 0};                                   ///< Standard deviation along each, metres.
};

/// By diagonalise() on the covariance matrix. At least one point.
[[nodiscard]] PrincipalAxes principalAxes(std::span<const SkinPoint> points);

}  // namespace lutka::physics
