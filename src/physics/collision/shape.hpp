#pragma once

#include "core/rigid_transform.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// Volume of the shape, cubic metres.
[[nodiscard]] float shapeVolume(const BodyShape& shape);

/// Principal moments of inertia about the body's axes of the shape as a solid of uniform density, kg m².
/// Closed forms: sphere 2/5 m r²; box m (b² + c²) / 3 in half extents; capsule as a cylinder and two half spheres whose
/// centroids lie 3/8 r beyond the cap centres.
[[nodiscard]] vec3 shapeInertia(const BodyShape& shape, float massKg);

/// Signed distance from a point in body space to the shape's surface, metres; negative inside.
[[nodiscard]] float signedDistance(const BodyShape& shape, const vec3& bodyPoint);

/// Signed distance between the surfaces of two placed shapes, metres; negative: the depth of the overlap.
/// Two boxes apart: a lower bound of the gap.
[[nodiscard]] float distanceBetween(const BodyShape& a, const RigidTransform& worldFromA, const BodyShape& b,
                                    const RigidTransform& worldFromB);

/// Half the extent of the shape along a unit direction of body space, metres.
[[nodiscard]] float supportExtent(const BodyShape& shape, const vec3& bodyDirection);

/// Radius of the sphere about the body's origin that holds the shape, metres.
[[nodiscard]] float boundingRadius(const BodyShape& shape);

}  // namespace lutka::physics
