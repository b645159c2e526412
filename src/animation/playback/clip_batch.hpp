#pragma once

#include <array>
#include <span>

#include "animation/playback/clip_library.hpp"
#include "animation/wide/groups.hpp"
#include "core/instruction_set.hpp"
#include "core/task_pool.hpp"

namespace lutka::animation {

inline constexpr int kMostClipTerms = 4;

/// Clips laid over each other, the first one below: each covers `cover` of what is there.
struct ClipTerm {
    int clip = 0;
    float seconds = 0.0F;  ///< Clamped to the clip's length.
    float cover = 1.0F;    ///< [0, 1]; the first one's is not read.
};
struct ClipMix {
    std::array<ClipTerm, kMostClipTerms> terms;
    int count = 1;  ///< [1, kMostClipTerms]
};

/// Poses of many figures of one library, four or eight at a time and in parallel: what ClipPlayer::pose() gives for one
/// layer without a mask. The results differ from that by rounding; every instruction set and every number of threads
/// gives the same bits. PoseBatch takes them from here to palettes.
class ClipBatch {
  public:
    /// `library` and `pool` must outlive the batch. With `inPlace` the travel is left out (RootMotion::extract).
    ClipBatch(const ClipLibrary& library, const TaskPool& pool, bool inPlace = false);

    /// `mixes` holds one a figure, `parentFromJoint` jointCount() frames a figure, one figure after the other.
    /// `instances` are those to do, without repeats; the others' poses stay as they were. Allocates nothing with one
    /// thread.
    void run(std::span<const int> instances, std::span<const ClipMix> mixes, std::span<RigidTransform> parentFromJoint);

    /// For tests: another set than the best.
    void useInstructionSet(InstructionSet set);

  private:
    void sampleGroup(const int* members, std::span<const ClipMix> mixes, float* out) const;
    void placeRoots(int instance, const ClipMix& mix, std::span<RigidTransform> parentFromJoint) const;

    const ClipLibrary* library_;
    const TaskPool& pool_;
    const wide::Kernels* kernels_;
    bool inPlace_;
    wide::Scratch scratch_;
};

}  // namespace lutka::animation
