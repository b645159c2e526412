#pragma once

#include <assimp/scene.h>

#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "animation/import/affine.hpp"
#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// What Assimp puts between a node's name and the kind of helper.
inline constexpr const char* kPivotMark = "_$AssimpFbx$_";

/// The scene's nodes, depth first, parents before children, and which of them are joints.
///
/// Assimp splits an FBX node with pivots into a chain of helpers named `X_$AssimpFbx$_Rotation` … that ends in `X`. All
/// of them are kept here, so that any pose (the nodes' own, or a clip's, whose channels name the helpers) is evaluated
/// as the file means it; only `X` is a joint.
struct NodeTree {
    struct Node {
        const aiNode* source = nullptr;
        int parent = -1;       ///< Index of the parent node; -1 for the root.
        int joint = -1;        ///< The node's joint; for a helper the nearest joint above it, else its first below.
        dmat4 parentFromNode;  ///< The nodes' own pose.
        dmat4 sceneFromNode;
    };

    std::vector<Node> nodes;
    std::vector<int> nodeOfJoint;
    std::vector<std::string> jointNames;
    std::vector<int> jointParents;
    std::unordered_multimap<std::string, int> nodesByName;
    bool nodesArePosed = true;  ///< False when Assimp lost the hierarchy: then only the skins' matrices mean anything.

    [[nodiscard]] int jointCount() const { return static_cast<int>(nodeOfJoint.size()); }
    [[nodiscard]] const dmat4& sceneFromJoint(int joint) const { return nodes[nodeOfJoint[joint]].sceneFromNode; }
    [[nodiscard]] bool isHelper(int node) const { return nodeOfJoint[nodes[node].joint] != node; }
    /// Every node of that name, in file order.
    [[nodiscard]] std::vector<int> named(const std::string& name) const;
};

/// Fails when there are more joints than a vertex can name (65,535) or the tree is deeper than 4,096.
[[nodiscard]] Result<NodeTree> readNodeTree(const aiScene& scene, const std::string& location);

/// Scene-space frames of all nodes in a pose; both spans hold one element a node.
void evaluatePose(const NodeTree& tree, std::span<const dmat4> parentFromNode, std::span<dmat4> sceneFromNode);

}  // namespace lutka::animation::rig_import
