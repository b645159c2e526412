#pragma once

#include <vector>

#include "physics/fit/body_plan.hpp"

namespace lutka::physics {

/// The body that each vertex of a mesh belongs to: that with the largest sum of its weights.
[[nodiscard]] std::vector<int> bodiesOfVertices(const animation::SkinnedMesh& mesh,
                                                const std::vector<int>& bodyOfJoint);

/// The same with the trunk's vertices as balanceTrunk() split them.
[[nodiscard]] std::vector<int> ownersOfVertices(const BodyPlan& plan, const animation::SkinnedMesh& mesh,
                                                const mat3& standardFromModel);

/// Fills the skin of the plan's bodies: the vertices, and for coarse meshes (below 5000 vertices in all) points on the
/// triangles instead, so that a box of eight vertices has a surface. Returns
/// the skin of the joints in `hanging` (one a joint) and of pieces that hang on the head (hangPiecesOfHead()), which
/// goes to no body: see settleHeadSkin(). That of the joints in `held` is no body's either: see jointsOfHeldWeapons().
[[nodiscard]] std::vector<SkinPoint> gatherSkin(BodyPlan& plan, const animation::Character& character,
                                                const quat& standardFromModel, const std::vector<bool>& hanging,
                                                const std::vector<bool>& held);

/// Splits the trunk's skin anew by height where a rig leaves a trunk body less than a tenth of it (a root joint at the
/// hips that moves next to nothing): the hips get what lies below 0.22 of the way from hip joints to shoulders, the
/// others equal parts above.
void balanceTrunk(BodyPlan& plan);

}  // namespace lutka::physics
