#include "physics/crowd/narrowphase.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "physics/collision/box_manifold.hpp"
#include "physics/collision/hull_distance.hpp"
#include "physics/collision/shape_distance.hpp"
#include "physics/collision/solid_manifold.hpp"

namespace lutka::physics::crowd {
namespace {

using Kind = PrimitiveShape::Kind;

constexpr float kFarApart = 1e6F;
constexpr int kFirstEdgeFeature = 8;       // after a box's corners
constexpr int kFirstManifoldFeature = 64;  // after its edges, and after a hull's corners

Segment coreOf(const PlacedShape& body) {
    const vec3 half = body.axes[1] * coreHalf(*body.shape);
    return {body.position - half, body.position + half};
}

// A point of the core against a static box, whose nearest feature becomes a half space. `feature`: which point it is.
void addHalfSpace(const vec3& local, float radius, const vec3& inBox, const SurfaceDistance& surface,
                  const PlacedStatic& box, int feature, StaticTouches& out) {
    const vec3 normal = box.axes * surface.normal;
    const float offset =
        glm::dot(surface.normal, inBox) - surface.distance + glm::dot(normal, box.shape.worldFromShape.translation);
    out.add({local, radius, normal, offset, surface.distance - radius, feature});
}

// Calls found(index, edge in the axes of its box, the same in those of `at`, where) for all edges of a box near
// another.
template <class Found>
void visitEdges(const BoxPlace& of, const BoxPlace& at, float range, Found found) {
    const mat3 inAt = glm::transpose(at.axes) * of.axes;
    const vec3 centre = (of.position - at.position) * at.axes;
    for (int i = 0; i < 12; ++i) {
        const Segment own = boxEdge(of.halfExtents, i);
        const Segment edge{centre + inAt * own.start, centre + inAt * own.end};
        const EdgeTouches touches = touchEdge(edge, at.halfExtents, range);
        for (int k = 0; k < touches.count; ++k)
            found(i, own, edge, touches.points[k]);
    }
}

BoxPlace placeOf(const PlacedShape& box) {
    return {box.shape->halfExtents, box.position, box.axes};
}
BoxPlace placeOf(const PlacedStatic& box) {
    return {box.shape.halfExtents, box.shape.worldFromShape.translation, box.axes};
}

SolidPlace solidOf(const PlacedShape& solid) {
    return {solid.shape->hull.get(), solid.shape->halfExtents, solid.position, solid.axes};
}
SolidPlace solidOf(const PlacedStatic& box) {
    return {nullptr, box.shape.halfExtents, box.shape.worldFromShape.translation, box.axes};
}

// The edges of a static box at a box: the body's point on its surface, which the edge's half space keeps out.
void touchStaticEdges(const PlacedShape& body, const PlacedStatic& box, float least, float range, StaticTouches& out) {
    const auto add = [&](int index, const Segment&, const Segment& edge, const CoreTouch& touch) {
        const SurfaceDistance& surface = touch.surface;
        const vec3 onEdge = edge.at(touch.along);
        const vec3 normal = -(body.axes * surface.normal);
        const float offset = glm::dot(normal, body.position + body.axes * onEdge);
        const vec3 onBody = onEdge - surface.normal * surface.distance;
        if (surface.distance > least && !saysTheSame(out, onBody, normal))
            out.add({onBody, 0.0F, normal, offset, surface.distance, kFirstEdgeFeature + 3 * index + touch.part});
    };
    visitEdges(placeOf(box), placeOf(body), range, add);
}

// Leaves of a segment what lies in an axis-aligned box; false: nothing.
bool cutToBox(Segment& segment, const vec3& low, const vec3& high) {
    float from = 0.0F;
    float to = 1.0F;
    const vec3 along = segment.end - segment.start;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(along[axis]) < 1e-9F) {
            if (segment.start[axis] < low[axis] || segment.start[axis] > high[axis]) return false;
            continue;
        }
        const float first = (low[axis] - segment.start[axis]) / along[axis];
        const float second = (high[axis] - segment.start[axis]) / along[axis];
        from = std::max(from, std::min(first, second));
        to = std::min(to, std::max(first, second));
    }
    if (from > to) return false;
    segment = {segment.at(from), segment.at(to)};
    return true;
}

// The corners of a hull near a static box, and the box's edges near the hull, as far as they do not overlap: what must
// not come in next.
void foreseeHull(const PlacedShape& body, const PlacedStatic& box, float range, StaticTouches& out) {
    constexpr int kFirstEdge = ConvexHull::kMostPoints;  // after the hull's corners
    constexpr int kHalvings = 8;                         // of what is about as long as the hull
    const ConvexHull& hull = *body.shape->hull;
    const vec3& centre = box.shape.worldFromShape.translation;
    const vec3 inBox = (body.position - centre) * box.axes;
    const mat3 boxFromBody = glm::transpose(box.axes) * body.axes;
    for (int i = 0; i < static_cast<int>(hull.points().size()); ++i) {
        const vec3& local = hull.points()[i];
        const vec3 corner = inBox + boxFromBody * local;
        const SurfaceDistance surface = distanceToBox(corner, box.shape.halfExtents);
        if (surface.distance <= 0.0F || surface.distance >= range) continue;
        if (!saysTheSame(out, local, box.axes * surface.normal))
            addHalfSpace(local, 0.0F, corner, surface, box, i, out);
    }
    const mat3 bodyFromBox = glm::transpose(boxFromBody);
    const vec3 inBody = (centre - body.position) * body.axes;
    for (int i = 0; i < 12; ++i) {
        const Segment own = boxEdge(box.shape.halfExtents, i);
        Segment edge{inBody + bodyFromBox * own.start, inBody + bodyFromBox * own.end};
        if (!cutToBox(edge, hull.low() - range, hull.high() + range)) continue;
        const vec3 onEdge = edge.at(deepestOnSegment(edge, hull, kHalvings));
        const SurfaceDistance surface = distanceToHull(onEdge, hull);
        if (surface.distance <= 0.0F || surface.distance >= range) continue;
        const vec3 normal = -(body.axes * surface.normal);
        const vec3 onBody = onEdge - surface.normal * surface.distance;
        if (saysTheSame(out, onBody, normal)) continue;
        const float offset = glm::dot(normal, body.position + body.axes * onEdge);
        out.add({onBody, 0.0F, normal, offset, surface.distance, kFirstEdge + i});
    }
}

// Whether the box around the hull's corners, along the axes of a static box, comes within `range` of it.
bool mayReachBox(const PlacedShape& body, const PlacedStatic& box, float range) {
    const vec3 centre = (body.position - box.shape.worldFromShape.translation) * box.axes;
    const mat3 boxFromBody = glm::transpose(box.axes) * body.axes;
    const vec3 most = box.shape.halfExtents + range;
    vec3 low(kFarApart);
    vec3 high(-kFarApart);
    for (const vec3& corner : body.shape->hull->points()) {
        const vec3 inBox = centre + boxFromBody * corner;
        low = glm::min(low, inBox);
        high = glm::max(high, inBox);
    }
    return glm::all(glm::lessThan(low, most)) && glm::all(glm::greaterThan(high, -most));
}

void touchStaticBoxWithHull(const PlacedShape& body, const PlacedStatic& box, float range, StaticTouches& out) {
    if (!mayReachBox(body, box, range)) return;
    out.capacity = ContactList::kMax;
    const SolidManifold manifold = touchSolids(solidOf(body), solidOf(box), range, SolidManifold::kMost);
    for (int i = 0; i < manifold.count; ++i) {
        const auto& [onBody, onBox, distance, feature] = manifold.points[i];
        const vec3 inWorld = box.shape.worldFromShape.translation + box.axes * onBox;
        out.add({onBody, 0.0F, manifold.normal, glm::dot(manifold.normal, inWorld), distance,
                 kFirstManifoldFeature + feature});
    }
    if (manifold.count > 0) foreseeHull(body, box, range, out);
}

void touchStaticBox(const PlacedShape& body, const PlacedStatic& box, float range, StaticTouches& out) {
    if (body.shape->kind == Kind::hull) {
        touchStaticBoxWithHull(body, box, range, out);
        return;
    }
    const vec3& halfExtents = box.shape.halfExtents;
    const vec3 centre = (body.position - box.shape.worldFromShape.translation) * box.axes;
    const mat3 boxFromBody = glm::transpose(box.axes) * body.axes;
    if (body.shape->kind == Kind::box) {
        const CorePoints points = corePoints(*body.shape);
        out.capacity = ContactList::kMax;
        const BoxManifold manifold = touchBoxes(placeOf(body), placeOf(box), range);
        for (int i = 0; i < manifold.count; ++i) {
            const auto& [onBody, onBox, distance, feature] = manifold.points[i];
            const vec3 inWorld = box.shape.worldFromShape.translation + box.axes * onBox;
            out.add({onBody, 0.0F, manifold.normal, glm::dot(manifold.normal, inWorld), distance,
                     kFirstManifoldFeature + feature});
        }
        // What is still apart, but nearer than what overlaps is to its ends, must not come in next.
        const float least = manifold.count > 0 ? 0.0F : -kFarApart;
        for (int i = 0; i < points.count; ++i) {
            const vec3 inBox = centre + boxFromBody * points.local[i];
            const SurfaceDistance surface = distanceToBox(inBox, halfExtents);
            if (surface.distance > least && surface.distance < range)
                addHalfSpace(points.local[i], 0.0F, inBox, surface, box, i, out);
        }
        touchStaticEdges(body, box, least, range, out);
        return;
    }
    const vec3 last(0, coreHalf(*body.shape), 0);
    const vec3 first = -last;
    const float radius = body.shape->radius;
    const Segment core{centre + boxFromBody * first, centre + boxFromBody * last};
    const CoreTouches touches = touchBox(core, halfExtents, radius + range);
    for (int i = 0; i < touches.count; ++i) {
        const auto& [along, surface, part] = touches.points[i];
        const vec3 inBox = part == 1 ? core.end : core.at(along);
        addHalfSpace(first + along * (last - first), radius, inBox, surface, box, part, out);
    }
}

// The corners of a box or hull on a large sphere or capsule, beside the one point that is nearest.
void touchCornersOnRound(const PlacedShape& body, const CollisionGeometry& round, float range, StaticTouches& out) {
    const RigidTransform shapeFromWorld = inverse(round.worldFromShape);
    const CorePoints corners = corePoints(*body.shape);
    for (int i = 0; i < corners.count; ++i) {
        const vec3& local = corners.local[i];
        const vec3 point = shapeFromWorld * (body.position + body.axes * local);
        const vec3 away = point - vec3(0, std::clamp(point.y, -round.halfLength, round.halfLength), 0);
        const float gap = glm::length(away);
        if (gap - round.radius >= range || gap < 1e-6F) continue;
        const vec3 normal = round.worldFromShape.rotation * (away / gap);
        const float separation = gap - round.radius;
        const float offset = glm::dot(normal, body.position + body.axes * local) - separation;
        out.add({local, 0.0F, normal, offset, separation, 1 + i});
    }
}

// Spheres, capsules and meshes: the contact's surface as a half space for the step.
void touchOther(const PlacedShape& body, const PlacedStatic& geometry, float range, StaticTouches& out) {
    out.capacity = ContactList::kMax;
    const RigidTransform worldFromBody{glm::normalize(glm::quat_cast(body.axes)), body.position};
    const ContactList found = findContacts(geometryOf(*body.shape, worldFromBody), geometry.geometry, range);
    const float radius = body.shape->isAngular() ? 0.0F : body.shape->radius;
    for (int i = 0; i < found.count; ++i) {
        const SurfaceContact& contact = found.contacts[i];
        const vec3 core = contact.position + (contact.distance + radius) * contact.normal;
        out.add({(core - body.position) * body.axes, radius, contact.normal, glm::dot(contact.normal, contact.position),
                 contact.distance, contact.feature});
    }
    if (body.shape->isAngular() && geometry.geometry.kind == ShapeKind::capsule)
        touchCornersOnRound(body, geometry.geometry, range, out);
}

void touchCores(const PlacedShape& a, const PlacedShape& b, float range, Touches<BodyTouch>& out) {
    const Segment coreA = coreOf(a);
    const Segment coreB = coreOf(b);
    const SegmentPair at = closestBetweenSegments(coreA, coreB);
    const vec3 between = coreA.at(at.s) - coreB.at(at.t);
    const float radius = a.shape->radius + b.shape->radius;
    const float distance2 = glm::dot(between, between);
    if (distance2 > (radius + range) * (radius + range)) return;
    out.add({{0, (2 * at.s - 1) * coreHalf(*a.shape), 0},
             {0, (2 * at.t - 1) * coreHalf(*b.shape), 0},
             radius,
             directionBetween(between, a.axes[1], b.axes[1]),
             std::sqrt(distance2) - radius});
}

// A capsule or sphere A against a box or hull B.
void touchCoreAndSolid(const PlacedShape& a, const PlacedShape& box, float range, bool swapped,
                       Touches<BodyTouch>& out) {
    const vec3 centre = (a.position - box.position) * box.axes;
    const vec3 half = glm::transpose(box.axes) * a.axes[1] * coreHalf(*a.shape);
    const Segment core{centre - half, centre + half};
    const float radius = a.shape->radius;
    const CoreTouches touches = box.shape->kind == Kind::hull ? touchHull(core, *box.shape->hull, radius + range)
                                                              : touchBox(core, box.shape->halfExtents, radius + range);
    for (int i = 0; i < touches.count; ++i) {
        const auto& [along, surface, part] = touches.points[i];
        const vec3 onCore(0, (2 * along - 1) * coreHalf(*a.shape), 0);
        const vec3 onBox = core.at(along) - surface.normal * surface.distance;
        const vec3 normal = box.axes * surface.normal;
        const float separation = surface.distance - radius;
        if (swapped)
            out.add({onBox, onCore, radius, -normal, separation});
        else
            out.add({onCore, onBox, radius, normal, separation});
    }
}

// The corners of A in B.
void touchCorners(const PlacedShape& a, const PlacedShape& b, float range, bool swapped, Touches<BodyTouch>& out) {
    for (int i = 0; i < 8; ++i) {
        const vec3 local = boxCorner(a.shape->halfExtents, i);
        const vec3 inB = (a.position + a.axes * local - b.position) * b.axes;
        const SurfaceDistance surface = distanceToBox(inB, b.shape->halfExtents);
        if (surface.distance >= range) continue;
        const vec3 onB = inB - surface.normal * surface.distance;
        const vec3 normal = b.axes * surface.normal;
        if (swapped)
            out.add({onB, local, 0.0F, -normal, surface.distance});
        else
            out.add({local, onB, 0.0F, normal, surface.distance});
    }
}

// The edges of A in B.
void touchEdges(const PlacedShape& a, const PlacedShape& b, float range, bool swapped, Touches<BodyTouch>& out) {
    const auto add = [&](int, const Segment& own, const Segment& edge, const CoreTouch& touch) {
        const SurfaceDistance& surface = touch.surface;
        const vec3 onB = edge.at(touch.along) - surface.normal * surface.distance;
        const vec3 normal = b.axes * surface.normal;
        if (swapped)
            out.add({onB, own.at(touch.along), 0.0F, -normal, surface.distance});
        else
            out.add({own.at(touch.along), onB, 0.0F, normal, surface.distance});
    };
    visitEdges(placeOf(a), placeOf(b), range, add);
}

}  // namespace

float coreHalf(const PrimitiveShape& shape) {
    return shape.kind == Kind::capsule ? shape.halfLength : 0.0F;
}

vec3 halfBounds(const PlacedShape& placed) {
    const PrimitiveShape& shape = *placed.shape;
    if (!shape.isAngular()) return glm::abs(placed.axes[1]) * coreHalf(shape) + shape.radius;
    const vec3 half = shape.kind == Kind::hull ? shape.hull->halfBounds() : shape.halfExtents;
    return glm::abs(placed.axes[0]) * half.x + glm::abs(placed.axes[1]) * half.y + glm::abs(placed.axes[2]) * half.z;
}

CorePoints corePoints(const PrimitiveShape& shape) {
    CorePoints points;
    if (shape.kind == Kind::box) {
        points.count = 8;
        for (int i = 0; i < 8; ++i)
            points.local[i] = boxCorner(shape.halfExtents, i);
        return points;
    }
    if (shape.kind == Kind::hull) {
        points.count = static_cast<int>(shape.hull->points().size());
        std::copy(shape.hull->points().begin(), shape.hull->points().end(), points.local.begin());
        return points;
    }
    points.radius = shape.radius;
    points.count = coreHalf(shape) > 0.0F ? 2 : 1;
    points.local[0] = {0, -coreHalf(shape), 0};
    points.local[1] = {0, coreHalf(shape), 0};
    return points;
}

PlacedStatic::PlacedStatic(const StaticShape& given)
    : shape(given), geometry(geometryOf(given)), axes(glm::mat3_cast(given.worldFromShape.rotation)) {
    vec3 centre = shape.worldFromShape.translation;
    vec3 half(shape.radius);
    if (shape.kind == StaticShape::Kind::capsule) half += glm::abs(axes[1]) * shape.halfLength;
    if (shape.kind == StaticShape::Kind::box || shape.kind == StaticShape::Kind::mesh) {
        vec3 inShape = shape.halfExtents;
        if (shape.kind == StaticShape::Kind::mesh) {
            inShape = 0.5F * (shape.mesh->high() - shape.mesh->low());
            centre = shape.worldFromShape * (0.5F * (shape.mesh->high() + shape.mesh->low()));
        }
        half = glm::abs(axes[0]) * inShape.x + glm::abs(axes[1]) * inShape.y + glm::abs(axes[2]) * inShape.z;
    }
    low = centre - half;
    high = centre + half;
}

bool saysTheSame(const StaticTouches& found, const vec3& local, const vec3& normal) {
    for (int i = 0; i < found.count; ++i) {
        const StaticTouch& other = found.points[i];
        if (glm::distance(other.local, local) < kSamePlace && glm::dot(other.normal, normal) > 0.99F) return true;
    }
    return false;
}

StaticTouches touchStatic(const PlacedShape& body, const PlacedStatic& geometry, float range) {
    StaticTouches touches;
    if (geometry.shape.kind == StaticShape::Kind::box)
        touchStaticBox(body, geometry, range, touches);
    else
        touchOther(body, geometry, range, touches);
    return touches;
}

Touches<BodyTouch> touchBodies(const PlacedShape& a, const PlacedShape& b, float range) {
    Touches<BodyTouch> touches;
    const bool solidA = a.shape->isAngular();
    const bool solidB = b.shape->isAngular();
    if (!solidA && !solidB) {
        touchCores(a, b, range, touches);
    } else if (solidA && solidB && (a.shape->kind == Kind::hull || b.shape->kind == Kind::hull)) {
        const SolidManifold manifold = touchSolids(solidOf(a), solidOf(b), range, touches.capacity);
        for (int i = 0; i < manifold.count; ++i) {
            const auto& [onA, onB, distance, feature] = manifold.points[i];
            touches.add({onA, onB, 0.0F, manifold.normal, distance});
        }
    } else if (solidA && solidB) {
        const BoxManifold manifold = touchBoxes(placeOf(a), placeOf(b), range);
        for (int i = 0; i < manifold.count; ++i) {
            const auto& [onA, onB, distance, feature] = manifold.points[i];
            touches.add({onA, onB, 0.0F, manifold.normal, distance});
        }
        if (manifold.count > 0) return touches;
        touchCorners(a, b, range, false, touches);
        touchCorners(b, a, range, true, touches);
        touchEdges(a, b, range, false, touches);
        touchEdges(b, a, range, true, touches);
    } else if (solidB) {
        touchCoreAndSolid(a, b, range, false, touches);
    } else {
        touchCoreAndSolid(b, a, range, true, touches);
    }
    return touches;
}

}  // namespace lutka::physics::crowd
