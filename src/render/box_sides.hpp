#pragma once

#include <array>

#include "core/math.hpp"

namespace lutka::render {

/// A side of the box whose corners are at ±1.
struct BoxSide {
    vec3 normal{0, 0, 1};         ///< Unit, outward.
    std::array<vec3, 4> corners;  ///< Counter-clockwise from outside.
};

/// All six sides, those across x first.
[[nodiscard]] inline std::array<BoxSide, 6> boxSides() {
    std::array<BoxSide, 6> sides;
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        const float sign = side % 2 == 0 ? -1.0F : 1.0F;
        vec3 n(0);
        vec3 u(0);
        vec3 v(0);
        n[axis] = sign;
        u[(axis + 1) % 3] = 1.0F;
        v[(axis + 2) % 3] = sign;
        sides[static_cast<std::size_t>(side)] = {n, {n - u - v, n + u - v, n + u + v, n - u + v}};
    }
    return sides;
}

}  // namespace lutka::render
