#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "animation/import/fbx/node_transform.hpp"
#include "animation/import/fbx/objects.hpp"
#include "core/result.hpp"

namespace lutka::animation::rig_import::fbx {

/// The document's models as a tree, parents before children, depth first in the order of their connections. Node 0 is
/// the scene's root, "RootNode". One element a node in each vector.
struct ModelTree {
    std::vector<std::string> names;
    std::vector<int> parents;
    std::vector<NodeTransform> transforms;
    /// The origin of the scene's node in the file's node. For a rigid mesh it is the pivot that the mesh turns about:
    /// Maya's meshes with frozen transforms have their joint there. For all others it is 0.
    std::vector<dvec3> origins;
    std::map<int, int> nodeOfModel;            ///< Object index → node.
    std::vector<std::pair<int, int>> inOrder;  ///< Object index and node, in the order of the nodes.
};

/// The parent-relative frames of the scene's nodes where the tree's have these transforms: as evaluateNodes(), from
/// origin to origin. One element a node in both spans.
void evaluateTree(const ModelTree& tree, std::span<const NodeTransform> transforms, std::span<dmat4> parentFromNode);

/// The effectors of control rigs, which MotionBuilder saves along, are left out, with children that are effectors, too.
/// Models without a parent, or in a ring of parents, are children of the root. Fails
/// beyond 65,535 nodes and where they are nested deeper than 4,096.
[[nodiscard]] Result<ModelTree> readModelTree(const Objects& objects, const std::string& location);

}  // namespace lutka::animation::rig_import::fbx
