#pragma once

#include <vector>

#include "physics/fit/body_plan.hpp"

namespace lutka::physics {

/// Finds separate pieces of mesh on the head's joint that reach beyond the skull: plaits, a top hat, horns, a beard.
/// The skull is the largest piece that begins at the head's joint and lies beyond it, with the pieces that lie on it
/// (eyes, a cap, the plates of a robot). Vertices of other pieces that are farther from it than a share of its size get
/// the owner `aside`; `owners` has one list a mesh, one body a vertex.
void hangPiecesOfHead(const BodyPlan& plan, const animation::Character& character, const mat3& standardFromModel,
                      int aside, std::vector<std::vector<int>>& owners);

}  // namespace lutka::physics
