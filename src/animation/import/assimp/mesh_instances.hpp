#pragma once

#include "animation/import/assimp/scene_nodes.hpp"

namespace lutka::animation::rig_import {

/// Adds all triangle meshes with their skins: skinned ones are instanced once, rigid ones once a node. Bones that are
/// no node of the scene are left out with a warning.
void addMeshes(const aiScene& scene, const SceneNodes& nodes, SourceScene& out);

}  // namespace lutka::animation::rig_import
