#include "physics/profile/body_shape.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "core/math.hpp"

namespace lutka::physics {
namespace {

// The spread of the solid about its centroid.
mat3 covarianceOf(const ConvexHull& hull) {
    return hull.meanSquare() - glm::outerProduct(hull.centroid(), hull.centroid());
}

// Principal axes as a rotation that turns as little as may be. None where the frame's own axes nearly are principal:
// those of a round solid could be any.
quat principalTurn(mat3 covariance) {
    constexpr float kNearly = 0.02F;
    const float most = std::max({covariance[0][0], covariance[1][1], covariance[2][2]});
    const float off = std::max({std::abs(covariance[0][1]), std::abs(covariance[0][2]), std::abs(covariance[1][2])});
    if (off <= kNearly * most) return {1, 0, 0, 0};
    const mat3 axes = diagonalise(covariance);
    std::array<int, 3> order{0, 1, 2};
    std::array<int, 3> best = order;
    float nearest = -1.0F;
    do {
        const float near = std::abs(axes[order[0]].x) + std::abs(axes[order[1]].y) + std::abs(axes[order[2]].z);
        if (near <= nearest) continue;
        nearest = near;
        best = order;
    } while (std::next_permutation(order.begin(), order.end()));
    mat3 turned(1);
    for (int i = 0; i < 3; ++i)
        turned[i] = axes[best[i]][i] < 0.0F ? -axes[best[i]] : axes[best[i]];
    if (glm::determinant(turned) < 0.0F) turned[2] = -turned[2];
    return glm::normalize(glm::quat_cast(turned));
}

vec3 acrossX(const vec3& point) {
    return {-point.x, point.y, point.z};
}

void mirrorHull(PrimitiveShape& shape) {
    if (shape.kind == PrimitiveShape::Kind::hull) shape.hull = movedHull(*shape.hull, acrossX);
}

}  // namespace

bool isCentred(const ConvexHull& hull) {
    constexpr float kShare = 0.01F;
    return glm::length(hull.centroid()) <= kShare * hull.reach();
}

CentredHull centredHull(const ConvexHull& hull) {
    CentredHull centred;
    centred.frameFromShape = {principalTurn(covarianceOf(hull)), hull.centroid()};
    const RigidTransform shapeFromFrame = inverse(centred.frameFromShape);
    centred.shape.kind = PrimitiveShape::Kind::hull;
    centred.shape.hull = movedHull(hull, [&](const vec3& point) { return shapeFromFrame * point; });
    return centred;
}

void scaleHull(PrimitiveShape& shape, const vec3& factors) {
    ConvexHullPtr scaled = movedHull(*shape.hull, [&](const vec3& point) { return factors * point; });
    if (scaled != nullptr) shape.hull = std::move(scaled);
}

BodyShape mirrored(BodyShape shape) {
    mirrorHull(shape);
    for (AddedShape& added : shape.more) {
        mirrorHull(added);
        const quat& q = added.bodyFromShape.rotation;
        added.bodyFromShape.rotation = {q.w, q.x, -q.y, -q.z};
        added.bodyFromShape.translation.x = -added.bodyFromShape.translation.x;
    }
    return shape;
}

}  // namespace lutka::physics
