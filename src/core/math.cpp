#include "core/math.hpp"

#include <glm/geometric.hpp>

namespace lutka {
namespace {

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

quat rotationBetween(const vec3& from, const vec3& to) {
    const vec3 a = glm::normalize(from);
    const vec3 b = glm::normalize(to);
    const float cosine = glm::dot(a, b);
    if (cosine < -0.999999F) return glm::angleAxis(kPi, anyPerpendicular(a));
    const vec3 axis = glm::cross(a, b);
    // Half-angle form: (1 + cos, axis * sin) is the wanted quaternion up to its length.
    return glm::normalize(quat(1.0F + cosine, axis.x, axis.y, axis.z));
}

vec3 rotationVector(const quat& rotation) {
    const quat q = rotation.w < 0.0F ? -rotation : rotation;
    const vec3 v(q.x, q.y, q.z);
    const float sine = glm::length(v);
    if (sine < 1e-9F) return 2.0F * v;
    return v * (2.0F * std::atan2(sine, q.w) / sine);
}

vec3 anyPerpendicular(const vec3& direction) {
    const vec3 other = std::abs(direction.x) < 0.6F ? vec3(1, 0, 0) : vec3(0, 1, 0);
    return glm::normalize(glm::cross(direction, other));
}

quat rotationFromXY(const vec3& x, const vec3& y) {
    const vec3 unitX = glm::normalize(x);
    const vec3 unitZ = glm::normalize(glm::cross(unitX, y));
    return glm::normalize(glm::quat_cast(mat3(unitX, glm::cross(unitZ, unitX), unitZ)));
}

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

}  // namespace lutka
