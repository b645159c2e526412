#include "animation/pose_batch.hpp"

#include "animation/wide/kernels.hpp"
#include "core/assert.hpp"

namespace lutka::animation {

static_assert(sizeof(RigidTransform) == wide::kRigidFloats * sizeof(float));

PoseBatch::PoseBatch(const Skeleton& skeleton, const TaskPool& pool)
    : pool_(pool),
      kernels_(&wide::kernelsOf(bestInstructionSet())),
      parents_(skeleton.parents),
      bindModelFromJoint_(skeleton.bindModelFromJoint),
      scratch_(pool, skeleton.parents.size() * wide::kRigidFloats * wide::kMostLanes) {}

void PoseBatch::useInstructionSet(InstructionSet set) {
    kernels_ = &wide::kernelsOf(set);
}

void PoseBatch::run(std::span<const int> instances, std::span<const RigidTransform> parentFromJoint,
                    std::span<SkinMatrix> palettes, std::span<RigidTransform> modelFromJoint) {
    LUTKA_ASSERT(palettes.size() == parentFromJoint.size());
    LUTKA_ASSERT(modelFromJoint.empty() || modelFromJoint.size() == parentFromJoint.size());
    if (parentFromJoint.empty() || instances.empty()) return;
    wide::PropagateJob job{};
    job.parents = parents_.data();
    job.jointCount = static_cast<int>(parents_.size());
    job.bindModelFromJoint = &bindModelFromJoint_[0].rotation.x;
    job.parentFromJoint = &parentFromJoint[0].rotation.x;
    job.palettes = &palettes[0].rows[0].x;
    job.poses = modelFromJoint.empty() ? nullptr : &modelFromJoint[0].rotation.x;
    wide::forGroups(pool_, scratch_, instances, kernels_->lanes, [&](const int* members, float* scratch) {
        wide::PropagateJob group = job;
        group.instances = members;
        group.scratch = scratch;
        kernels_->propagate(group);
    });
}

}  // namespace lutka::animation
