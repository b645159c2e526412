#pragma once

#include <span>
#include <vector>

#include "animation/import/fbx/model_tree.hpp"
#include "animation/import/fbx/motion.hpp"

namespace lutka::animation::rig_import::fbx {

/// Which scene nodes stand for a tree's nodes.
///
/// A node that leaves out its parent's scale (Inherit::withoutScale), where that scale differs along the axes or
/// moves, could not be given by translation, rotation and scale under its parent. Such a node gets a helper above it,
/// which stands where the node does and takes the parent's scale out.
struct SceneLayout {
    std::vector<int> sceneNode;  ///< Tree node → scene node.
    std::vector<int> helper;     ///< Tree node → the helper above it; -1 for none.
};

[[nodiscard]] SceneLayout layoutOf(const ModelTree& tree, std::span<const Motion> motions);

/// Where the helper above a node stands.
[[nodiscard]] dmat4 parentFromHelper(const dmat4& parentFromNode, const NodeTransform& parent);

}  // namespace lutka::animation::rig_import::fbx
