#include "physics/collision/shape.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "physics/collision/box_manifold.hpp"
#include "physics/collision/hull_distance.hpp"
#include "physics/collision/shape_distance.hpp"
#include "physics/collision/solid_manifold.hpp"

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

SolidPlace solidOf(const PrimitiveShape& shape, const RigidTransform& worldFromShape) {
    return {shape.hull.get(), shape.halfExtents, worldFromShape.translation, glm::mat3_cast(worldFromShape.rotation)};
}

// Of a capsule or sphere from a box or hull.
float distanceToSolid(const PrimitiveShape& round, const RigidTransform& worldFromRound, const PrimitiveShape& solid,
                      const RigidTransform& worldFromSolid) {
    const Segment segment = segmentOf(round, inverse(worldFromSolid) * worldFromRound);
    const float along = solid.kind == PrimitiveShape::Kind::hull ? deepestOnSegment(segment, *solid.hull)
                                                                 : deepestOnSegment(segment, solid.halfExtents);
    return signedDistance(solid, segment.at(along)) - round.radius;
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
            thinnest = std::min(thinnest, thicknessOf(one));
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
        case PrimitiveShape::Kind::hull:
            return shape.hull->volume();
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
        case PrimitiveShape::Kind::hull: {
            const mat3& square = shape.hull->meanSquare();
            return massKg * vec3(square[1][1] + square[2][2], square[0][0] + square[2][2], square[0][0] + square[1][1]);
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
    if (shape.kind == PrimitiveShape::Kind::box) return distanceFromBox(bodyPoint, shape.halfExtents);
    if (shape.kind == PrimitiveShape::Kind::hull) return distanceToHull(bodyPoint, *shape.hull).distance;
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
    // Of boxes and hulls that are apart a lower bound of the gap.
    if (boxA && boxB) return leastOverlap(placeOf(a, worldFromA), placeOf(b, worldFromB)).distance;
    if (a.isAngular() && b.isAngular()) return distanceBetweenSolids(solidOf(a, worldFromA), solidOf(b, worldFromB));
    if (a.isAngular()) return distanceToSolid(b, worldFromB, a, worldFromA);
    if (b.isAngular()) return distanceToSolid(a, worldFromA, b, worldFromB);
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
    if (shape.kind == PrimitiveShape::Kind::hull) {
        float most = 0.0F;  // the origin is inside
        for (const vec3& point : shape.hull->points())
            most = std::max(most, glm::dot(bodyDirection, point));
        return most;
    }
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
    const bool even = shape.more.empty() && shape.kind != PrimitiveShape::Kind::hull;
    return even ? ahead : std::max(ahead, supportExtent(shape, -bodyDirection));
}

float thicknessOf(const PrimitiveShape& shape) {
    const vec3& half = shape.halfExtents;
    if (shape.kind == PrimitiveShape::Kind::box) return std::min({half.x, half.y, half.z});
    return shape.kind == PrimitiveShape::Kind::hull ? 0.5F * shape.hull->thickness() : shape.radius;
}

vec3 halfBox(const PrimitiveShape& shape) {
    switch (shape.kind) {
        case PrimitiveShape::Kind::box:
            return shape.halfExtents;
        case PrimitiveShape::Kind::hull:
            return shape.hull->halfBounds();
        case PrimitiveShape::Kind::capsule:
            return {shape.radius, shape.radius + shape.halfLength, shape.radius};
        case PrimitiveShape::Kind::sphere:
            break;
    }
    return vec3(shape.radius);
}

ConvexHullPtr hullWithin(const PrimitiveShape& shape) {
    if (shape.kind == PrimitiveShape::Kind::hull) return shape.hull;
    std::vector<vec3> points;
    if (shape.kind == PrimitiveShape::Kind::box) {
        for (int corner = 0; corner < 8; ++corner)
            points.push_back(boxCorner(shape.halfExtents, corner));
        return makeConvexHull(points);
    }
    // Of each cap its pole, a ring half way and one near its rim.
    const float half = shape.kind == PrimitiveShape::Kind::capsule ? shape.halfLength : 0.0F;
    constexpr int kRing = 7;
    for (const float side : {1.0F, -1.0F}) {
        points.emplace_back(0, side * (half + shape.radius), 0);
        for (const float up : {0.05F * kPi, 0.25F * kPi}) {
            for (int i = 0; i < kRing; ++i) {
                const float turn = 2.0F * kPi * static_cast<float>(i) / kRing;
                points.push_back(shape.radius * vec3(std::cos(up) * std::cos(turn), side * std::sin(up),
                                                     std::cos(up) * std::sin(turn)) +
                                 vec3(0, side * half, 0));
            }
        }
    }
    return makeConvexHull(points);
}

vec3 halfBoxOfMoments(const ConvexHull& hull) {
    const mat3& square = hull.meanSquare();
    return glm::sqrt(3.0F * vec3(square[0][0], square[1][1], square[2][2]));
}

StandIn standInFor(const ConvexHull& hull) {
    constexpr float kRounder = 1.06F;  // of the box's volume: an ellipsoid has 1.13 of that of the box of its moments
    const mat3& square = hull.meanSquare();
    StandIn standIn;
    PrimitiveShape& shape = standIn.shape;
    shape.kind = PrimitiveShape::Kind::box;
    shape.halfExtents = halfBoxOfMoments(hull);
    const vec3 half = shape.halfExtents;
    if (hull.volume() < kRounder * 8.0F * half.x * half.y * half.z) return standIn;
    const int longest = half.x > std::max(half.y, half.z) ? 0 : half.y >= half.z ? 1 : 2;
    shape.kind = PrimitiveShape::Kind::capsule;
    // A disc's mean square across is a quarter of its radius', an interval's a third of its half length's.
    shape.radius = std::sqrt(2.0F * (square[0][0] + square[1][1] + square[2][2] - square[longest][longest]));
    const float end = 0.5F * (hull.high()[longest] - hull.low()[longest]);
    shape.halfLength = std::max(end - shape.radius, 0.0F);
    vec3 along(0);
    along[longest] = 1.0F;
    standIn.hullFromShape.rotation = rotationBetween({0, 1, 0}, along);
    standIn.hullFromShape.translation[longest] = 0.5F * (hull.high()[longest] + hull.low()[longest]);
    return standIn;
}

float boundingRadius(const PrimitiveShape& shape) {
    if (shape.kind == PrimitiveShape::Kind::box) return glm::length(shape.halfExtents);
    if (shape.kind == PrimitiveShape::Kind::hull) return shape.hull->reach();
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
