#include "physics/crowd/substeps.hpp"

#include <algorithm>
#include <cmath>

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

StepSubsteps substepsFor(const CrowdState& state, float dt) {
    constexpr float kRounding = 0.01F;  // substeps
    constexpr int kMost = 64;
    const CrowdTuning& tuning = state.tuning;
    const bool isTold = state.settings.substeps.has_value();
    const auto scaled = [&](int substeps) {
        const float wanted = std::ceil(static_cast<float>(substeps) * dt * tuning.rate - kRounding);
        return static_cast<int>(std::clamp(wanted, 1.0F, static_cast<float>(kMost)));
    };
    StepSubsteps found;
    found.usual = isTold ? tuning.substeps : scaled(tuning.substeps);
    found.calm = std::min(scaled(tuning.calmSubsteps), found.usual);
    found.rest = std::min(scaled(tuning.restSubsteps), found.usual);
    found.most = isTold ? found.usual : std::min(tuning.fastSubsteps * found.usual, kMost);
    return found;
}

void findPace(const CrowdState& state, Batch& batch, const Topology& topology, float dt) {
    constexpr float kStill = 0.2F;  // of the speeds that ask for a substep
    const StepSubsteps& step = state.stepSubsteps;
    const CrowdTuning& tuning = state.tuning;
    const float frames = dt * tuning.rate;  // that long is the step
    Wide speed2;
    Wide turn2;
    state.kernels->findMotion(batch.view(topology), speed2, turn2);
    const float unit2 = tuning.substepSpeed * tuning.substepSpeed;
    const float turnUnit2 = tuning.substepTurn * tuning.substepTurn;
    batch.isStill = true;
    batch.substeps = 0;
    for (int lane = 0; lane < batch.used; ++lane) {
        const float pace = state.dolls[batch.doll[lane]].pace;
        const float scale = frames / pace;
        const float way2 = speed2.lane[lane] / unit2 * (scale * scale);
        const float turned2 = turn2.lane[lane] / turnUnit2 * (scale * scale);
        const float units2 = std::max(way2, turned2);
        const bool isStill = units2 < kStill * kStill;
        int& substeps = batch.substepsOf[lane];
        // What lies still and may not fall asleep is cheap in this way; where it may, it would only come to rest later.
        // Muscles may begin to move it at once.
        const bool rests = isStill && !state.settings.sleeping && state.dolls[batch.doll[lane]].motors == 0;
        substeps = rests ? step.rest : step.calm;
        while (substeps < step.usual && static_cast<float>(substeps * substeps) < units2)
            ++substeps;
        // What is faster than in any fall needs more, if not in proportion.
        const float fast2 =
            std::max(way2 / (tuning.fastSpeed * tuning.fastSpeed), turned2 / (tuning.fastTurn * tuning.fastTurn));
        while (substeps >= step.usual && substeps < step.most && static_cast<float>(substeps * substeps) < fast2)
            ++substeps;
        batch.isStill = batch.isStill && isStill;
        batch.substeps = std::max(batch.substeps, substeps);
    }
}

void setSubsteps(CrowdState& state, Job& job) {
    const CrowdTuning& tuning = state.tuning;
    const StepSubsteps& step = state.stepSubsteps;
    const bool hasTargets =
        std::any_of(job.batches.begin(), job.batches.end(), [](const Batch* batch) { return !batch->targets.empty(); });
    if (hasTargets) {  // their springs are made for that number
        job.substeps = step.usual;
        return;
    }
    const int all = isHeap(job) ? step.usual : step.most;
    job.substeps = job.forces.empty() ? 1 : step.usual;
    // A pull may begin to move what lies still.
    if (!job.drags.empty()) job.substeps = std::max(job.substeps, step.calm);
    int dolls = 0;  // without props
    bool isDriven = !job.drags.empty();
    std::vector<int>& needing = state.scratch.needing;
    needing.assign(static_cast<std::size_t>(all) + 1, 0);
    for (std::size_t i = 0; i < job.batches.size(); ++i) {
        const Batch& batch = *job.batches[i];
        dolls += job.topologies[i]->joints.empty() ? 0 : batch.used;
        for (int lane = 0; lane < batch.used; ++lane) {
            ++needing[std::min(batch.substepsOf[lane], all)];
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
