#include "animation/playback/clip_batch.hpp"

#include "animation/wide/kernels.hpp"
#include "core/assert.hpp"

namespace lutka::animation {

static_assert(kMostClipTerms == wide::kMostSampleTerms);

ClipBatch::ClipBatch(const ClipLibrary& library, const TaskPool& pool, bool inPlace)
    : library_(&library),
      pool_(pool),
      kernels_(&wide::kernelsOf(bestInstructionSet())),
      inPlace_(inPlace && library.root().joint != kNoJoint),
      scratch_(pool, 1) {}

void ClipBatch::useInstructionSet(InstructionSet set) {
    kernels_ = &wide::kernelsOf(set);
}

// Terms that a figure has less than another of its group cover nothing, which leaves its bits alone.
void ClipBatch::sampleGroup(const int* members, std::span<const ClipMix> mixes, float* out) const {
    wide::SampleJob job{};
    job.frames = &library_->frames()[0].rotation.x;
    job.stepped = library_->steppedJoints().empty() ? nullptr : library_->steppedJoints().data();
    job.jointCount = library_->jointCount();
    job.instances = members;
    job.out = out;
    for (int lane = 0; lane < kernels_->lanes; ++lane) {
        const ClipMix& mix = mixes[members[lane]];
        LUTKA_ASSERT(mix.count >= 1 && mix.count <= kMostClipTerms);
        job.termCount = std::max(job.termCount, mix.count);
        for (int term = 0; term < kMostClipTerms; ++term) {
            const ClipTerm& of = mix.terms[std::min(term, mix.count - 1)];
            LUTKA_ASSERT(of.clip >= 0 && of.clip < library_->clipCount());
            const ClipLibrary::Moment moment = library_->momentOf(of.clip, of.seconds);
            job.before[term][lane] = static_cast<long>(moment.before) * wide::kRigidFloats;
            job.after[term][lane] = static_cast<long>(moment.after) * wide::kRigidFloats;
            job.alpha[term][lane] = moment.alpha;
            job.heldAlpha[term][lane] = moment.heldAlpha;
            job.steppedRow[term][lane] = static_cast<long>(of.clip) * job.jointCount;
            job.cover[term][lane] = term < mix.count ? of.cover : 0.0F;
        }
    }
    kernels_->sample(job);
}

// The figure's joints without a parent, once more and without travel.
void ClipBatch::placeRoots(int instance, const ClipMix& mix, std::span<RigidTransform> parentFromJoint) const {
    const auto joints = static_cast<std::size_t>(library_->jointCount());
    for (int i = 0; i < mix.count; ++i) {
        const ClipTerm& term = mix.terms[i];
        const RigidTransform groundFromModel = inverse(library_->groundFrame(term.clip, term.seconds));
        const ClipLibrary::Moment moment = library_->momentOf(term.clip, term.seconds);
        for (const int root : library_->rootJoints()) {
            const std::span<const unsigned char> stepped = library_->steppedJoints();
            const unsigned char held =
                stepped.empty() ? 0 : stepped[static_cast<std::size_t>(term.clip) * joints + root];
            const RigidTransform frame = groundFromModel * library_->jointAt(moment, root, held);
            RigidTransform& out = parentFromJoint[static_cast<std::size_t>(instance) * joints + root];
            out = i == 0 ? frame : interpolate(out, frame, term.cover);
        }
    }
}

void ClipBatch::run(std::span<const int> instances, std::span<const ClipMix> mixes,
                    std::span<RigidTransform> parentFromJoint) {
    LUTKA_ASSERT(parentFromJoint.size() == mixes.size() * static_cast<std::size_t>(library_->jointCount()));
    if (instances.empty() || library_->clipCount() == 0) return;
    float* const out = &parentFromJoint[0].rotation.x;
    const int lanes = kernels_->lanes;
    wide::forGroups(pool_, scratch_, instances, lanes, [&](const int* members, float*) {
        sampleGroup(members, mixes, out);
        for (int lane = 0; inPlace_ && lane < lanes; ++lane) {
            const bool repeated = lane > 0 && members[lane] == members[lane - 1];
            if (!repeated) placeRoots(members[lane], mixes[members[lane]], parentFromJoint);
        }
    });
}

}  // namespace lutka::animation
