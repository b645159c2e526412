#include "physics/crowd/state.hpp"

#include <algorithm>

#include "core/assert.hpp"

namespace lutka::physics::crowd {
namespace {

std::size_t slotOf(std::uint64_t key, std::size_t slots) {
    return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 32U) & (slots - 1);
}

int groupFor(CrowdState& state, Topology& topology) {
    for (std::size_t i = 0; i < state.groups.size(); ++i) {
        if (sameTopology(state.groups[i]->topology, topology)) return static_cast<int>(i);
    }
    state.groups.push_back(std::make_unique<Group>());
    state.groups.back()->topology = std::move(topology);
    return static_cast<int>(state.groups.size()) - 1;
}

}  // namespace

CrowdState::CrowdState(const WorldSettings& given, const CrowdTuning& tuned)
    : settings(given),
      tuning(tuned),
      kernels(&kernelsOf(tuned.instructionSet.value_or(bestInstructionSet()))),
      pool(given.threads) {}

void CarriedPairs::assign(const std::vector<PairTouch>& touches) {
    std::size_t size = 16;
    while (size < 2 * touches.size())
        size *= 2;
    slots_.assign(size, {});
    for (const PairTouch& touch : touches) {
        if (touch.carried.normal <= 0.0F) continue;
        std::size_t at = slotOf(touch.carried.key, size);
        while (slots_[at].key != 0)
            at = (at + 1) & (size - 1);
        slots_[at] = touch.carried;
    }
}

const CarriedContact* CarriedPairs::find(std::uint64_t key) const {
    if (slots_.empty()) return nullptr;
    std::size_t at = slotOf(key, slots_.size());
    while (slots_[at].key != 0) {
        if (slots_[at].key == key) return &slots_[at];
        at = (at + 1) & (slots_.size() - 1);
    }
    return nullptr;
}

int addDoll(CrowdState& state, Topology topology, const RagdollProfile* profile, std::span<const BodyState> bodies) {
    Doll doll;
    doll.profile = profile;
    doll.group = groupFor(state, topology);
    doll.firstBody = state.bodyTotal;
    doll.frozen.assign(bodies.begin(), bodies.end());
    doll.firstBox = state.boxTotal;
    doll.boxes = (static_cast<int>(bodies.size()) + kLanes - 1) / kLanes;
    state.bodyTotal += static_cast<int>(bodies.size());
    state.boxTotal += doll.boxes;
    state.dolls.push_back(std::move(doll));
    const int index = static_cast<int>(state.dolls.size()) - 1;
    state.sweep.push_back(index);
    wake(state, index);
    return index;
}

BodyState bodyState(const CrowdState& state, const Doll& doll, int body) {
    if (doll.asleep()) return doll.frozen[body];
    return readBody(state.batchOf(doll).bodies[body], doll.lane);
}

PlacedShape placedShape(const CrowdState& state, const Doll& doll, int body) {
    const BodyShape* shape = &state.groupOf(doll).topology.shapes[body];
    if (doll.asleep()) {
        const RigidTransform& at = doll.frozen[body].worldFromBody;
        return {shape, at.translation, glm::mat3_cast(at.rotation)};
    }
    const BodyLanes& lanes = state.batchOf(doll).bodies[body];
    return {shape, readVector(lanes.position, doll.lane),
            mat3(readVector(lanes.axisX, doll.lane), readVector(lanes.axisY, doll.lane),
                 readVector(lanes.axisZ, doll.lane))};
}

void wake(CrowdState& state, int index) {
    Doll& doll = state.dolls[index];
    LUTKA_ASSERT(doll.asleep());
    Group& group = state.groupOf(doll);
    doll.batch = group.awake / kLanes;
    doll.lane = group.awake % kLanes;
    ++group.awake;
    if (doll.batch == static_cast<int>(group.batches.size())) group.batches.emplace_back(group.topology);
    Batch& batch = group.batches[doll.batch];
    batch.doll[doll.lane] = index;
    batch.used = doll.lane + 1;
    batch.brake.lane[doll.lane] = 1.0F;
    writeLane(batch, doll.lane, doll.frozen);
    clearImpulses(batch, doll.lane);
    for (int lane = doll.lane + 1; lane < kLanes; ++lane)
        copyLane(batch, doll.lane, batch, lane);
    state.kernels->refresh(batch.view(group.topology));
    doll.restSeconds = 0.0F;
    doll.island = -1;
    doll.statics.clear();
}

void wakeIsland(CrowdState& state, int index) {
    const std::int64_t island = state.dolls[index].island;
    wake(state, index);
    if (island < 0) return;
    for (std::size_t i = 0; i < state.dolls.size(); ++i) {
        if (state.dolls[i].asleep() && state.dolls[i].island == island) wake(state, static_cast<int>(i));
    }
}

void putToSleep(CrowdState& state, int index) {
    Doll& doll = state.dolls[index];
    LUTKA_ASSERT(!doll.asleep());
    Group& group = state.groupOf(doll);
    Batch& batch = group.batches[doll.batch];
    readLane(batch, doll.lane, doll.frozen);
    for (BodyState& body : doll.frozen)
        body.linearVelocity = body.angularVelocity = vec3(0);
    --group.awake;
    Batch& lastBatch = group.batches[group.awake / kLanes];
    const int lastLane = group.awake % kLanes;
    Doll& last = state.dolls[lastBatch.doll[lastLane]];
    lastBatch.used = lastLane;
    if (&last != &doll) {
        copyLane(lastBatch, lastLane, batch, doll.lane);
        batch.doll[doll.lane] = lastBatch.doll[lastLane];
        batch.brake.lane[doll.lane] = lastBatch.brake.lane[lastLane];
        last.batch = doll.batch;
        last.lane = doll.lane;
    }
    doll.batch = -1;
}

void gatherActive(CrowdState& state) {
    state.active.clear();
    state.activeGroup.clear();
    for (const auto& group : state.groups) {
        for (int i = 0; i < group->batchesInUse(); ++i) {
            Batch& batch = group->batches[i];
            for (int lane = batch.used; lane < kLanes; ++lane) {
                copyLane(batch, 0, batch, lane);
                batch.brake.lane[lane] = batch.brake.lane[0];
            }
            state.active.push_back(&batch);
            state.activeGroup.push_back(group.get());
        }
    }
}

}  // namespace lutka::physics::crowd
