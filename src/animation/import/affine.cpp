#include "animation/import/affine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

namespace lutka::animation::rig_import {
namespace {

// Determinant of the linear part over the product of its columns' lengths: 1 for orthogonal columns, 0 for flat ones.
double solidity(const dmat3& m) {
    const double lengths = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
    return lengths > 0.0 ? std::abs(glm::determinant(m)) / lengths : 0.0;
}

// Of a frame that is nearly a scaled rotation, which nearly all are: the square of the scale. 0 for all others, also
// for what is not finite or so small or large that it is looked at more closely.
double squareOfScale(const dmat4& m) {
    const dvec3 x(m[0]);
    const dvec3 y(m[1]);
    const dvec3 z(m[2]);
    const double xx = glm::dot(x, x);
    const double yy = glm::dot(y, y);
    const double zz = glm::dot(z, z);
    const double mean = (xx + yy + zz) / 3.0;
    const double unequal = std::abs(xx - mean) + std::abs(yy - mean) + std::abs(zz - mean);
    const double skew = std::abs(glm::dot(x, y)) + std::abs(glm::dot(x, z)) + std::abs(glm::dot(y, z));
    const bool plain = mean > 1e-20 && mean < 1e20 && unequal < 0.3 * mean && skew < 0.1 * mean;
    return plain && std::isfinite(m[3].x + m[3].y + m[3].z) ? mean : 0.0;
}

// A rotation from what is left of a flat frame: the longest column is kept, the next made perpendicular to it.
dmat3 rotationFromFlat(const dmat3& m) {
    std::array<int, 3> order = {0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return glm::length(m[a]) > glm::length(m[b]); });
    dmat3 out(1.0);
    if (!(glm::length(m[order[0]]) > 1e-30)) return out;
    const dvec3 first = glm::normalize(m[order[0]]);
    dvec3 second = m[order[1]] - first * glm::dot(first, m[order[1]]);
    if (!(glm::length(second) > 1e-9 * glm::length(m[order[0]]))) {
        const dvec3 other = std::abs(first.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
        second = glm::cross(first, other);
    }
    out[order[0]] = first;
    out[order[1]] = glm::normalize(second);
    out[order[2]] = glm::cross(out[order[0]], out[order[1]]);
    if (glm::determinant(out) < 0.0) out[order[2]] = -out[order[2]];
    return out;
}

}  // namespace

bool allFinite(const dmat4& matrix) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(matrix[column][row])) return false;
        }
    }
    return true;
}

double meanScale(const dmat4& matrix) {
    return std::cbrt(std::abs(glm::determinant(dmat3(matrix))));
}

bool isInvertible(const dmat4& matrix) {
    return allFinite(matrix) && solidity(dmat3(matrix)) > 1e-7 && meanScale(matrix) > 1e-12;
}

dmat3 nearestRotation(const dmat4& matrix) {
    dmat3 m(matrix);
    if (const double square = squareOfScale(matrix); square > 0.0) {
        m /= std::sqrt(square);
    } else {
        if (!allFinite(matrix)) return dmat3(1.0);
        if (!isInvertible(matrix)) return rotationFromFlat(m);
        m /= meanScale(matrix);
    }
    for (int i = 0; i < 60; ++i) {
        const dmat3 next = 0.5 * (m + glm::inverse(glm::transpose(m)));
        double change = 0.0;
        for (int column = 0; column < 3; ++column) {
            const dvec3 step = next[column] - m[column];
            change = std::max(change, glm::dot(step, step));
        }
        m = next;
        if (change < 1e-26) break;
    }
    return glm::determinant(m) < 0.0 ? -m : m;
}

RigidTransform rigidPart(const dmat4& matrix) {
    const dvec3 translation(matrix[3]);
    const bool usable = std::isfinite(translation.x) && std::isfinite(translation.y) && std::isfinite(translation.z);
    const glm::dquat rotation = glm::normalize(glm::quat_cast(nearestRotation(matrix)));
    return {glm::normalize(quat(rotation)), usable ? vec3(translation) : vec3(0)};
}

double angleBetween(const dmat3& a, const dmat3& b) {
    const dmat3 between = glm::transpose(a) * b;
    const double trace = between[0][0] + between[1][1] + between[2][2];
    return std::acos(std::clamp((trace - 1.0) / 2.0, -1.0, 1.0));
}

std::optional<dmat4> affineBetween(std::span<const dvec3> from, std::span<const dvec3> to) {
    constexpr std::size_t kFewest = 8;  // with fewer almost any points are taken to almost any others
    if (from.size() < kFewest || from.size() != to.size()) return std::nullopt;
    const double count = static_cast<double>(from.size());
    dvec3 middleFrom(0);
    dvec3 middleTo(0);
    for (std::size_t i = 0; i < from.size(); ++i) {
        middleFrom += from[i] / count;
        middleTo += to[i] / count;
    }
    dmat3 spread(0);
    dmat3 moved(0);
    for (std::size_t i = 0; i < from.size(); ++i) {
        spread += glm::outerProduct(from[i] - middleFrom, from[i] - middleFrom);
        moved += glm::outerProduct(to[i] - middleTo, from[i] - middleFrom);
    }
    if (!isInvertible(dmat4(spread))) return std::nullopt;
    const dmat3 linear = moved * glm::inverse(spread);
    if (!(glm::determinant(linear) > 0.0)) return std::nullopt;
    dmat4 out(linear);
    out[3] = dvec4(middleTo - linear * middleFrom, 1.0);
    return out;
}

}  // namespace lutka::animation::rig_import
