#include "physics/fit/few_points.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/quantile.hpp"
#include "physics/fit/principal_axes.hpp"

namespace lutka::physics {

Capsule capsuleAlong(const std::vector<SkinPoint>& points, const FewPointsBounds& bounds) {
    constexpr float kAcross = 0.7F;
    const PrincipalAxes axes = principalAxes(points);
    vec3 along = axes.axis[0];
    vec3 middle = axes.centroid;
    if (bounds.symmetric) {
        const vec3 flat(0, along.y, along.z);
        along = std::abs(along.x) > kAcross ? vec3(1, 0, 0) : glm::normalize(flat);
        middle.x = bounds.middleX;
    }
    const auto ahead = [&](const SkinPoint& point) { return glm::dot(point.position - middle, along); };
    const auto aside = [&](const SkinPoint& point) {
        return glm::length(point.position - middle - ahead(point) * along);
    };
    const float radius = std::clamp(quantileOf(points, 0.5F, aside), bounds.smallestRadius, bounds.largestRadius);
    const float low = quantileOf(points, 0.0F, ahead);
    const float high = quantileOf(points, 1.0F, ahead);
    return {middle + std::min(low + radius, 0.0F) * along, middle + std::max(high - radius, 0.0F) * along, radius};
}

}  // namespace lutka::physics
