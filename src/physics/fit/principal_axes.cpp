#include "physics/fit/principal_axes.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace lutka::physics {
namespace {

// Area-weighted mean; equal weights where all areas are 0.
vec3 centroidOf(std::span<const SkinPoint> points, bool weighted) {
    vec3 sum(0);
    float total = 0.0F;
    for (const SkinPoint& point : points) {
        const float weight = weighted ? point.area : 1.0F;
        sum += weight * point.position;
        total += weight;
    }
    return sum / total;
}

}  // namespace

PrincipalAxes principalAxes(std::span<const SkinPoint> points) {
    const bool weighted = std::any_of(points.begin(), points.end(), [](const SkinPoint& p) { return p.area > 0.0F; });
    PrincipalAxes result;
    result.centroid = centroidOf(points, weighted);
    mat3 covariance(0.0F);
    float total = 0.0F;
    for (const SkinPoint& point : points) {
        const vec3 d = point.position - result.centroid;
        const float weight = weighted ? point.area : 1.0F;
        covariance += weight * glm::outerProduct(d, d);
        total += weight;
    }
    covariance /= total;
    const mat3 axes = diagonalise(covariance);
    std::array<int, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](int a, int b) { return covariance[a][a] > covariance[b][b]; });
    for (int i = 0; i < 3; ++i) {
        result.axis[i] = axes[order[i]];
        result.spread[i] = std::sqrt(std::max(0.0F, covariance[order[i]][order[i]]));
    }
    return result;
}

}  // namespace lutka::physics
