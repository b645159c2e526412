#include "physics/collision/static_distance.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "physics/collision/shape.hpp"
#include "physics/collision/shape_distance.hpp"

namespace lutka::physics {
namespace {

constexpr float kNearMesh = 0.3F;  // metres: how far from a mesh a body's distance matters

// A box, sphere or capsule as what a body's shape would be.
PrimitiveShape solidOf(const StaticShape& geometry) {
    PrimitiveShape solid;
    solid.kind = geometry.kind == ShapeKind::box      ? PrimitiveShape::Kind::box
                 : geometry.kind == ShapeKind::sphere ? PrimitiveShape::Kind::sphere
                                                      : PrimitiveShape::Kind::capsule;
    solid.halfExtents = geometry.halfExtents;
    solid.radius = geometry.radius;
    solid.halfLength = geometry.halfLength;
    return solid;
}

// The least signed distance from a mesh along a segment. The distance changes by no more than the way along the
// segment, so that samples and halving steps around the least of them miss it by little.
float leastAlong(const TriangleMesh& mesh, const Segment& segment, float range) {
    constexpr int kSteps = 12;
    const auto distanceAt = [&](float t) {
        const MeshDistance distance = mesh.distanceTo(segment.at(t), range);
        return distance.found ? distance.distance : range;
    };
    const float length = glm::length(segment.end - segment.start);
    float best = 0.0F;
    float least = distanceAt(0.0F);
    if (length <= 0.0F || least > length + kNearMesh) return least;
    for (int i = 1; i <= kSteps; ++i) {
        const float t = static_cast<float>(i) / kSteps;
        const float distance = distanceAt(t);
        if (distance < least) {
            least = distance;
            best = t;
        }
    }
    for (float step = 0.5F / kSteps; step * length > 1e-4F; step *= 0.5F) {
        for (const float t : {best - step, best + step}) {
            const float distance = distanceAt(std::clamp(t, 0.0F, 1.0F));
            if (distance >= least) continue;
            least = distance;
            best = std::clamp(t, 0.0F, 1.0F);
            break;
        }
    }
    return least;
}

// The least signed distance of a segment's points from a box or hull, or `least` where none is below that: a convex
// function of the way along it, and no steeper than that way.
float leastAlong(const PrimitiveShape& solid, Segment segment, float least) {
    constexpr float kFineM = 1e-5F;
    float first = signedDistance(solid, segment.start);
    float last = signedDistance(solid, segment.end);
    least = std::min({least, first, last});
    float length = glm::length(segment.end - segment.start);
    while (length > kFineM && 0.5F * (first + last - length) < least) {
        const Segment thirds{segment.at(1.0F / 3.0F), segment.at(2.0F / 3.0F)};
        const float early = signedDistance(solid, thirds.start);
        const float late = signedDistance(solid, thirds.end);
        least = std::min({least, early, late});
        if (early < late) {
            segment.end = thirds.end;
            last = late;
        } else {
            segment.start = thirds.start;
            first = early;
        }
        length *= 2.0F / 3.0F;
    }
    return least;
}

// Round shapes exactly; boxes and hulls by their corners and the mesh's edges.
float distanceToMesh(const PrimitiveShape& shape, const RigidTransform& meshFromBody, const TriangleMesh& mesh) {
    const float reach = boundingRadius(shape);
    const float range = 2.0F * reach + kNearMesh;
    const vec3 gap =
        glm::max(glm::max(mesh.low() - meshFromBody.translation, meshFromBody.translation - mesh.high()), vec3(0));
    if (glm::length(gap) > range) return glm::length(gap) - reach;
    if (!shape.isAngular()) {
        const float half = shape.kind == PrimitiveShape::Kind::capsule ? shape.halfLength : 0.0F;
        const Segment core{meshFromBody * vec3(0, -half, 0), meshFromBody * vec3(0, half, 0)};
        return leastAlong(mesh, core, range) - shape.radius;
    }
    float least = range;
    const bool isHull = shape.kind == PrimitiveShape::Kind::hull;
    const int corners = isHull ? static_cast<int>(shape.hull->points().size()) : 8;
    for (int corner = 0; corner < corners; ++corner) {
        const vec3 point = isHull ? shape.hull->points()[corner] : boxCorner(shape.halfExtents, corner);
        const MeshDistance distance = mesh.distanceTo(meshFromBody * point, range);
        if (distance.found) least = std::min(least, distance.distance);
    }
    const RigidTransform bodyFromMesh = inverse(meshFromBody);
    mesh.forEachIn(meshFromBody.translation - reach, meshFromBody.translation + reach, [&](int triangle) {
        for (const int index : mesh.edgesOf(triangle)) {
            const TriangleMesh::Edge& edge = mesh.edges()[index];
            if (edge.triangle[0] != triangle) continue;
            const Segment inBody{bodyFromMesh * mesh.vertices()[edge.start], bodyFromMesh * mesh.vertices()[edge.end]};
            if (edge.sharp)
                least = leastAlong(shape, inBody, least);
            else
                least = std::min({least, signedDistance(shape, inBody.start), signedDistance(shape, inBody.end)});
        }
    });
    return least;
}

// The lowest corner of what faces up; the top where nothing does.
float lowestFloorOf(const TriangleMesh& mesh, const RigidTransform& worldFromMesh, const vec3& up) {
    float lowest = std::numeric_limits<float>::max();
    float highest = -lowest;
    const vec3 upInMesh = glm::conjugate(worldFromMesh.rotation) * up;
    for (std::size_t i = 0; i < mesh.triangles().size(); ++i) {
        const bool floor = glm::dot(mesh.normals()[i], upInMesh) > 0.5F;
        for (const int corner : mesh.triangles()[i]) {
            const float height = glm::dot(mesh.vertices()[corner], upInMesh);
            if (floor) lowest = std::min(lowest, height);
            highest = std::max(highest, height);
        }
    }
    return std::min(lowest, highest);
}

}  // namespace

float distanceToStatic(const PrimitiveShape& shape, const RigidTransform& worldFromBody, const StaticShape& geometry) {
    if (geometry.kind == StaticShape::Kind::mesh)
        return distanceToMesh(shape, inverse(geometry.worldFromShape) * worldFromBody, *geometry.mesh);
    if (geometry.kind != StaticShape::Kind::plane)
        return distanceBetween(shape, worldFromBody, solidOf(geometry), geometry.worldFromShape);
    const vec3 normal = geometry.worldFromShape.rotation * vec3(0, 1, 0);
    const float height = glm::dot(normal, worldFromBody.translation - geometry.worldFromShape.translation);
    return height - supportExtent(shape, glm::conjugate(worldFromBody.rotation) * -normal);
}

float distanceToStatic(const BodyShape& shape, const RigidTransform& worldFromBody, const StaticShape& geometry) {
    float least = distanceToStatic(static_cast<const PrimitiveShape&>(shape), worldFromBody, geometry);
    for (const AddedShape& added : shape.more)
        least = std::min(least, distanceToStatic(static_cast<const PrimitiveShape&>(added),
                                                 worldFromBody * added.bodyFromShape, geometry));
    return least;
}

float lowestSurface(std::span<const StaticShape> statics, const vec3& up) {
    float lowest = std::numeric_limits<float>::max();
    for (const StaticShape& shape : statics) {
        float top = glm::dot(shape.worldFromShape.translation, up);
        if (shape.kind == StaticShape::Kind::box) {
            const vec3 upInBox = glm::conjugate(shape.worldFromShape.rotation) * up;
            top += glm::dot(glm::abs(upInBox), shape.halfExtents);
        } else if (shape.kind == StaticShape::Kind::mesh) {
            top += lowestFloorOf(*shape.mesh, shape.worldFromShape, up);
        } else if (shape.kind != StaticShape::Kind::plane) {
            top += supportExtent(solidOf(shape), glm::conjugate(shape.worldFromShape.rotation) * up);
        }
        lowest = std::min(lowest, top);
    }
    return statics.empty() ? 0.0F : lowest;
}

}  // namespace lutka::physics
