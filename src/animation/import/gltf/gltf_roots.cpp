#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "animation/import/gltf/gltf_parts.hpp"
#include "animation/import/source_limits.hpp"

namespace lutka::animation::rig_import::gltf {
namespace {

// The tree of all nodes, whatever scene they are in.
struct NodeTree {
    std::vector<std::vector<int>> children;
    std::vector<int> parents;  // -1: none
};

NodeTree treeOf(const GltfFile& file) {
    NodeTree tree;
    const std::size_t count = file.count("nodes");
    tree.parents.assign(count, -1);
    for (std::size_t node = 0; node < count; ++node) {
        tree.children.push_back(childrenOf(file, static_cast<int>(node)));
        for (const int child : tree.children.back())
            tree.parents[child] = static_cast<int>(node);
    }
    return tree;
}

// Which nodes are at or below these; a ring ends where it began.
std::vector<bool> reachedFrom(const NodeTree& tree, const std::vector<int>& roots) {
    std::vector<bool> reached(tree.parents.size(), false);
    std::vector<int> pending = roots;
    while (!pending.empty()) {
        const int node = pending.back();
        pending.pop_back();
        if (reached[node]) continue;
        reached[node] = true;
        pending.insert(pending.end(), tree.children[node].begin(), tree.children[node].end());
    }
    return reached;
}

// The skins of the meshes among these nodes.
std::set<int> skinsAmong(const GltfFile& file, const std::vector<bool>& reached) {
    std::set<int> skins;
    for (int node = 0; node < static_cast<int>(reached.size()); ++node) {
        if (!reached[node]) continue;
        const nlohmann::json& source = file.element("nodes", node);
        const std::optional<int> skin = indexOf(source, "skin", file.count("skins"));
        if (skin && source.contains("mesh")) skins.insert(*skin);
    }
    return skins;
}

std::vector<int> sceneRoots(const GltfFile& file, int scene) {
    return indicesOf(file.element("scenes", scene), "nodes", file.count("nodes"));
}

// The scene that is read. A file may hold its figure in another scene than the one that it shows: a stage, an empty
// default.
int sceneOf(const GltfFile& file, const NodeTree& tree, std::vector<std::string>& warnings) {
    const std::size_t count = file.count("scenes");
    const std::optional<int> named = indexOf(file.json(), "scene", count);
    const auto hasFigure = [&](int scene) {
        return !skinsAmong(file, reachedFrom(tree, sceneRoots(file, scene))).empty();
    };
    const int first = named.value_or(0);
    if (count == 1 || hasFigure(first)) return first;
    for (int scene = 0; scene < static_cast<int>(count); ++scene) {
        if (!hasFigure(scene)) continue;
        if (named)
            warnings.push_back(
                fmt::format("the file shows scene {}, which holds no figure: took scene {}", first, scene));
        return scene;
    }
    return first;
}

// Whether a node hangs below itself.
bool isInRing(const NodeTree& tree, int node) {
    int above = tree.parents[node];
    for (int depth = 0; above >= 0 && above != node && depth < kMaxDepth; ++depth)
        above = tree.parents[above];
    return above == node;
}

// Some writers list all nodes of a scene, and not those alone that hang on no other; or one twice.
void keepTops(const NodeTree& tree, std::vector<int>& roots, std::vector<std::string>& warnings) {
    std::vector<int> below;
    for (const int root : roots)
        below.insert(below.end(), tree.children[root].begin(), tree.children[root].end());
    const std::vector<bool> hang = reachedFrom(tree, below);
    std::vector<bool> isListed(tree.parents.size(), false);
    const std::size_t listed = roots.size();
    std::erase_if(roots, [&](int root) {
        const bool again = isListed[root] || (hang[root] && !isInRing(tree, root));
        isListed[root] = true;
        return again;
    });
    if (roots.size() < listed)
        warnings.push_back(fmt::format(
            "the scene lists {} of its nodes once more, or beside nodes that they hang on: they are there once",
            listed - roots.size()));
}

// Adds the tops of the trees that hold the joints of skins which these nodes use.
void bringJoints(const GltfFile& file, const NodeTree& tree, std::vector<int>& roots) {
    const std::vector<bool> reached = reachedFrom(tree, roots);
    std::vector<int> tops;
    std::vector<int> walkOf(reached.size(), -1);  // which joint's way up came by; so every node is walked once
    for (const int skin : skinsAmong(file, reached)) {
        const auto joints =
            within("skins", skin, [&] { return indicesOf(file.element("skins", skin), "joints", reached.size()); });
        for (const int joint : joints) {
            if (reached[joint] || walkOf[joint] >= 0) continue;
            int top = joint;
            walkOf[top] = joint;
            while (tree.parents[top] >= 0 && walkOf[tree.parents[top]] < 0) {
                top = tree.parents[top];
                walkOf[top] = joint;
            }
            const bool wasWalked = tree.parents[top] >= 0 && walkOf[tree.parents[top]] != joint;
            if (!wasWalked) tops.push_back(top);  // or a place in a ring, which is refused where nodes are added
        }
    }
    if (tops.empty()) return;
    const std::vector<bool> below = reachedFrom(tree, tops);
    std::erase_if(roots, [&](int root) { return below[root]; });
    roots.insert(roots.end(), tops.begin(), tops.end());
}

}  // namespace

std::vector<int> childrenOf(const GltfFile& file, int node) {
    std::vector<int> children =
        within("nodes", node, [&] { return indicesOf(file.element("nodes", node), "children", file.count("nodes")); });
    std::set<int> seen;
    std::erase_if(children, [&](int child) { return !seen.insert(child).second; });
    return children;
}

std::vector<int> rootsOf(const GltfFile& file, std::vector<std::string>& warnings) {
    const NodeTree tree = treeOf(file);
    std::vector<int> roots;
    if (file.count("scenes") > 0) {
        roots = sceneRoots(file, sceneOf(file, tree, warnings));
        keepTops(tree, roots, warnings);
        bringJoints(file, tree, roots);
        if (!roots.empty()) return roots;
    }
    for (std::size_t node = 0; node < tree.parents.size(); ++node) {
        if (tree.parents[node] < 0) roots.push_back(static_cast<int>(node));
    }
    return roots;
}

}  // namespace lutka::animation::rig_import::gltf
