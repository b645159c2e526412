#pragma once

/// From clips to joint-relative frames, an instance a lane: what sampleClip() and interpolate() do for one.

#include "animation/wide/pose_kernels.hpp"

namespace lutka::animation::wide::LUTKA_KERNELS {

LUTKA_LANES F gatherFloats(const float* from) {
    F out;
    for (int lane = 0; lane < kLanes; ++lane)
        out[lane] = from[lane];
    return out;
}

LUTKA_LANES F chosen(const Mask& where, const F& yes, const F& no) {
    return where ? yes : no;
}

LUTKA_LANES Rigid sampledTerm(const SampleJob& job, int term, long joint) {
    const F alpha = gatherFloats(job.alpha[term]);
    F turn = alpha;
    F place = alpha;
    for (int lane = 0; job.stepped != nullptr && lane < kLanes; ++lane) {
        const unsigned char held = job.stepped[job.steppedRow[term][lane] + joint];
        if ((held & kHeldTurn) != 0) turn[lane] = job.heldAlpha[term][lane];
        if ((held & kHeldPlace) != 0) place[lane] = job.heldAlpha[term][lane];
    }
    const float* frames = job.frames + joint * kRigidFloats;
    const Rigid before = gatherRigid(frames, job.before[term]);
    const Rigid after = gatherRigid(frames, job.after[term]);
    return {between(before, after, turn).turn, before.at + (after.at - before.at) * place};
}

static void sample(const SampleJob& job) {
    long to[kMostLanes];
    for (int lane = 0; lane < kLanes; ++lane)
        to[lane] = static_cast<long>(job.instances[lane]) * job.jointCount * kRigidFloats;
    for (long joint = 0; joint < job.jointCount; ++joint) {
        Rigid out = sampledTerm(job, 0, joint);
        for (int term = 1; term < job.termCount; ++term) {
            const F cover = gatherFloats(job.cover[term]);
            const Rigid mixed = between(out, sampledTerm(job, term, joint), cover);
            const Mask covers = cover > all(0.0F);
            out.turn = {chosen(covers, mixed.turn.x, out.turn.x), chosen(covers, mixed.turn.y, out.turn.y),
                        chosen(covers, mixed.turn.z, out.turn.z), chosen(covers, mixed.turn.w, out.turn.w)};
            out.at = {chosen(covers, mixed.at.x, out.at.x), chosen(covers, mixed.at.y, out.at.y),
                      chosen(covers, mixed.at.z, out.at.z)};
        }
        scatterRigid(job.out + joint * kRigidFloats, to, out);
    }
}

}  // namespace lutka::animation::wide::LUTKA_KERNELS
