#include "physics/crowd/substeps.hpp"

#include <algorithm>

#include "physics/crowd/jobs.hpp"

namespace lutka::physics::crowd {
namespace {

void scale(Wide& wide, const Wide& by) {
    for (int lane = 0; lane < kLanes; ++lane)
        wide.lane[lane] *= by.lane[lane];
}
void scale(Wide3& wide, const Wide& by) {
    scale(wide.x, by);
    scale(wide.y, by);
    scale(wide.z, by);
}

bool isOne(const Wide& wide) {
    return std::all_of(std::begin(wide.lane), std::end(wide.lane), [](float value) { return value == 1.0F; });
}

void fitPairs(CrowdState& state, const PairPart& part, float seconds) {
    const auto first = static_cast<std::size_t>(part.view.first);
    for (std::size_t block = first; block < first + static_cast<std::size_t>(part.view.count); ++block) {
        const std::array<int, kLanes>& touches = state.touchOfLane[block];
        Wide by;
        for (int lane = 0; lane < kLanes; ++lane) {
            // Both dolls were in one job when they touched.
            const int index = touches[lane] >= 0 ? touches[lane] : touches[0];
            by.lane[lane] = seconds / state.dolls[state.briefs[index].dollA].substepSeconds;
        }
        if (isOne(by)) continue;
        scale(state.pairs[block].normalImpulse, by);
        scale(state.pairs[block].tangent, by);
    }
}

void fitBatch(CrowdState& state, Batch& batch, float seconds) {
    Wide by;
    for (int lane = 0; lane < kLanes; ++lane)
        by.lane[lane] = seconds / state.dolls[batch.doll[lane < batch.used ? lane : 0]].substepSeconds;
    for (int lane = 0; lane < batch.used; ++lane)
        state.dolls[batch.doll[lane]].substepSeconds = seconds;
    if (isOne(by)) return;
    for (StaticContactLanes& contact : batch.contacts) {
        scale(contact.normalImpulse, by);
        scale(contact.frictionImpulse, by);
        scale(contact.rollImpulse, by);
    }
    for (JointLanes& joint : batch.joints) {
        scale(joint.frictionImpulse, by);
        scale(joint.hinge.impulse, by);
        for (LimitRow& limit : joint.limit)
            scale(limit.impulse, by);
    }
}

}  // namespace

void findPace(const CrowdState& state, Batch& batch, const Topology& topology) {
    constexpr float kStill = 0.2F;  // of the speeds that ask for a substep
    const CrowdTuning& tuning = state.tuning;
    Wide speed2;
    Wide turn2;
    state.kernels->findMotion(batch.view(topology), speed2, turn2);
    const float unit2 = tuning.substepSpeed * tuning.substepSpeed;
    const float turnUnit2 = tuning.substepTurn * tuning.substepTurn;
    float units2 = 0.0F;
    for (int lane = 0; lane < batch.used; ++lane)
        units2 = std::max({units2, speed2.lane[lane] / unit2, turn2.lane[lane] / turnUnit2});
    batch.isStill = units2 < kStill * kStill;
    batch.substeps = std::min(tuning.calmSubsteps, tuning.substeps);
    while (batch.substeps < tuning.substeps && static_cast<float>(batch.substeps * batch.substeps) < units2)
        ++batch.substeps;
}

void setSubsteps(const CrowdState& state, Job& job) {
    const int all = state.tuning.substeps;
    job.substeps = job.forces.empty() ? 1 : all;
    for (const Batch* batch : job.batches)
        job.substeps = std::max(job.substeps, batch->targets.empty() ? batch->substeps : all);
}

void fitImpulses(CrowdState& state, Job& job, float seconds) {
    forParts(state, job, [&](const PairPart& part) { fitPairs(state, part, seconds); });
    forBatches(state, job, [&](std::size_t i) { fitBatch(state, *job.batches[i], seconds); });
}

}  // namespace lutka::physics::crowd
