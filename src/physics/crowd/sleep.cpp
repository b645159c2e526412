#include "physics/crowd/sleep.hpp"

#include <algorithm>
#include <cmath>

namespace lutka::physics::crowd {
namespace {

// Rest times and brakes of one batch's dolls.
void measureRest(CrowdState& state, Batch& batch, const Topology& topology, float dt) {
    const CrowdTuning& tuning = state.tuning;
    Wide speed2;
    Wide turn2;
    state.kernels->findMotion(batch.view(topology), speed2, turn2);
    for (int lane = 0; lane < batch.used; ++lane) {
        Doll& doll = state.dolls[batch.doll[lane]];
        const bool still = speed2.lane[lane] < tuning.sleepSpeed * tuning.sleepSpeed &&
                           turn2.lane[lane] < tuning.sleepTurn * tuning.sleepTurn;
        doll.restSeconds = still ? doll.restSeconds + dt : 0.0F;
        // The brake fades in below the calm speed, so that nothing changes abruptly.
        const float speed = std::sqrt(std::max(speed2.lane[lane], turn2.lane[lane] * 0.04F));
        const float share = doll.touching ? std::clamp(1.0F - speed / tuning.calmSpeed, 0.0F, 1.0F) : 0.0F;
        batch.rest.brake.lane[lane] = tuning.calmDamping * share;
        batch.rest.stiction.lane[lane] = 1.0F + (tuning.stiction - 1.0F) * share;
    }
}

}  // namespace

void settle(CrowdState& state, float dt) {
    for (const TouchBrief& brief : state.briefs) {
        if (!brief.presses || brief.dollA == brief.dollB) continue;
        state.dolls[brief.dollA].touching = state.dolls[brief.dollB].touching = true;
    }
    state.inParallel(state.active.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            measureRest(state, *state.active[i], state.activeGroup[i]->topology, dt);
    });
    if (!state.settings.sleeping) return;

    UnionFind& islands = state.scratch.sets;
    islands.reset(state.dolls.size());
    for (const TouchBrief& brief : state.briefs)
        if (brief.presses) islands.join(brief.dollA, brief.dollB);
    std::vector<char>& restless = state.scratch.restless;
    restless.assign(state.dolls.size(), 0);
    for (const DragRecord& record : state.drags)
        restless[islands.find(record.doll)] = 1;
    for (const TargetRecord& record : state.targets)
        restless[islands.find(record.doll)] = 1;
    for (int i = 0; i < static_cast<int>(state.dolls.size()); ++i) {
        const Doll& doll = state.dolls[i];
        if (!doll.asleep() && doll.restSeconds < state.tuning.sleepSeconds) restless[islands.find(i)] = 1;
    }
    for (int i = 0; i < static_cast<int>(state.dolls.size()); ++i) {
        const int island = islands.find(i);
        if (state.dolls[i].asleep() || restless[island] != 0) continue;
        putToSleep(state, i);
        state.dolls[i].island = state.nextIsland + island;
    }
    state.nextIsland += static_cast<std::int64_t>(state.dolls.size());
}

}  // namespace lutka::physics::crowd
