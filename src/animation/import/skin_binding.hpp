#pragma once

#include <assimp/scene.h>

#include <string>
#include <vector>

#include "animation/import/node_tree.hpp"

namespace lutka::animation::rig_import {

/// A joint that a mesh is skinned to.
struct SkinJoint {
    int joint = -1;
    dmat4 jointFromMesh;             ///< Assimp's offset matrix.
    const aiBone* source = nullptr;  ///< Its weights.
    double weight = 0.0;             ///< Sum of the weights.
};

/// A mesh where it hangs in the scene.
struct MeshInstance {
    const aiMesh* mesh = nullptr;
    int node = -1;
    std::vector<SkinJoint> joints;  ///< Empty for a mesh without a (usable) skin: it is carried rigidly by its node.
};

/// All triangle meshes of the scene: skinned ones once, rigid ones once a node. Joints without weights are left out;
/// those with an unusable offset matrix too, with a warning.
[[nodiscard]] std::vector<MeshInstance> bindMeshes(const aiScene& scene, const NodeTree& tree,
                                                   std::vector<std::string>& warnings);

}  // namespace lutka::animation::rig_import
