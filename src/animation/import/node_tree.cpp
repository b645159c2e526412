#include "animation/import/node_tree.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/assert.hpp"

namespace lutka::animation::rig_import {
namespace {

constexpr std::size_t kMaxJoints = 65535;
constexpr int kMaxDepth = 4096;

bool isPivotHelper(const aiNode& node) {
    return std::string_view(node.mName.C_Str()).find(kPivotMark) != std::string_view::npos;
}

// A transform that is not finite would spoil everything below it.
dmat4 usableTransform(const aiNode& node) {
    dmat4 matrix = fromAssimp(node.mTransformation);
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(matrix[column][row])) return dmat4(1.0);
        }
    }
    return matrix;
}

void addNode(NodeTree& tree, const aiNode& source, int parent) {
    const int index = static_cast<int>(tree.nodes.size());
    NodeTree::Node node;
    node.source = &source;
    node.parent = parent;
    node.parentFromNode = usableTransform(source);
    node.sceneFromNode = parent < 0 ? node.parentFromNode : tree.nodes[parent].sceneFromNode * node.parentFromNode;
    node.joint = parent < 0 ? -1 : tree.nodes[parent].joint;
    if (!isPivotHelper(source)) {
        tree.jointParents.push_back(node.joint);
        node.joint = tree.jointCount();
        tree.nodeOfJoint.push_back(index);
        tree.jointNames.emplace_back(source.mName.C_Str());
    }
    tree.nodesByName.emplace(source.mName.C_Str(), index);
    tree.nodes.push_back(node);
}

// Helpers above the first joint of the scene belong to that joint.
void settleLeadingHelpers(NodeTree& tree) {
    for (NodeTree::Node& node : tree.nodes)
        node.joint = std::max(node.joint, 0);
}

}  // namespace

std::vector<int> NodeTree::named(const std::string& name) const {
    const auto [first, last] = nodesByName.equal_range(name);
    std::vector<int> found;
    for (auto at = first; at != last; ++at)
        found.push_back(at->second);
    std::sort(found.begin(), found.end());
    return found;
}

Result<NodeTree> readNodeTree(const aiScene& scene, const std::string& location) {
    struct Pending {
        const aiNode* node;
        int parent;
        int depth;
    };
    NodeTree tree;
    std::vector<Pending> pending = {{scene.mRootNode, -1, 0}};
    while (!pending.empty()) {
        const Pending next = pending.back();
        pending.pop_back();
        if (tree.nodeOfJoint.size() >= kMaxJoints || next.depth > kMaxDepth) {
            return Error{ErrorCode::input,
                         fmt::format("more than {} nodes, or nodes nested deeper than {}", kMaxJoints, kMaxDepth),
                         location, "export the character without the rest of the scene"};
        }
        addNode(tree, *next.node, next.parent);
        const int index = static_cast<int>(tree.nodes.size()) - 1;
        for (unsigned child = next.node->mNumChildren; child-- > 0;) {
            if (next.node->mChildren[child] != nullptr) {
                pending.push_back({next.node->mChildren[child], index, next.depth + 1});
            }
        }
    }
    settleLeadingHelpers(tree);
    if (tree.jointCount() == 0) return Error{ErrorCode::input, "the scene has no nodes", location, ""};
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
