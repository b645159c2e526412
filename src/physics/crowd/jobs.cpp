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
    int dollA = -1;
    int dollB = -1;
    for (const TouchBrief& brief : state.briefs) {
        if (brief.dollA == dollA && brief.dollB == dollB) continue;  // those of two dolls come one after the other
        dollA = brief.dollA;
        dollB = brief.dollB;
        sets.join(state.batchOf(state.dolls[dollA]).job, state.batchOf(state.dolls[dollB]).job);
    }
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
            fresh.deepTouches = 0;
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

// Each job's contacts, which bodies of each batch they push, and where these are kept meanwhile.
void findPaired(CrowdState& state) {
    state.motions.resize(static_cast<std::size_t>(state.bodyTotal));
    state.frames.resize(static_cast<std::size_t>(state.bodyTotal));
    state.isPaired.assign(static_cast<std::size_t>(state.bodyTotal), 0);
    int doll = -1;
    Job* job = nullptr;
    for (std::size_t i = 0; i < state.briefs.size(); ++i) {
        const TouchBrief& brief = state.briefs[i];
        state.isPaired[brief.bodyA] = state.isPaired[brief.bodyB] = 1;
        if (brief.dollA != doll) {
            doll = brief.dollA;
            job = &state.jobs[state.batchOf(state.dolls[doll]).job];
        }
        job->touches.push_back(static_cast<int>(i));
        job->deepTouches += brief.isDeep ? 1 : 0;
    }
    state.inParallel(state.active.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Batch& batch = *state.active[i];
            batch.paired.clear();
            batch.pairBodies = pairBodiesOf(state);
            for (int lane = 0; lane < kLanes; ++lane)
                batch.firstBody[lane] = state.dolls[batch.doll[lane < batch.used ? lane : 0]].firstBody;
            for (int body = 0; body < static_cast<int>(batch.bodies.size()); ++body) {
                const auto isPaired = [&](int first) { return state.isPaired[first + body] != 0; };
                if (std::any_of(std::begin(batch.firstBody), std::end(batch.firstBody), isPaired))
                    batch.paired.push_back(body);
            }
        }
    });
}

}  // namespace

bool isHeap(const Job& job) {
    const auto isJointed = [](const Topology* topology) { return !topology->joints.empty(); };
    return std::count_if(job.topologies.begin(), job.topologies.end(), isJointed) > 1;
}

void makeJobs(CrowdState& state) {
    assignBatches(state);
    findPaired(state);
    for (DragRecord& record : state.drags) {
        const Doll& doll = state.dolls[record.doll];
        state.jobs[state.batchOf(doll).job].drags.push_back(&record);
    }
    const auto jobOf = [&](int doll) -> Job& { return state.jobs[state.batchOf(state.dolls[doll]).job]; };
    for (const ForceRecord& record : state.forces)
        jobOf(record.doll).forces.push_back(&record);
    for (std::size_t i = 0; i < state.jobCount; ++i)
        setSubsteps(state, state.jobs[i]);
    const auto takeUsual = [&](Job& job) { job.substeps = std::max(job.substeps, state.stepSubsteps.usual); };
    // A muscle or pull at its bound works against what may give way at once, however calm the doll is yet.
    for (const MotorRecord& record : state.motors)
        if (record.bounded && !state.dolls[record.doll].asleep()) takeUsual(jobOf(record.doll));
    for (const DragRecord& record : state.drags)
        if (record.bounded) takeUsual(jobOf(record.doll));
    partTouches(state);
    packTouches(state);
}

}  // namespace lutka::physics::crowd
