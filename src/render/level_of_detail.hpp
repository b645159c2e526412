#pragma once

#include <cstdint>
#include <vector>

#include "animation/character.hpp"

namespace lutka::render {

/// Triangles of a coarser mesh over the same vertices: vertices that lie in one cube of side `cell` (metres, > 0, bind
/// pose) and follow the same joint most are drawn as the one of them nearest to their mean; what collapses is left out
/// (vertex clustering: Rossignac and Borrel 1993). No point of the surface moves by more than the cube's diagonal.
[[nodiscard]] std::vector<std::uint32_t> clusteredIndices(const animation::SkinnedMesh& mesh, float cell);

}  // namespace lutka::render
