#include "physics/crowd/jobs.hpp"

#include <algorithm>

#include "physics/crowd/packing.hpp"
#include "physics/crowd/parts.hpp"
#include "physics/crowd/substeps.hpp"

namespace lutka::physics::crowd {
namespace {

void assignBatches(CrowdState& state) {
    for (std::size_t i = 0; i < state.active.size(); ++i)
        state.active[i]->job = static_cast<int>(i);
    UnionFind& sets = state.scratch.sets;
    sets.reset(state.active.size());
    for (const PairTouch& touch : state.touches)
        sets.join(state.batchOf(state.dolls[touch.dollA]).job, state.batchOf(state.dolls[touch.dollB]).job);
    std::vector<int>& jobOf = state.scratch.jobOf;
    jobOf.assign(state.active.size(), -1);
    state.jobCount = 0;
    for (std::size_t i = 0; i < state.active.size(); ++i) {
        const int root = sets.find(static_cast<int>(i));
        if (jobOf[root] < 0) {
            jobOf[root] = static_cast<int>(state.jobCount++);
            if (state.jobs.size() < state.jobCount) state.jobs.emplace_back();
            Job& fresh = state.jobs[jobOf[root]];
            fresh.batches.clear();
            fresh.topologies.clear();
            fresh.touches.clear();
            fresh.drags.clear();
            fresh.forces.clear();
        }
        Job& job = state.jobs[jobOf[root]];
        job.batches.push_back(state.active[i]);
        job.topologies.push_back(&state.activeGroup[i]->topology);
    }
    for (std::size_t i = 0; i < state.active.size(); ++i)
        state.active[i]->job = jobOf[sets.find(static_cast<int>(i))];
}

// Which bodies of each batch pair contacts push, and where they are kept meanwhile.
void findPaired(CrowdState& state) {
    state.motions.resize(static_cast<std::size_t>(state.bodyTotal));
    state.frames.resize(static_cast<std::size_t>(state.bodyTotal));
    for (Batch* batch : state.active) {
        batch->paired.clear();
        batch->isPaired.assign(batch->bodies.size(), 0);
        batch->pairBodies = pairBodiesOf(state);
        for (int lane = 0; lane < kLanes; ++lane)
            batch->firstBody[lane] = state.dolls[batch->doll[lane < batch->used ? lane : 0]].firstBody;
    }
    const auto add = [&](int doll, int body) { state.batchOf(state.dolls[doll]).isPaired[body] = 1; };
    for (const PairTouch& touch : state.touches) {
        add(touch.dollA, touch.bodyA);
        add(touch.dollB, touch.bodyB);
    }
    for (Batch* batch : state.active)
        for (std::size_t body = 0; body < batch->isPaired.size(); ++body)
            if (batch->isPaired[body] != 0) batch->paired.push_back(static_cast<int>(body));
}

}  // namespace

void makeJobs(CrowdState& state) {
    assignBatches(state);
    findPaired(state);
    for (std::size_t i = 0; i < state.touches.size(); ++i)
        state.jobs[state.batchOf(state.dolls[state.touches[i].dollA]).job].touches.push_back(static_cast<int>(i));
    for (DragRecord& record : state.drags) {
        const Doll& doll = state.dolls[record.doll];
        state.jobs[state.batchOf(doll).job].drags.push_back(&record);
    }
    const auto jobOf = [&](int doll) -> Job& { return state.jobs[state.batchOf(state.dolls[doll]).job]; };
    for (const ForceRecord& record : state.forces)
        jobOf(record.doll).forces.push_back(&record);
    for (std::size_t i = 0; i < state.jobCount; ++i)
        setSubsteps(state, state.jobs[i]);
    // A muscle or pull at its bound works against what may give way at once, however calm the doll is yet.
    for (const MotorRecord& record : state.motors)
        if (record.bounded && !state.dolls[record.doll].asleep()) jobOf(record.doll).substeps = state.tuning.substeps;
    for (const DragRecord& record : state.drags)
        if (record.bounded) jobOf(record.doll).substeps = state.tuning.substeps;
    partTouches(state);
    packTouches(state);
}

}  // namespace lutka::physics::crowd
