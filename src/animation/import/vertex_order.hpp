#pragma once

#include <cstdint>
#include <span>

#include "animation/character.hpp"

namespace lutka::animation::rig_import {

/// Makes vertex i of the mesh what vertex from[i] was, in every array; the indices are left to the caller.
void takeVertices(SkinnedMesh& mesh, std::span<const std::uint32_t> from);

/// Prepares a mesh for being skinned over and over, without a visible change: vertices with the same joints, and as
/// many of them, come one after the other (else they keep their order; triangles keep theirs), and coordinates below
/// 1e-12 become zero.
void orderForSkinning(SkinnedMesh& mesh);

}  // namespace lutka::animation::rig_import
