#pragma once

#include <optional>

#include "physics/fit/body_plan.hpp"
#include "physics/fit/limits.hpp"

namespace lutka::physics {

/// The convex hull of a body's skin in place of `shape`, centred on its volume along its principal axes, those nearest
/// to the shape's. It has the corners of the skin's hull that lie farthest out, at most ConvexHull::kMostPoints of them
/// and none that adds less than 0.2 % of the figure's height. Nothing where the body has next to no skin, or it is
/// flat.
[[nodiscard]] std::optional<PlacedShape> fitHull(const BodyPlan& plan, const PlannedBody& body,
                                                 const PlacedShape& shape);

/// fitHull() for all bodies that PlannedBody::asHull asks it for. On a symmetric figure the right ones are mirror
/// images of the left.
void takeHulls(const BodyPlan& plan, std::vector<PlacedShape>& shapes);

}  // namespace lutka::physics
