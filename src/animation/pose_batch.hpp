#pragma once

#include <span>
#include <vector>

#include "animation/skinning.hpp"
#include "animation/wide/groups.hpp"
#include "core/task_pool.hpp"

namespace lutka::animation {

/// Propagation and palettes of many instances of one skeleton: localToModel() and skinMatrices() four or eight
/// instances at a time, in parallel. What they give differs from theirs by rounding (1e-5 m on a figure); every
/// instruction set and every number of threads gives the same bits.
class PoseBatch {
  public:
    /// `pool` must outlive the batch. Allocates what run() needs.
    PoseBatch(const Skeleton& skeleton, const TaskPool& pool);

    /// `parentFromJoint` holds jointCount() frames an instance, one instance after the other; so do `palettes` and
    /// `modelFromJoint`, which may be empty to leave it out, and which may be `parentFromJoint` itself. `instances`
    /// are those to do, without repeats; the others' results stay as they were. Allocates nothing with one thread.
    void run(std::span<const int> instances, std::span<const RigidTransform> parentFromJoint,
             std::span<SkinMatrix> palettes, std::span<RigidTransform> modelFromJoint = {});

    /// For tests: another set than the best.
    void useInstructionSet(InstructionSet set);

  private:
    const TaskPool& pool_;
    const wide::Kernels* kernels_;
    std::vector<int> parents_;
    std::vector<RigidTransform> bindModelFromJoint_;
    wide::Scratch scratch_;
};

}  // namespace lutka::animation
