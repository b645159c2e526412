#pragma once

#include <span>

#include "core/rigid_transform.hpp"
#include "physics/collision/static_shape.hpp"
#include "physics/profile/body_shape.hpp"

namespace lutka::physics {

/// Signed distance from the body's surface to the static shape's, metres; negative: the depth of the overlap. Of
/// several shapes the least.
[[nodiscard]] float distanceToStatic(const PrimitiveShape& shape, const RigidTransform& worldFromShape,
                                     const StaticShape& geometry);
[[nodiscard]] float distanceToStatic(const BodyShape& shape, const RigidTransform& worldFromBody,
                                     const StaticShape& geometry);

/// The height along the unit direction `up` of the lowest of the shapes' upper surfaces, metres: where potential energy
/// is measured from. 0 without shapes.
[[nodiscard]] float lowestSurface(std::span<const StaticShape> statics, const vec3& up);

}  // namespace lutka::physics
