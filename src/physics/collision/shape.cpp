#include "physics/collision/shape.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "physics/collision/box_manifold.hpp"
#include "physics/collision/shape_distance.hpp"

namespace lutka::physics {
namespace {

BoxPlace placeOf(const PrimitiveShape& box, const RigidTransform& worldFromBox) {
    return {box.halfExtents, worldFromBox.translation, glm::mat3_cast(worldFromBox.rotation)};
}

// The core of a capsule or sphere in the world: what the radius rounds.
Segment segmentOf(const PrimitiveShape& shape, const RigidTransform& worldFromBody) {
    const float half = shape.kind == PrimitiveShape::Kind::capsule ? shape.halfLength : 0.0F;
    return {worldFromBody * vec3(0, -half, 0), worldFromBody * vec3(0, half, 0)};
}

float distanceToPlacedBox(const PrimitiveShape& round, const RigidTransform& worldFromRound, const PrimitiveShape& box,
                          const RigidTransform& worldFromBox) {
    const Segment segment = segmentOf(round, inverse(worldFromBox) * worldFromRound);
    const vec3 deepest = segment.at(deepestOnSegment(segment, box.halfExtents));
    return distanceToBox(deepest, box.halfExtents).distance - round.radius;
}

// The union of a body's shapes as the middles of a grid's cells that lie in it.
class UnionGrid {
  public:
    explicit UnionGrid(const BodyShape& shape) : shape_(shape) {
        constexpr float kCellsAcross = 16.0F;  // of the thinnest shape
        constexpr float kFewest = 32.0F;       // along a side
        constexpr float kMost = 128.0F;
        low_ = {-supportExtent(shape, {-1, 0, 0}), -supportExtent(shape, {0, -1, 0}),
                -supportExtent(shape, {0, 0, -1})};
        high_ = {supportExtent(shape, {1, 0, 0}), supportExtent(shape, {0, 1, 0}), supportExtent(shape, {0, 0, 1})};
        float thinnest = std::numeric_limits<float>::max();
        visitShapes(shape, [&](const PrimitiveShape& one, const RigidTransform&) {
            const vec3& half = one.halfExtents;
            thinnest = std::min(
                thinnest, one.kind == PrimitiveShape::Kind::box ? std::min({half.x, half.y, half.z}) : one.radius);
        });
        const vec3 size = high_ - low_;
        cell_ = size / glm::clamp(glm::ceil(size * (0.5F * kCellsAcross / thinnest)), kFewest, kMost);
    }

    template <class Visit>
    void visitInside(Visit visit) const {
        for (float x = low_.x + 0.5F * cell_.x; x < high_.x; x += cell_.x) {
            for (float y = low_.y + 0.5F * cell_.y; y < high_.y; y += cell_.y) {
                for (float z = low_.z + 0.5F * cell_.z; z < high_.z; z += cell_.z) {
                    const vec3 point(x, y, z);
                    if (signedDistance(shape_, point) <= 0.0F) visit(point);
                }
            }
        }
    }

    [[nodiscard]] const vec3& cell() const { return cell_; }

  private:
    const BodyShape& shape_;
    vec3 low_{0, 0, 0};
    vec3 high_{0, 0, 0};
    vec3 cell_{0, 0, 0};
};

}  // namespace

float shapeVolume(const PrimitiveShape& shape) {
    const float r = shape.radius;
    const float sphere = 4.0F / 3.0F * kPi * r * r * r;
    switch (shape.kind) {
        case PrimitiveShape::Kind::sphere:
            return sphere;
        case PrimitiveShape::Kind::capsule:
            return sphere + kPi * r * r * 2.0F * shape.halfLength;
        case PrimitiveShape::Kind::box:
            break;
    }
    return 8.0F * shape.halfExtents.x * shape.halfExtents.y * shape.halfExtents.z;
}

float shapeVolume(const BodyShape& shape) {
    if (shape.more.empty()) return shapeVolume(static_cast<const PrimitiveShape&>(shape));
    const UnionGrid grid(shape);
    double cells = 0.0;
    grid.visitInside([&](const vec3&) { ++cells; });
    const vec3& cell = grid.cell();
    // A shape that is thin beside the others may lie between the points.
    return std::max(static_cast<float>(cells) * cell.x * cell.y * cell.z,
                    shapeVolume(static_cast<const PrimitiveShape&>(shape)));
}

vec3 shapeInertia(const PrimitiveShape& shape, float massKg) {
    const float r = shape.radius;
    const float h = shape.halfLength;
    switch (shape.kind) {
        case PrimitiveShape::Kind::sphere:
            return vec3(0.4F * massKg * r * r);
        case PrimitiveShape::Kind::capsule: {
            const float sphereVolume = 4.0F / 3.0F * kPi * r * r * r;
            const float caps = massKg * sphereVolume / shapeVolume(shape);
            const float cylinder = massKg - caps;
            const float axial = 0.5F * cylinder * r * r + 0.4F * caps * r * r;
            const float across =
                cylinder * (0.25F * r * r + h * h / 3.0F) + caps * (0.4F * r * r + h * h + 0.75F * h * r);
            return {across, axial, across};
        }
        case PrimitiveShape::Kind::box:
            break;
    }
    const vec3 square = shape.halfExtents * shape.halfExtents;
    return massKg / 3.0F * vec3(square.y + square.z, square.x + square.z, square.x + square.y);
}

vec3 shapeInertia(const BodyShape& shape, float massKg) {
    if (shape.more.empty()) return shapeInertia(static_cast<const PrimitiveShape&>(shape), massKg);
    const UnionGrid grid(shape);
    glm::dvec3 squares(0);
    double cells = 0.0;
    grid.visitInside([&](const vec3& point) {
        squares += glm::dvec3(point * point);
        ++cells;
    });
    if (cells == 0.0) return shapeInertia(static_cast<const PrimitiveShape&>(shape), massKg);
    const vec3 mean = vec3(squares / cells) + grid.cell() * grid.cell() / 12.0F;  // and within the cells
    return massKg * vec3(mean.y + mean.z, mean.x + mean.z, mean.x + mean.y);
}

float signedDistance(const PrimitiveShape& shape, const vec3& bodyPoint) {
    if (shape.kind == PrimitiveShape::Kind::box) return distanceToBox(bodyPoint, shape.halfExtents).distance;
    const float half = shape.kind == PrimitiveShape::Kind::capsule ? shape.halfLength : 0.0F;
    const vec3 onAxis(0, std::clamp(bodyPoint.y, -half, half), 0);
    return glm::distance(bodyPoint, onAxis) - shape.radius;
}

float signedDistance(const BodyShape& shape, const vec3& bodyPoint) {
    float least = signedDistance(static_cast<const PrimitiveShape&>(shape), bodyPoint);
    for (const AddedShape& added : shape.more)
        least = std::min(
            least, signedDistance(static_cast<const PrimitiveShape&>(added), inverse(added.bodyFromShape) * bodyPoint));
    return least;
}

float distanceBetween(const PrimitiveShape& a, const RigidTransform& worldFromA, const PrimitiveShape& b,
                      const RigidTransform& worldFromB) {
    const bool boxA = a.kind == PrimitiveShape::Kind::box;
    const bool boxB = b.kind == PrimitiveShape::Kind::box;
    // Of boxes that are apart a lower bound of the gap.
    if (boxA && boxB) return leastOverlap(placeOf(a, worldFromA), placeOf(b, worldFromB)).distance;
    if (boxA) return distanceToPlacedBox(b, worldFromB, a, worldFromA);
    if (boxB) return distanceToPlacedBox(a, worldFromA, b, worldFromB);
    const Segment segmentA = segmentOf(a, worldFromA);
    const Segment segmentB = segmentOf(b, worldFromB);
    const SegmentPair closest = closestBetweenSegments(segmentA, segmentB);
    return glm::distance(segmentA.at(closest.s), segmentB.at(closest.t)) - a.radius - b.radius;
}

float distanceBetween(const BodyShape& a, const RigidTransform& worldFromA, const BodyShape& b,
                      const RigidTransform& worldFromB) {
    const PrimitiveShape& mainA = a;
    const PrimitiveShape& mainB = b;
    if (a.more.empty() && b.more.empty()) return distanceBetween(mainA, worldFromA, mainB, worldFromB);
    float least = std::numeric_limits<float>::max();
    visitShapes(a, [&](const PrimitiveShape& partA, const RigidTransform& inA) {
        visitShapes(b, [&](const PrimitiveShape& partB, const RigidTransform& inB) {
            least = std::min(least, distanceBetween(partA, worldFromA * inA, partB, worldFromB * inB));
        });
    });
    return least;
}

float supportExtent(const PrimitiveShape& shape, const vec3& bodyDirection) {
    if (shape.kind == PrimitiveShape::Kind::box) return glm::dot(glm::abs(bodyDirection), shape.halfExtents);
    const float half = shape.kind == PrimitiveShape::Kind::capsule ? shape.halfLength : 0.0F;
    return shape.radius + half * std::abs(bodyDirection.y);
}

float supportExtent(const BodyShape& shape, const vec3& bodyDirection) {
    float most = supportExtent(static_cast<const PrimitiveShape&>(shape), bodyDirection);
    for (const AddedShape& added : shape.more) {
        const vec3 inShape = glm::conjugate(added.bodyFromShape.rotation) * bodyDirection;
        most = std::max(most, glm::dot(added.bodyFromShape.translation, bodyDirection) +
                                  supportExtent(static_cast<const PrimitiveShape&>(added), inShape));
    }
    return most;
}

float halfWidth(const BodyShape& shape, const vec3& bodyDirection) {
    const float ahead = supportExtent(shape, bodyDirection);
    return shape.more.empty() ? ahead : std::max(ahead, supportExtent(shape, -bodyDirection));
}

float boundingRadius(const PrimitiveShape& shape) {
    if (shape.kind == PrimitiveShape::Kind::box) return glm::length(shape.halfExtents);
    return shape.radius + (shape.kind == PrimitiveShape::Kind::capsule ? shape.halfLength : 0.0F);
}

float boundingRadius(const BodyShape& shape) {
    float most = boundingRadius(static_cast<const PrimitiveShape&>(shape));
    for (const AddedShape& added : shape.more)
        most = std::max(most, glm::length(added.bodyFromShape.translation) +
                                  boundingRadius(static_cast<const PrimitiveShape&>(added)));
    return most;
}

}  // namespace lutka::physics
