#include "animation/import/fbx/model_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "animation/import/source_limits.hpp"

namespace lutka::animation::rig_import::fbx {
namespace {

struct Pending {
    int model;
    int parent;
    int depth;
};

class TreeBuilder {
  public:
    explicit TreeBuilder(const Objects& objects) : objects_(objects) {
        tree_.names.emplace_back("RootNode");
        tree_.parents.push_back(-1);
        NodeTransform root;
        root[Part::scaling] = dvec3(1);
        tree_.transforms.push_back(root);
        tree_.origins.emplace_back(0);
    }

    // The models below; false when there are too many or they are nested too deep.
    bool addBelow(std::vector<Pending> pending) {
        while (!pending.empty()) {
            const Pending next = pending.back();
            pending.pop_back();
            if (tree_.nodeOfModel.count(next.model) > 0) continue;
            if (tree_.parents.size() >= kMaxNodes || next.depth > kMaxDepth) return false;
            const int node = add(next);
            const std::vector<int> children = objects_.children(next.model, "Model");
            for (auto child = children.rbegin(); child != children.rend(); ++child)
                pending.push_back({*child, node, next.depth + 1});
        }
        return true;
    }

    ModelTree take() {
        leaveOutEffectors();
        return std::move(tree_);
    }

  private:
    int add(const Pending& next) {
        const int node = static_cast<int>(tree_.parents.size());
        const Object& object = objects_[next.model];
        tree_.names.push_back(object.name);
        tree_.parents.push_back(next.parent);
        tree_.transforms.push_back(transformOf(object.properties));
        tree_.origins.push_back(carriesRigidMesh(next.model) ? pivotInNode(tree_.transforms.back()) : dvec3(0));
        tree_.nodeOfModel[next.model] = node;
        tree_.inOrder.emplace_back(next.model, node);
        return node;
    }

    // A mesh without a skin, of a model that is no joint of another mesh's.
    [[nodiscard]] bool carriesRigidMesh(int model) const {
        std::vector<int> owners = objects_.children(model, "Geometry", "Mesh");
        if (objects_[model].record->child("Vertices") != nullptr) owners.push_back(model);
        const auto hasSkin = [&](int owner) { return !objects_.children(owner, "Deformer", "Skin").empty(); };
        const std::span<const Connection> above = objects_.parentsOf(model);
        const auto isCluster = [&](const Connection& connection) {
            return connection.parent >= 0 && objects_[connection.parent].kind == "Deformer";
        };
        return !owners.empty() && std::none_of(owners.begin(), owners.end(), hasSkin) &&
               std::none_of(above.begin(), above.end(), isCluster);
    }

    // They repeat the figure joint by joint, and would be taken for a second one.
    void leaveOutEffectors() {
        std::vector<bool> keep(tree_.parents.size(), false);
        keep[0] = true;
        for (auto entry = tree_.inOrder.rbegin(); entry != tree_.inOrder.rend(); ++entry) {
            const auto node = static_cast<std::size_t>(entry->second);
            if (!objects_[entry->first].subKind.ends_with("Effector")) keep[node] = true;
            if (keep[node]) keep[static_cast<std::size_t>(tree_.parents[node])] = true;
        }
        ModelTree kept;
        std::vector<int> newIndex(keep.size(), -1);
        for (std::size_t node = 0; node < keep.size(); ++node) {
            if (!keep[node]) continue;
            newIndex[node] = static_cast<int>(kept.parents.size());
            const int parent = tree_.parents[node];
            kept.parents.push_back(parent < 0 ? -1 : newIndex[static_cast<std::size_t>(parent)]);
            kept.names.push_back(std::move(tree_.names[node]));
            kept.transforms.push_back(tree_.transforms[node]);
            kept.origins.push_back(tree_.origins[node]);
        }
        for (const auto& [model, node] : tree_.inOrder) {
            const int index = newIndex[static_cast<std::size_t>(node)];
            if (index < 0) continue;
            kept.nodeOfModel[model] = index;
            kept.inOrder.emplace_back(model, index);
        }
        tree_ = std::move(kept);
    }

    const Objects& objects_;
    ModelTree tree_;
};

// The models that no model is above.
std::vector<int> topModels(const Objects& objects) {
    std::vector<int> out;
    for (int i = 0; i < static_cast<int>(objects.all().size()); ++i) {
        if (objects[i].kind != "Model") continue;
        bool below = false;
        for (const Connection& connection : objects.parentsOf(i))
            below = below || (connection.parent >= 0 && objects[connection.parent].kind == "Model");
        if (!below) out.push_back(i);
    }
    return out;
}

}  // namespace

void evaluateTree(const ModelTree& tree, std::span<const NodeTransform> transforms, std::span<dmat4> parentFromNode) {
    evaluateNodes(transforms, tree.parents, parentFromNode);
    for (std::size_t node = 0; node < tree.parents.size(); ++node) {
        const int parent = tree.parents[node];
        const dvec3 above = parent < 0 ? dvec3(0) : tree.origins[static_cast<std::size_t>(parent)];
        parentFromNode[node] = glm::translate(parentFromNode[node], tree.origins[node]);
        parentFromNode[node][3] -= glm::dvec4(above, 0.0);
    }
}

Result<ModelTree> readModelTree(const Objects& objects, const std::string& location) {
    TreeBuilder builder(objects);
    std::vector<Pending> pending;
    const std::vector<int> rooted = objects.children(Objects::kRoot, "Model");
    const std::vector<int> top = topModels(objects);
    // Those without any connection come last; what is left then hangs in a ring.
    for (auto model = top.rbegin(); model != top.rend(); ++model)
        pending.push_back({*model, 0, 1});
    for (auto model = rooted.rbegin(); model != rooted.rend(); ++model)
        pending.push_back({*model, 0, 1});
    bool fits = builder.addBelow(std::move(pending));
    for (int i = 0; fits && i < static_cast<int>(objects.all().size()); ++i) {
        if (objects[i].kind == "Model") fits = builder.addBelow({{i, 0, 1}});
    }
    if (!fits) {
        return Error{ErrorCode::input,
                     fmt::format("more than {} nodes, or nodes nested deeper than {}", kMaxNodes, kMaxDepth), location,
                     "export the character without the rest of the scene"};
    }
    return builder.take();
}

}  // namespace lutka::animation::rig_import::fbx
