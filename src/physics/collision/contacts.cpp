#include "physics/collision/contacts.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <utility>

#include "physics/collision/hull_distance.hpp"
#include "physics/collision/mesh_contacts.hpp"
#include "physics/collision/solid_corners.hpp"

namespace lutka::physics {
namespace {

Segment coreOf(const CollisionGeometry& round) {
    const vec3 half = round.worldFromShape.rotation * vec3(0, round.halfLength, 0);
    return {round.worldFromShape.translation - half, round.worldFromShape.translation + half};
}

void roundOnPlane(const CollisionGeometry& round, const CollisionGeometry& plane, float margin, ContactList& out) {
    const vec3 normal = plane.worldFromShape.rotation * vec3(0, 1, 0);
    const Segment core = coreOf(round);
    const int ends = round.halfLength > 0.0F ? 2 : 1;
    for (int end = 0; end < ends; ++end) {
        const vec3 centre = end == 0 ? core.start : core.end;
        const float height = glm::dot(centre - plane.worldFromShape.translation, normal);
        if (height - round.radius < margin) out.add({end, centre - height * normal, normal, height - round.radius});
    }
}

void cornersOnPlane(const CollisionGeometry& solid, const CollisionGeometry& plane, float margin, ContactList& out) {
    const vec3 normal = plane.worldFromShape.rotation * vec3(0, 1, 0);
    const SolidCorners corners(solid);
    std::array<SurfaceContact, ConvexHull::kMostPoints> all;
    for (int corner = 0; corner < corners.count(); ++corner) {
        const vec3 point = solid.worldFromShape * corners[corner];
        const float height = glm::dot(point - plane.worldFromShape.translation, normal);
        all[corner] = {corner, point - height * normal, normal, height};
    }
    const int most = std::min(solid.kind == ShapeKind::box ? 4 : ContactList::kMax, corners.count());  // 4: of a face
    std::partial_sort(all.begin(), all.begin() + most, all.begin() + corners.count(),
                      [](const SurfaceContact& p, const SurfaceContact& q) { return p.distance < q.distance; });
    for (int i = 0; i < most && all[i].distance < margin; ++i)
        out.add(all[i]);
}

void roundOnSolid(const CollisionGeometry& round, const CollisionGeometry& solid, float margin, ContactList& out) {
    const RigidTransform solidFromWorld = inverse(solid.worldFromShape);
    const Segment world = coreOf(round);
    const Segment core{solidFromWorld * world.start, solidFromWorld * world.end};
    // Most pairs that the broadphase reports don't touch.
    const float reach = round.radius + margin;
    if (SolidCorners(solid).distanceTo(core.at(0.5F)).distance > reach + round.halfLength) return;
    const CoreTouches touches =
        solid.kind == ShapeKind::hull ? touchHull(core, *solid.hull, reach) : touchBox(core, solid.halfExtents, reach);
    for (int i = 0; i < touches.count; ++i) {
        const auto& [along, surface, part] = touches.points[i];
        const vec3 onSolid = core.at(along) - surface.distance * surface.normal;
        out.add({part, solid.worldFromShape * onSolid, solid.worldFromShape.rotation * surface.normal,
                 surface.distance - round.radius});
    }
}

void roundPoints(const CollisionGeometry& a, const CollisionGeometry& b, const vec3& onA, const vec3& onB, float margin,
                 int feature, ContactList& out) {
    const vec3 between = onA - onB;
    const float distance = glm::length(between) - a.radius - b.radius;
    if (distance >= margin) return;
    const vec3 up(0, 1, 0);
    const vec3 normal = directionBetween(between, a.worldFromShape.rotation * up, b.worldFromShape.rotation * up);
    out.add({feature, onB + b.radius * normal, normal, distance});
}

// The fraction of `segment` that is nearest to `point`.
float nearestOn(const Segment& segment, const vec3& point) {
    const vec3 along = segment.end - segment.start;
    const float square = glm::dot(along, along);
    return square > 0.0F ? std::clamp(glm::dot(point - segment.start, along) / square, 0.0F, 1.0F) : 0.0F;
}

void roundOnRound(const CollisionGeometry& a, const CollisionGeometry& b, float margin, ContactList& out) {
    const float reach = a.radius + a.halfLength + b.radius + b.halfLength + margin;
    const vec3 offset = a.worldFromShape.translation - b.worldFromShape.translation;
    if (glm::dot(offset, offset) > reach * reach) return;
    const Segment coreA = coreOf(a);
    const Segment coreB = coreOf(b);
    const vec3 alongA = coreA.end - coreA.start;
    const vec3 alongB = coreB.end - coreB.start;
    const SegmentPair closest = closestBetweenSegments(coreA, coreB);
    // Side by side (within 30 degrees) they touch along a line: a contact at each end of it.
    const float product = glm::dot(alongA, alongB);
    if (product * product > 0.75F * glm::dot(alongA, alongA) * glm::dot(alongB, alongB) && product != 0.0F) {
        float low = nearestOn(coreA, product > 0.0F ? coreB.start : coreB.end);
        float high = nearestOn(coreA, product > 0.0F ? coreB.end : coreB.start);
        constexpr float kLine = 0.15F;  // of the length: shorter is a point
        if (high - low > kLine) {
            for (int end = 0; end < 2; ++end) {
                const vec3 onA = coreA.at(end == 0 ? low : high);
                roundPoints(a, b, onA, coreB.at(nearestOn(coreB, onA)), margin, end, out);
            }
            const float nearAnEnd = kSamePlace / (2.0F * a.halfLength);
            if (std::abs(closest.s - low) < nearAnEnd || std::abs(closest.s - high) < nearAnEnd) return;
        }
    }
    roundPoints(a, b, coreA.at(closest.s), coreB.at(closest.t), margin, 2, out);
}

void takeFromMesh(const MeshContactList& touches, const RigidTransform& worldFromMesh, float radius, ContactList& out) {
    for (int i = 0; i < touches.count; ++i) {
        const MeshContact& touch = touches.contacts[i];
        out.add({touch.feature, worldFromMesh * (touch.core - touch.gap * touch.normal),
                 worldFromMesh.rotation * touch.normal, touch.gap - radius});
    }
}

void roundOnMesh(const CollisionGeometry& round, const CollisionGeometry& mesh, float margin, ContactList& out) {
    const RigidTransform meshFromWorld = inverse(mesh.worldFromShape);
    const Segment world = coreOf(round);
    MeshContactList touches;
    touchMesh(*mesh.mesh, Segment{meshFromWorld * world.start, meshFromWorld * world.end}, round.radius + margin,
              touches);
    takeFromMesh(touches, mesh.worldFromShape, round.radius, out);
}

void solidOnMesh(const CollisionGeometry& solid, const CollisionGeometry& mesh, float margin, ContactList& out) {
    MeshContactList touches;
    touchMesh(*mesh.mesh, solid, inverse(mesh.worldFromShape) * solid.worldFromShape, margin, touches);
    takeFromMesh(touches, mesh.worldFromShape, 0.0F, out);
}

void flip(ContactList& list) {
    for (int i = 0; i < list.count; ++i) {
        SurfaceContact& contact = list.contacts[i];
        contact.position += contact.distance * contact.normal;
        contact.normal = -contact.normal;
    }
}

}  // namespace

ContactList findContacts(const CollisionGeometry& a, const CollisionGeometry& b, float margin) {
    ContactList out;
    // Capsule before box and hull before plane before mesh; the other order is the same pair seen from the other side.
    using Kind = ShapeKind;
    static_assert(Kind::capsule < Kind::box && Kind::box < Kind::hull && Kind::hull < Kind::plane &&
                  Kind::plane < Kind::mesh);
    if (a.kind > b.kind) {
        out = findContacts(b, a, margin);
        flip(out);
        return out;
    }
    const bool solidA = a.kind == Kind::box || a.kind == Kind::hull;
    const bool solidB = b.kind == Kind::box || b.kind == Kind::hull;
    if (a.kind == Kind::capsule && b.kind == Kind::capsule)
        roundOnRound(a, b, margin, out);
    else if (a.kind == Kind::capsule && solidB)
        roundOnSolid(a, b, margin, out);
    else if (a.kind == Kind::capsule && b.kind == Kind::plane)
        roundOnPlane(a, b, margin, out);
    else if (a.kind == Kind::capsule)
        roundOnMesh(a, b, margin, out);
    else if (solidA && b.kind == Kind::plane)
        cornersOnPlane(a, b, margin, out);
    else if (solidA && b.kind == Kind::mesh)
        solidOnMesh(a, b, margin, out);
    return out;
}

CollisionGeometry geometryOf(const PrimitiveShape& shape, const RigidTransform& worldFromShape) {
    CollisionGeometry geometry;
    geometry.worldFromShape = worldFromShape;
    if (shape.kind == PrimitiveShape::Kind::box) {
        geometry.kind = ShapeKind::box;
        geometry.halfExtents = shape.halfExtents;
        return geometry;
    }
    if (shape.kind == PrimitiveShape::Kind::hull) {
        geometry.kind = ShapeKind::hull;
        geometry.hull = shape.hull.get();
        return geometry;
    }
    geometry.radius = shape.radius;
    geometry.halfLength = shape.kind == PrimitiveShape::Kind::capsule ? shape.halfLength : 0.0F;
    return geometry;
}

CollisionGeometry geometryOf(const StaticShape& shape) {
    CollisionGeometry geometry;
    geometry.worldFromShape = shape.worldFromShape;
    geometry.halfExtents = shape.halfExtents;
    geometry.mesh = shape.mesh.get();
    if (shape.kind == ShapeKind::capsule || shape.kind == ShapeKind::sphere) {
        geometry.radius = shape.radius;
        geometry.halfLength = shape.kind == ShapeKind::capsule ? shape.halfLength : 0.0F;
    } else {
        geometry.kind = shape.kind;
    }
    return geometry;
}

}  // namespace lutka::physics
