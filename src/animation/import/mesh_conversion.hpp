#pragma once

#include <span>
#include <string>
#include <vector>

#include "animation/character.hpp"
#include "animation/import/skin_binding.hpp"

namespace lutka::animation::rig_import {

/// The meshes in the bind pose, in scene space (units and axes not yet settled), with their skin weights; adds the
/// weights to `skinWeight` (one element a joint). Warns of what was repaired or dropped.
[[nodiscard]] std::vector<SkinnedMesh> convertMeshes(const NodeTree& tree, std::span<const MeshInstance> instances,
                                                     std::span<const dmat4> bindSceneFromJoint,
                                                     std::span<float> skinWeight, std::vector<std::string>& warnings);

}  // namespace lutka::animation::rig_import
