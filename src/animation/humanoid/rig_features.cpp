#include "animation/humanoid/rig_features.hpp"

#include <algorithm>

namespace lutka::animation {
namespace {

constexpr std::size_t kMaxVertices = 12000;

void walkTree(RigFeatures& rig) {
    const int count = rig.count();
    std::vector<int> size(count, 1);
    rig.depth.assign(count, 0);
    for (int joint = count - 1; joint >= 0; --joint) {
        if (rig.parents[joint] != kNoJoint) size[rig.parents[joint]] += size[joint];
    }
    rig.enter.assign(count, 0);
    rig.leave.assign(count, 0);
    std::vector<int> next(count, 0);
    int nextRoot = 0;
    for (int joint = 0; joint < count; ++joint) {
        const int parent = rig.parents[joint];
        int& slot = parent == kNoJoint ? nextRoot : next[parent];
        rig.enter[joint] = slot;
        rig.leave[joint] = slot + size[joint];
        slot += size[joint];
        next[joint] = rig.enter[joint] + 1;
        if (parent != kNoJoint) rig.depth[joint] = rig.depth[parent] + 1;
    }
}

void readWeights(const Skeleton& skeleton, RigFeatures& rig) {
    const int count = rig.count();
    rig.ownWeight = skeleton.skinWeight;
    rig.subtreeWeight = skeleton.skinWeight;
    float total = 0.0F;
    for (int joint = count - 1; joint >= 0; --joint) {
        total += rig.ownWeight[joint];
        if (rig.parents[joint] != kNoJoint) rig.subtreeWeight[rig.parents[joint]] += rig.subtreeWeight[joint];
    }
    rig.skinned = total > 0.0F;
    const float scale = rig.skinned ? 1.0F / total : 0.0F;
    for (int joint = 0; joint < count; ++joint) {
        rig.ownWeight[joint] *= scale;
        rig.subtreeWeight[joint] *= scale;
    }
    // Rigid parts and collision volumes hang on their joint as leaves and carry its weight.
    for (int joint = 0; joint < count; ++joint) {
        if (rig.ownWeight[joint] > 0.0F) continue;
        for (const int child : rig.children[joint]) {
            if (rig.children[child].empty()) rig.ownWeight[joint] += rig.ownWeight[child];
        }
    }
}

void readVertices(const Character& character, RigFeatures& rig) {
    std::size_t total = 0;
    for (const SkinnedMesh& mesh : character.meshes)
        total += mesh.positions.size();
    const std::size_t stride = total / kMaxVertices + 1;
    for (const SkinnedMesh& mesh : character.meshes) {
        for (std::size_t i = 0; i < mesh.positions.size(); i += stride) {
            if (i < mesh.joints.size() && mesh.joints[i][0] < rig.positions.size()) {
                rig.vertices.push_back({mesh.positions[i], mesh.joints[i][0]});
            }
        }
    }
}

}  // namespace

int RigFeatures::commonAncestor(int a, int b) const {
    while (a != kNoJoint && !isAncestorOrSelf(a, b))
        a = parents[a];
    return a;
}

RigFeatures readRig(const Character& character, bool useNames) {
    const Skeleton& skeleton = character.skeleton;
    RigFeatures rig;
    rig.parents = skeleton.parents;
    rig.children = childrenOf(skeleton);
    rig.positions.reserve(skeleton.bindModelFromJoint.size());
    for (const RigidTransform& frame : skeleton.bindModelFromJoint)
        rig.positions.push_back(frame.translation);
    walkTree(rig);
    readWeights(skeleton, rig);
    readVertices(character, rig);
    rig.names.resize(rig.positions.size());
    if (useNames) std::transform(skeleton.names.begin(), skeleton.names.end(), rig.names.begin(), nameEvidence);
    return rig;
}

}  // namespace lutka::animation
