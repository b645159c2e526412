#include "animation/pose.hpp"

#include "core/assert.hpp"

namespace lutka::animation {

void localToModel(const Skeleton& skeleton, std::span<const RigidTransform> parentFromJoint,
                  std::span<RigidTransform> modelFromJoint) {
    LUTKA_ASSERT(parentFromJoint.size() == skeleton.parents.size());
    LUTKA_ASSERT(modelFromJoint.size() == skeleton.parents.size());
    for (std::size_t joint = 0; joint < parentFromJoint.size(); ++joint) {
        const int parent = skeleton.parents[joint];
        modelFromJoint[joint] =
            parent == kNoJoint ? parentFromJoint[joint] : modelFromJoint[parent] * parentFromJoint[joint];
    }
}

RigidTransform modelFrameOf(const Skeleton& skeleton, std::span<const RigidTransform> parentFromJoint, int joint) {
    LUTKA_ASSERT(joint >= 0 && joint < skeleton.jointCount());
    LUTKA_ASSERT(parentFromJoint.size() == skeleton.parents.size());
    RigidTransform frame = parentFromJoint[joint];
    for (int at = skeleton.parents[joint]; at != kNoJoint; at = skeleton.parents[at])
        frame = parentFromJoint[at] * frame;
    return frame;
}

void modelToLocal(const Skeleton& skeleton, std::span<const RigidTransform> modelFromJoint,
                  std::span<RigidTransform> parentFromJoint) {
    LUTKA_ASSERT(parentFromJoint.size() == skeleton.parents.size());
    LUTKA_ASSERT(modelFromJoint.size() == skeleton.parents.size());
    LUTKA_ASSERT(modelFromJoint.data() != parentFromJoint.data());
    for (std::size_t joint = 0; joint < modelFromJoint.size(); ++joint) {
        const int parent = skeleton.parents[joint];
        parentFromJoint[joint] =
            parent == kNoJoint ? modelFromJoint[joint] : inverse(modelFromJoint[parent]) * modelFromJoint[joint];
    }
}

std::vector<RigidTransform> nodePose(const Skeleton& skeleton) {
    std::vector<RigidTransform> modelFromJoint(skeleton.parents.size());
    localToModel(skeleton, skeleton.nodeParentFromJoint, modelFromJoint);
    return modelFromJoint;
}

}  // namespace lutka::animation
