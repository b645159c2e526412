#pragma once

#include "animation/character.hpp"

namespace lutka::animation::rig_import {

/// Prepares a mesh for being skinned over and over, without a visible change: vertices with the same joints, and as
/// many of them, come one after the other (else they keep their order; triangles keep theirs), and coordinates below
/// 1e-12 become zero.
void orderForSkinning(SkinnedMesh& mesh);

}  // namespace lutka::animation::rig_import
