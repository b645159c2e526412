#include "animation/import/flat_hierarchy.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <optional>
#include <string>

namespace lutka::animation::rig_import {
namespace {

struct FlatJoint {
    int node = -1;
    dmat4 parentFromJoint;
    std::optional<dmat4> stated;  ///< The bind matrix of a skinned joint.
    dmat4 bind{1.0};              ///< The stated one, or what follows from the parent.
    int parent = -1;              ///< Index among the flat joints; -1 for a root.
};

std::map<std::string, dmat4> statedBinds(const aiScene& scene) {
    std::map<std::string, dmat4> binds;
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        for (unsigned b = 0; b < scene.mMeshes[m]->mNumBones; ++b) {
            const aiBone& bone = *scene.mMeshes[m]->mBones[b];
            const dmat4 offset = fromAssimp(bone.mOffsetMatrix);
            if (isInvertible(offset)) binds[bone.mName.C_Str()] = glm::inverse(offset);
        }
    }
    return binds;
}

class HierarchyFinder {
  public:
    explicit HierarchyFinder(std::vector<FlatJoint>& joints) : joints_(joints) {
        for (const FlatJoint& joint : joints_) {
            if (joint.stated) reach_ = std::max(reach_, glm::length(dvec3((*joint.stated)[3])));
        }
    }

    // Parents for all, in the file's order; false when a skinned joint finds none.
    bool solve() {
        for (int i = 0; i < static_cast<int>(joints_.size()); ++i) {
            FlatJoint& joint = joints_[i];
            if (joint.stated) {
                const std::optional<int> parent = parentWith(*joint.stated * glm::inverse(joint.parentFromJoint), i);
                if (!parent) return false;
                joint.parent = *parent;
                joint.bind = *joint.stated;
            } else {
                joint.parent = likelyParent(i);
                joint.bind = bindOf(joint.parent) * joint.parentFromJoint;
            }
        }
        return true;
    }

  private:
    dmat4 bindOf(int joint) const { return joint < 0 ? dmat4(1.0) : joints_[joint].bind; }

    bool same(const dmat4& a, const dmat4& b) const {
        return glm::distance(dvec3(a[3]), dvec3(b[3])) < 1e-3 * reach_ &&
               angleBetween(nearestRotation(a), nearestRotation(b)) < 0.02;
    }

    // The last joint before `end` that stands there; -1 for the origin, nothing when none does.
    std::optional<int> parentWith(const dmat4& bind, int end) const {
        for (int i = end - 1; i >= -1; --i) {
            if (same(bindOf(i), bind)) return i;
        }
        return std::nullopt;
    }

    // Of a joint without a skin: one under which it becomes the parent that a later skinned joint asks for, else the
    // one just before it, as files list their joints depth first.
    int likelyParent(int index) const {
        for (int parent = index - 1; parent >= -1; --parent) {
            const dmat4 bind = bindOf(parent) * joints_[index].parentFromJoint;
            for (std::size_t later = static_cast<std::size_t>(index) + 1; later < joints_.size(); ++later) {
                const FlatJoint& child = joints_[later];
                if (child.stated && same(*child.stated * glm::inverse(child.parentFromJoint), bind)) return parent;
            }
        }
        return index - 1;
    }

    std::vector<FlatJoint>& joints_;
    double reach_ = 1e-9;
};

void hang(std::span<const FlatJoint> joints, NodeTree& tree) {
    for (const FlatJoint& joint : joints) {
        if (joint.parent < 0) continue;
        tree.nodes[joint.node].parent = joints[joint.parent].node;
        tree.jointParents[tree.nodes[joint.node].joint] = tree.nodes[joints[joint.parent].node].joint;
    }
    for (NodeTree::Node& node : tree.nodes) {
        node.sceneFromNode =
            node.parent < 0 ? node.parentFromNode : tree.nodes[node.parent].sceneFromNode * node.parentFromNode;
    }
}

}  // namespace

void restoreFlatHierarchy(const aiScene& scene, NodeTree& tree) {
    const std::vector<int> flat = tree.named("<MDL_bones>");
    if (flat.empty()) return;
    const std::map<std::string, dmat4> binds = statedBinds(scene);
    std::vector<FlatJoint> joints;
    for (int node = flat.front() + 1; node < static_cast<int>(tree.nodes.size()); ++node) {
        if (tree.nodes[node].parent != flat.front()) continue;
        FlatJoint joint;
        joint.node = node;
        joint.parentFromJoint = tree.nodes[node].parentFromNode;
        const auto stated = binds.find(tree.nodes[node].source->mName.C_Str());
        if (stated != binds.end()) joint.stated = stated->second;
        if (!isInvertible(joint.parentFromJoint)) {
            tree.nodesArePosed = false;
            return;
        }
        joints.push_back(std::move(joint));
    }
    tree.nodesArePosed = HierarchyFinder(joints).solve();
    if (tree.nodesArePosed) hang(joints, tree);
}

}  // namespace lutka::animation::rig_import
