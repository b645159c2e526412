#include "animation/import/skin_binding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

namespace lutka::animation::rig_import {
namespace {

bool isBoneName(const std::set<std::string>& names, const aiNode* node) {
    return node != nullptr && names.count(node->mName.C_Str()) > 0;
}

int skinnedNeighbours(const std::set<std::string>& names, const aiNode& node) {
    int count = isBoneName(names, node.mParent) ? 1 : 0;
    for (unsigned child = 0; child < node.mNumChildren; ++child)
        count += isBoneName(names, node.mChildren[child]) ? 1 : 0;
    return count;
}

// Nodes may share a name (a mesh node often has that of the joint it follows). The joint is the one without meshes,
// with skinned neighbours, whose node stands nearest to where the skin says.
int resolveBone(const NodeTree& tree, const aiBone& bone, const dmat4& sceneFromMesh,
                const std::set<std::string>& boneNames, const std::set<int>& taken) {
    const dvec3 expected(sceneFromMesh * glm::inverse(fromAssimp(bone.mOffsetMatrix))[3]);
    std::tuple<bool, bool, int, double> best{true, true, 0, 0.0};
    int found = -1;
    for (const int candidate : tree.named(bone.mName.C_Str())) {
        const NodeTree::Node& node = tree.nodes[candidate];
        const std::tuple<bool, bool, int, double> rank{taken.count(node.joint) > 0, node.source->mNumMeshes > 0,
                                                       -skinnedNeighbours(boneNames, *node.source),
                                                       glm::distance(expected, dvec3(node.sceneFromNode[3]))};
        if (found < 0 || rank < best) {
            best = rank;
            found = candidate;
        }
    }
    return found < 0 ? -1 : tree.nodes[found].joint;
}

double weightOf(const aiBone& bone) {
    double sum = 0.0;
    for (unsigned i = 0; i < bone.mNumWeights; ++i) {
        const double weight = bone.mWeights[i].mWeight;
        if (weight > 0.0 && std::isfinite(weight)) sum += weight;
    }
    return sum;
}

std::vector<SkinJoint> bindJoints(const aiMesh& mesh, const NodeTree& tree, int node,
                                  const std::set<std::string>& boneNames, std::vector<std::string>& warnings) {
    std::vector<SkinJoint> joints;
    std::set<int> taken;
    for (unsigned i = 0; i < mesh.mNumBones; ++i) {
        const aiBone* bone = mesh.mBones[i];
        const double weight = bone == nullptr ? 0.0 : weightOf(*bone);
        if (!(weight > 0.0)) continue;
        const dmat4 offset = fromAssimp(bone->mOffsetMatrix);
        if (!isInvertible(offset)) {
            warnings.push_back(fmt::format("the skin of joint '{}' in mesh '{}' has an unusable bind matrix; left out",
                                           bone->mName.C_Str(), mesh.mName.C_Str()));
            continue;
        }
        const int joint = resolveBone(tree, *bone, tree.nodes[node].sceneFromNode, boneNames, taken);
        if (joint < 0) {
            warnings.push_back(fmt::format("mesh '{}' is skinned to '{}', which is no node of the scene; left out",
                                           mesh.mName.C_Str(), bone->mName.C_Str()));
            continue;
        }
        taken.insert(joint);
        joints.push_back({joint, offset, bone, weight});
    }
    return joints;
}

}  // namespace

std::vector<MeshInstance> bindMeshes(const aiScene& scene, const NodeTree& tree, std::vector<std::string>& warnings) {
    std::set<std::string> boneNames;
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        for (unsigned i = 0; i < scene.mMeshes[m]->mNumBones; ++i)
            boneNames.insert(scene.mMeshes[m]->mBones[i]->mName.C_Str());
    }
    std::vector<MeshInstance> instances;
    std::set<unsigned> skinnedDone;
    for (int node = 0; node < static_cast<int>(tree.nodes.size()); ++node) {
        const aiNode& source = *tree.nodes[node].source;
        for (unsigned i = 0; i < source.mNumMeshes; ++i) {
            const unsigned index = source.mMeshes[i];
            if (index >= scene.mNumMeshes || skinnedDone.count(index) > 0) continue;
            const aiMesh& mesh = *scene.mMeshes[index];
            if ((mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0U || mesh.mNumVertices == 0) continue;
            MeshInstance instance{&mesh, node, bindJoints(mesh, tree, node, boneNames, warnings)};
            if (!instance.joints.empty()) skinnedDone.insert(index);
            instances.push_back(std::move(instance));
        }
    }
    return instances;
}

}  // namespace lutka::animation::rig_import
