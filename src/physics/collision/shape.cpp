#include "physics/collision/shape.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "physics/collision/shape_distance.hpp"

namespace lutka::physics {
namespace {

// The core of a capsule or sphere in the world: what the radius rounds.
Segment segmentOf(const BodyShape& shape, const RigidTransform& worldFromBody) {
    const float half = shape.kind == BodyShape::Kind::capsule ? shape.halfLength : 0.0F;
    return {worldFromBody * vec3(0, -half, 0), worldFromBody * vec3(0, half, 0)};
}

float distanceToPlacedBox(const BodyShape& round, const RigidTransform& worldFromRound, const BodyShape& box,
                          const RigidTransform& worldFromBox) {
    const Segment segment = segmentOf(round, inverse(worldFromBox) * worldFromRound);
    const vec3 deepest = segment.at(deepestOnSegment(segment, box.halfExtents));
    return distanceToBox(deepest, box.halfExtents).distance - round.radius;
}

}  // namespace

float shapeVolume(const BodyShape& shape) {
    const float r = shape.radius;
    const float sphere = 4.0F / 3.0F * kPi * r * r * r;
    switch (shape.kind) {
        case BodyShape::Kind::sphere:
            return sphere;
        case BodyShape::Kind::capsule:
            return sphere + kPi * r * r * 2.0F * shape.halfLength;
        case BodyShape::Kind::box:
            break;
    }
    return 8.0F * shape.halfExtents.x * shape.halfExtents.y * shape.halfExtents.z;
}

vec3 shapeInertia(const BodyShape& shape, float massKg) {
    const float r = shape.radius;
    const float h = shape.halfLength;
    switch (shape.kind) {
        case BodyShape::Kind::sphere:
            return vec3(0.4F * massKg * r * r);
        case BodyShape::Kind::capsule: {
            const float sphereVolume = 4.0F / 3.0F * kPi * r * r * r;
            const float caps = massKg * sphereVolume / shapeVolume(shape);
            const float cylinder = massKg - caps;
            const float axial = 0.5F * cylinder * r * r + 0.4F * caps * r * r;
            const float across =
                cylinder * (0.25F * r * r + h * h / 3.0F) + caps * (0.4F * r * r + h * h + 0.75F * h * r);
            return {across, axial, across};
        }
        case BodyShape::Kind::box:
            break;
    }
    const vec3 square = shape.halfExtents * shape.halfExtents;
    return massKg / 3.0F * vec3(square.y + square.z, square.x + square.z, square.x + square.y);
}

float signedDistance(const BodyShape& shape, const vec3& bodyPoint) {
    if (shape.kind == BodyShape::Kind::box) return distanceToBox(bodyPoint, shape.halfExtents).distance;
    const float half = shape.kind == BodyShape::Kind::capsule ? shape.halfLength : 0.0F;
    const vec3 onAxis(0, std::clamp(bodyPoint.y, -half, half), 0);
    return glm::distance(bodyPoint, onAxis) - shape.radius;
}

float distanceBetween(const BodyShape& a, const RigidTransform& worldFromA, const BodyShape& b,
                      const RigidTransform& worldFromB) {
    const bool boxA = a.kind == BodyShape::Kind::box;
    const bool boxB = b.kind == BodyShape::Kind::box;
    if (boxA && boxB) return distanceBetweenBoxes(a.halfExtents, worldFromA, b.halfExtents, worldFromB);
    if (boxA) return distanceToPlacedBox(b, worldFromB, a, worldFromA);
    if (boxB) return distanceToPlacedBox(a, worldFromA, b, worldFromB);
    const Segment segmentA = segmentOf(a, worldFromA);
    const Segment segmentB = segmentOf(b, worldFromB);
    const SegmentPair closest = closestBetweenSegments(segmentA, segmentB);
    return glm::distance(segmentA.at(closest.s), segmentB.at(closest.t)) - a.radius - b.radius;
}

float supportExtent(const BodyShape& shape, const vec3& bodyDirection) {
    if (shape.kind == BodyShape::Kind::box) return glm::dot(glm::abs(bodyDirection), shape.halfExtents);
    const float half = shape.kind == BodyShape::Kind::capsule ? shape.halfLength : 0.0F;
    return shape.radius + half * std::abs(bodyDirection.y);
}

float boundingRadius(const BodyShape& shape) {
    if (shape.kind == BodyShape::Kind::box) return glm::length(shape.halfExtents);
    return shape.radius + (shape.kind == BodyShape::Kind::capsule ? shape.halfLength : 0.0F);
}

}  // namespace lutka::physics
