#pragma once

#include <utility>
#include <vector>

#include "physics/fit/body_plan.hpp"
#include "physics/fit/limits.hpp"

namespace lutka::physics {

/// Shrinks the radii of shapes that overlap in the bind pose without being linked, mirror images alike, until they are
/// apart; pairs that a quarter off both radii does not part are left to the collision filter. Bodies at the ends of one
/// constraint overlap as they like.
void separateShapes(const BodyPlan& plan, std::vector<PlacedShape>& shapes);

/// The pairs of bodies that shall not collide, beside the linked ones. They overlap in the bind pose, or one body lies
/// between them and they overlap in at least half of the poses that its two joints take (neutral and both limits of
/// each axis). Sorted, first < second.
[[nodiscard]] std::vector<std::pair<int, int>> pairsToFilter(const RagdollProfile& profile,
                                                             const std::vector<RigidTransform>& modelFromBody);

/// The parent of each body by the constraints; -1 for the first.
[[nodiscard]] std::vector<int> parentsOfBodies(const RagdollProfile& profile);

}  // namespace lutka::physics
