#pragma once

#include <span>
#include <string>
#include <vector>

#include "animation/import/affine.hpp"
#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import {

/// The scene's nodes, parents before children, and which of them are joints. Index for index those of SourceScene:
/// helpers are kept, so that any pose (the nodes' own, or a clip's) is evaluated as the file means it, but are no
/// joints.
struct NodeTree {
    struct Node {
        int parent = -1;       ///< Index of the parent node; -1 for a root.
        int joint = -1;        ///< The node's joint; for a helper the nearest joint above it, else its first below.
        dmat4 parentFromNode;  ///< The nodes' own pose.
        dmat4 sceneFromNode;
    };

    std::vector<Node> nodes;
    std::vector<int> nodeOfJoint;
    std::vector<std::string> jointNames;
    std::vector<int> jointParents;
    bool nodesArePosed = true;  ///< See SourceScene::nodesArePosed.

    [[nodiscard]] int jointCount() const { return static_cast<int>(nodeOfJoint.size()); }
    [[nodiscard]] const dmat4& sceneFromJoint(int joint) const { return nodes[nodeOfJoint[joint]].sceneFromNode; }
    [[nodiscard]] bool isHelper(int node) const { return nodeOfJoint[nodes[node].joint] != node; }
};

/// The tree of a scene that validate() accepts.
[[nodiscard]] NodeTree makeNodeTree(const SourceScene& scene);

/// Scene-space frames of all nodes in a pose; both spans hold one element a node.
void evaluatePose(const NodeTree& tree, std::span<const dmat4> parentFromNode, std::span<dmat4> sceneFromNode);

}  // namespace lutka::animation::rig_import
