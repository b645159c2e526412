#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "core/math.hpp"

namespace lutka {

/// The axis-aligned box around points, in their space and unit: vec2, vec3 or dvec3. Empty before the first. Points
/// that are not finite count for nothing along the axes on which they are NaN.
template <class Vector>
struct AabbOf {
    using Number = typename Vector::value_type;

    Vector low{std::numeric_limits<Number>::max()};
    Vector high{std::numeric_limits<Number>::lowest()};

    void add(const Vector& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    void add(const AabbOf& other) {
        add(other.low);
        add(other.high);
    }
    [[nodiscard]] bool empty() const { return low.x > high.x; }
    // Of a box that is not empty.
    [[nodiscard]] Vector size() const { return high - low; }
    [[nodiscard]] Vector middle() const { return Number(0.5) * (low + high); }
    [[nodiscard]] Number diagonal() const { return glm::length(high - low); }
    /// Of a point from the box; 0 inside.
    [[nodiscard]] Number distanceTo(const Vector& point) const {
        return glm::length(glm::max(glm::max(low - point, point - high), Vector(0)));
    }
};
using Aabb = AabbOf<vec3>;

}  // namespace lutka
