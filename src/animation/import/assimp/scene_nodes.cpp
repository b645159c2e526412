#include "animation/import/assimp/scene_nodes.hpp"

#include <algorithm>
#include <string_view>

#include "animation/import/affine.hpp"
#include "animation/import/assimp/convert.hpp"
#include "animation/import/source_limits.hpp"

namespace lutka::animation::rig_import {
namespace {

// A transform that is not finite would spoil everything below it.
dmat4 usableTransform(const aiNode& node) {
    const dmat4 matrix = fromAssimp(node.mTransformation);
    return allFinite(matrix) ? matrix : dmat4(1.0);
}

}  // namespace

std::vector<int> SceneNodes::named(const std::string& name) const {
    const auto [first, last] = byName.equal_range(name);
    std::vector<int> found;
    for (auto at = first; at != last; ++at)
        found.push_back(at->second);
    std::sort(found.begin(), found.end());
    return found;
}

Result<SceneNodes> readNodes(const aiScene& scene, const std::string& location, SourceScene& out) {
    struct Pending {
        const aiNode* node;
        int parent;
        int depth;
    };
    SceneNodes nodes;
    std::vector<Pending> pending = {{scene.mRootNode, -1, 0}};
    while (!pending.empty()) {
        const Pending next = pending.back();
        pending.pop_back();
        if (out.nodes.size() >= kMaxNodes) return tooManyNodes(location);
        if (next.depth > kMaxDepth) return nestedTooDeep(location);
        const int index = static_cast<int>(out.nodes.size());
        SourceNode node;
        node.name = next.node->mName.C_Str();
        node.parent = next.parent;
        node.parentFromNode = usableTransform(*next.node);
        node.isHelper = std::string_view(node.name).find(kPivotMark) != std::string_view::npos;
        nodes.byName.emplace(node.name, index);
        nodes.sources.push_back(next.node);
        nodes.sceneFromNode.push_back(next.parent < 0 ? node.parentFromNode
                                                      : nodes.sceneFromNode[next.parent] * node.parentFromNode);
        out.nodes.push_back(std::move(node));
        for (unsigned child = next.node->mNumChildren; child-- > 0;) {
            if (next.node->mChildren[child] != nullptr)
                pending.push_back({next.node->mChildren[child], index, next.depth + 1});
        }
    }
    return nodes;
}

}  // namespace lutka::animation::rig_import
