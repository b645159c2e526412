#include "physics/principal_axes.hpp"

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

// One of Jacobi's rotations: makes the covariance's element (p, q) zero.
void rotateAway(mat3& covariance, mat3& axes, int p, int q) {
    if (std::abs(covariance[p][q]) < 1e-20F) return;
    const float angle = 0.5F * std::atan2(2.0F * covariance[p][q], covariance[q][q] - covariance[p][p]);
    mat3 turn(1.0F);
    turn[p][p] = turn[q][q] = std::cos(angle);
    turn[q][p] = std::sin(angle);
    turn[p][q] = -std::sin(angle);
    covariance = glm::transpose(turn) * covariance * turn;
    axes = axes * turn;
}

}  // namespace

mat3 diagonalise(mat3& matrix) {
    constexpr int kSweeps = 12;
    mat3 axes(1.0F);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        rotateAway(matrix, axes, 0, 1);
        rotateAway(matrix, axes, 0, 2);
        rotateAway(matrix, axes, 1, 2);
    }
    return axes;
}

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
