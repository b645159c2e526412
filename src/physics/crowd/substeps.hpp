#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// How large a figure is for the pace of its substeps: its height over 0.75 m, in [0.25, 1]. From the same table a hand
/// falls as fast as a man, and turns its fingers eight times as far in a substep. So a small figure needs its share of
/// a substep's speeds (CrowdTuning::substepSpeed), and more substeps at most.
[[nodiscard]] float paceOf(float heightM);

/// How many substeps a step of `dt` seconds has. CrowdTuning's numbers are those of 1 / CrowdTuning::rate s: a longer
/// step has as many more, a shorter one fewer, so that a substep is about as long at any rate of frames. Where the
/// settings tell how many, a step has no more than that, however long it is.
[[nodiscard]] StepSubsteps substepsFor(const CrowdState& state, float dt);

/// Sets by how its dolls move now how many substeps a step of `dt` seconds needs for the batch
/// (CrowdState::stepSubsteps) and whether it hardly moves at all.
void findPace(const CrowdState& state, Batch& batch, const Topology& topology, float dt);

/// Sets Job::substeps: about the most that any doll of the job needs (CrowdTuning::spared), the usual number at most in
/// heaps, and just that where frames or forces act.
void setSubsteps(CrowdState& state, Job& job);

/// Impulses that are carried from step to step are those of one substep: fits them to one of `seconds`.
void fitImpulses(CrowdState& state, Job& job, float seconds);

}  // namespace lutka::physics::crowd
