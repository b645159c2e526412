#include "animation/import/node_tree.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/assert.hpp"

namespace lutka::animation::rig_import {
namespace {

// Helpers above the first joint of the scene belong to that joint.
void settleLeadingHelpers(NodeTree& tree) {
    for (NodeTree::Node& node : tree.nodes)
        node.joint = std::max(node.joint, 0);
}

}  // namespace

NodeTree makeNodeTree(const SourceScene& scene) {
    NodeTree tree;
    tree.nodesArePosed = scene.nodesArePosed;
    tree.nodes.reserve(scene.nodes.size());
    for (const SourceNode& source : scene.nodes) {
        const int index = static_cast<int>(tree.nodes.size());
        const NodeTree::Node* parent = source.parent < 0 ? nullptr : &tree.nodes[source.parent];
        NodeTree::Node node;
        node.parent = source.parent;
        node.parentFromNode = source.parentFromNode;
        node.sceneFromNode = parent == nullptr ? node.parentFromNode : parent->sceneFromNode * node.parentFromNode;
        node.joint = parent == nullptr ? -1 : parent->joint;
        if (!source.isHelper) {
            tree.jointParents.push_back(node.joint);
            node.joint = tree.jointCount();
            tree.nodeOfJoint.push_back(index);
            // A joint's path is made of names: an empty one would be no path at the root.
            tree.jointNames.push_back(source.name.empty() ? fmt::format("nodes[{}]", index) : source.name);
        }
        tree.nodes.push_back(node);
    }
    settleLeadingHelpers(tree);
    return tree;
}

void evaluatePose(const NodeTree& tree, std::span<const dmat4> parentFromNode, std::span<dmat4> sceneFromNode) {
    LUTKA_ASSERT(parentFromNode.size() == tree.nodes.size() && sceneFromNode.size() == tree.nodes.size());
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        const int parent = tree.nodes[i].parent;
        sceneFromNode[i] = parent < 0 ? parentFromNode[i] : sceneFromNode[parent] * parentFromNode[i];
    }
}

}  // namespace lutka::animation::rig_import
