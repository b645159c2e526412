#pragma once

#include <optional>
#include <string>
#include <vector>

#include "animation/import/node_tree.hpp"
#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import {

/// A joint that a mesh is skinned to.
struct SkinJoint {
    int joint = -1;
    dmat4 jointFromMesh;
    double weight = 0.0;  ///< Sum of the weights.
};

/// A mesh where it hangs in the scene.
struct MeshInstance {
    const SourceMesh* mesh = nullptr;
    int node = -1;
    std::vector<SkinJoint> joints;  ///< Empty for a mesh without a (usable) skin: it is carried rigidly by its node.
    std::vector<int> jointOfSlot;   ///< One a slot of the skin; -1 for those that are left out.
    std::optional<dmat4> sceneFromMesh;  ///< See SourceSkin, and for the next.
    bool verticesAreInJoints = false;
};

/// All instances of the scene. Joints without weights are left out; those with an unusable bind matrix too, with a
/// warning.
[[nodiscard]] std::vector<MeshInstance> bindMeshes(const SourceScene& scene, const NodeTree& tree,
                                                   std::vector<std::string>& warnings);

}  // namespace lutka::animation::rig_import
