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

float paceOf(float heightM) {
    constexpr float kTunedM = 0.75F;
    constexpr float kLeast = 0.25F;
    return std::clamp(heightM / kTunedM, kLeast, 1.0F);
}

void findPace(const CrowdState& state, Batch& batch, const Topology& topology) {
    constexpr float kStill = 0.2F;  // of the speeds that ask for a substep
    const CrowdTuning& tuning = state.tuning;
    Wide speed2;
    Wide turn2;
    state.kernels->findMotion(batch.view(topology), speed2, turn2);
    const float unit2 = tuning.substepSpeed * tuning.substepSpeed;
    const float turnUnit2 = tuning.substepTurn * tuning.substepTurn;
    batch.isStill = true;
    batch.substeps = 0;
    for (int lane = 0; lane < batch.used; ++lane) {
        const float pace = state.dolls[batch.doll[lane]].pace;
        const float units2 = std::max(speed2.lane[lane] / unit2, turn2.lane[lane] / turnUnit2) / (pace * pace);
        const bool isStill = units2 < kStill * kStill;
        int& substeps = batch.substepsOf[lane];
        // What lies still and may not fall asleep is cheap in this way; where it may, it would only come to rest later.
        // Muscles may begin to move it at once.
        const bool rests = isStill && !state.settings.sleeping && state.dolls[batch.doll[lane]].motors == 0;
        substeps = std::min(rests ? tuning.restSubsteps : tuning.calmSubsteps, tuning.substeps);
        while (substeps < tuning.substeps && static_cast<float>(substeps * substeps) < units2)
            ++substeps;
        batch.isStill = batch.isStill && isStill;
        batch.substeps = std::max(batch.substeps, substeps);
    }
}

void setSubsteps(CrowdState& state, Job& job) {
    const CrowdTuning& tuning = state.tuning;
    const int all = tuning.substeps;
    job.substeps = job.forces.empty() ? 1 : all;
    // A pull may begin to move what lies still.
    if (!job.drags.empty()) job.substeps = std::max(job.substeps, std::min(tuning.calmSubsteps, all));
    int dolls = 0;  // without props
    bool isDriven = !job.drags.empty();
    std::vector<int>& needing = state.scratch.needing;
    needing.assign(static_cast<std::size_t>(all) + 1, 0);
    for (std::size_t i = 0; i < job.batches.size(); ++i) {
        const Batch& batch = *job.batches[i];
        if (!batch.targets.empty()) job.substeps = all;
        dolls += job.topologies[i]->joints.empty() ? 0 : batch.used;
        for (int lane = 0; lane < batch.used; ++lane) {
            ++needing[batch.substepsOf[lane]];
            isDriven = isDriven || state.dolls[batch.doll[lane]].motors > 0;
        }
    }
    // One hand that twitches in a heap at rest would have all of it take twice the time. But where dolls lie deep in
    // each other, all substeps are needed to push them apart, and what muscles and pulls drive needs its own.
    const bool spares =
        isHeap(job) && !isDriven &&
        static_cast<float>(job.deepTouches) <= tuning.deepShare * static_cast<float>(job.touches.size());
    int left = spares ? static_cast<int>(tuning.spared * static_cast<float>(dolls)) : 0;
    int more = 0;  // dolls that need more than one substep less
    for (int substeps = all; substeps > job.substeps; --substeps) {
        more += needing[substeps];
        left -= more;
        if (left < 0) job.substeps = substeps;
    }
}

void fitImpulses(CrowdState& state, Job& job, float seconds) {
    forParts(state, job, [&](const PairPart& part) { fitPairs(state, part, seconds); });
    forBatches(state, job, [&](std::size_t i) { fitBatch(state, *job.batches[i], seconds); });
}

}  // namespace lutka::physics::crowd
