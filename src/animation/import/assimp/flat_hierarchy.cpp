#include "animation/import/assimp/flat_hierarchy.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "animation/import/affine.hpp"

namespace lutka::animation::rig_import {
namespace {

struct FlatJoint {
    int node = -1;
    dmat4 parentFromJoint;
    std::optional<dmat4> stated;  ///< The bind matrix of a skinned joint.
    dmat4 bind{1.0};              ///< The stated one, or what follows from the parent.
    int parent = -1;              ///< Index among the flat joints; -1 for a root.
};

std::map<int, dmat4> statedBinds(const SourceScene& scene) {
    std::map<int, dmat4> binds;
    for (const SourceSkin& skin : scene.skins) {
        for (const SourceSkin::Joint& joint : skin.joints) {
            if (isInvertible(joint.jointFromMesh)) binds[joint.node] = glm::inverse(joint.jointFromMesh);
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

// Parents stand before their children in the file.
void hang(std::span<const FlatJoint> joints, SourceScene& scene) {
    for (const FlatJoint& joint : joints) {
        if (joint.parent >= 0) scene.nodes[joint.node].parent = joints[joint.parent].node;
    }
}

}  // namespace

void restoreFlatHierarchy(SourceScene& scene) {
    const auto flat = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                   [](const SourceNode& node) { return node.name == "<MDL_bones>"; });
    if (flat == scene.nodes.end()) return;
    const int first = static_cast<int>(flat - scene.nodes.begin());
    const std::map<int, dmat4> binds = statedBinds(scene);
    std::vector<FlatJoint> joints;
    for (int node = first + 1; node < static_cast<int>(scene.nodes.size()); ++node) {
        if (scene.nodes[node].parent != first) continue;
        FlatJoint joint;
        joint.node = node;
        joint.parentFromJoint = scene.nodes[node].parentFromNode;
        const auto stated = binds.find(node);
        if (stated != binds.end()) joint.stated = stated->second;
        if (!isInvertible(joint.parentFromJoint)) {
            scene.nodesArePosed = false;
            return;
        }
        joints.push_back(std::move(joint));
    }
    scene.nodesArePosed = HierarchyFinder(joints).solve();
    if (scene.nodesArePosed) hang(joints, scene);
}

}  // namespace lutka::animation::rig_import
