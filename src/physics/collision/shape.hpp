#pragma once

#include "core/rigid_transform.hpp"
#include "physics/profile/body_shape.hpp"

namespace lutka::physics {

/// Volume of the shape, cubic metres. Of several shapes that of their union, by a grid of points, to 3 percent where
/// none is thinner than a 25th of the whole.
[[nodiscard]] float shapeVolume(const PrimitiveShape& shape);
[[nodiscard]] float shapeVolume(const BodyShape& shape);

/// Moments of inertia about the body's axes of the shape as a solid of uniform density, kg m².
/// Closed forms: sphere 2/5 m r²; box m (b² + c²) / 3 in half extents; capsule as a cylinder and two half spheres whose
/// centroids lie 3/8 r beyond the cap centres; hull by ConvexHull::meanSquare(). Of several shapes those of their union
/// about the body's origin, by a grid of points; what a tensor has off its diagonal is left out.
[[nodiscard]] vec3 shapeInertia(const PrimitiveShape& shape, float massKg);
[[nodiscard]] vec3 shapeInertia(const BodyShape& shape, float massKg);

/// Signed distance from a point in body space to the shape's surface, metres; negative inside. Of several shapes the
/// least; inside that is how deep the point lies in one of them.
[[nodiscard]] float signedDistance(const PrimitiveShape& shape, const vec3& bodyPoint);
[[nodiscard]] float signedDistance(const BodyShape& shape, const vec3& bodyPoint);

/// Signed distance between the surfaces of two placed shapes, metres; negative: the depth of the overlap.
/// Two boxes or hulls apart: a lower bound of the gap. Of several shapes the least of all pairs.
[[nodiscard]] float distanceBetween(const PrimitiveShape& a, const RigidTransform& worldFromA, const PrimitiveShape& b,
                                    const RigidTransform& worldFromB);
[[nodiscard]] float distanceBetween(const BodyShape& a, const RigidTransform& worldFromA, const BodyShape& b,
                                    const RigidTransform& worldFromB);

/// How far the shape reaches from the body's origin along a unit direction of body space, metres; a single shape but a
/// hull as far the other way.
[[nodiscard]] float supportExtent(const PrimitiveShape& shape, const vec3& bodyDirection);
[[nodiscard]] float supportExtent(const BodyShape& shape, const vec3& bodyDirection);

/// The farther of the two ways along a line of that direction: half the width of a slab about the origin that holds it.
[[nodiscard]] float halfWidth(const BodyShape& shape, const vec3& bodyDirection);

/// Half the least width of the shape, metres: of a hull across its faces.
[[nodiscard]] float thicknessOf(const PrimitiveShape& shape);

/// Half the sides of the box about the shape's origin, along its axes, that holds it, metres.
[[nodiscard]] vec3 halfBox(const PrimitiveShape& shape);

/// The hull of corners on the surface of a shape, at most ConvexHull::kMostPoints of them.
[[nodiscard]] ConvexHullPtr hullWithin(const PrimitiveShape& shape);

/// Half the sides of the box along a hull's axes that has its moments, metres.
[[nodiscard]] vec3 halfBoxOfMoments(const ConvexHull& hull);

/// The shape in place of a hull for engines without hulls: the box along the hull's axes that has its moments, or, for
/// a clearly rounder hull, a capsule along the longest axis, as long and as thick as the hull.
struct StandIn {
    PrimitiveShape shape;  ///< Capsule or box.
    RigidTransform hullFromShape;
};
[[nodiscard]] StandIn standInFor(const ConvexHull& hull);

/// Radius of the sphere about the body's origin that holds the shape, metres.
[[nodiscard]] float boundingRadius(const PrimitiveShape& shape);
[[nodiscard]] float boundingRadius(const BodyShape& shape);

}  // namespace lutka::physics
