#pragma once

#include <span>
#include <vector>

#include "animation/skinning.hpp"
#include "animation/wide/groups.hpp"
#include "core/task_pool.hpp"
#include "physics/rig/rig.hpp"

namespace lutka::physics {

/// Bodies to palettes for many dolls of one rig: poseFromBodies() and skinMatrices() four or eight dolls at a time, in
/// parallel. What it gives differs from theirs by rounding (1e-5 m on a figure); every instruction set and every number
/// of threads gives the same bits.
class DollPoser {
  public:
    /// Where the dolls are. Bodies of one doll follow each other, doll after doll, in the world.
    struct Source {
        std::span<const RigidTransform> previous;  ///< Dolls × bodies; may be empty when alpha is 1.
        std::span<const RigidTransform> present;   ///< Dolls × bodies.
        float alpha = 1.0F;                        ///< Way from previous to present, [0, 1]; interpolate() between.
        std::span<const RigidTransform> worldFromModel;  ///< One a doll.
        std::span<const long> firstBody = {};   ///< One a doll: where its bodies begin; empty: doll after doll. For
                                                ///< crowds of several rigs, each of which has a poser of its own.
        std::span<const long> firstJoint = {};  ///< Likewise where its results go.
    };

    /// `pool` must outlive the poser. Allocates what run() needs.
    DollPoser(const Rig& rig, const animation::Skeleton& skeleton, const TaskPool& pool);

    /// For each of `dolls` (no repeats) jointCount() matrices into `palettes` and as many model-space frames into
    /// `modelFromJoint`; either may be empty. Other dolls' results stay as they were: leave those out
    /// that sleep. Followers keep their bind pose. Allocates nothing with one thread.
    void run(const Source& source, std::span<const int> dolls, std::span<animation::SkinMatrix> palettes,
             std::span<RigidTransform> modelFromJoint = {});

    /// For tests: another set than the best.
    void useInstructionSet(InstructionSet set);

  private:
    const TaskPool& pool_;
    const animation::wide::Kernels* kernels_;
    std::vector<animation::wide::FollowJoint> joints_;  // in the order of evaluation
    std::vector<quat> bindBodyTurns_;                   // conjugate
    animation::wide::Scratch scratch_;
};

}  // namespace lutka::physics
