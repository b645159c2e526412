#include "physics/crowd/state.hpp"

#include <algorithm>
#include <atomic>
#include <glm/common.hpp>

#include "core/assert.hpp"
#include "physics/crowd/substeps.hpp"

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

void CarriedPairs::renew(std::size_t count) {
    std::size_t size = 16;
    while (size < 2 * count)
        size *= 2;
    keys_.assign(size, 0);
    pushes_.resize(size);
}

void CarriedPairs::add(const CarriedContact& contact) {
    const std::size_t size = keys_.size();
    std::size_t at = slotOf(contact.key, size);
    for (std::uint64_t there = 0;
         !std::atomic_ref(keys_[at]).compare_exchange_strong(there, contact.key, std::memory_order_relaxed); there = 0)
        at = (at + 1) & (size - 1);
    pushes_[at] = static_cast<const CarriedPush&>(contact);
}

const CarriedPush* CarriedPairs::find(std::uint64_t key) const {
    if (keys_.empty()) return nullptr;
    std::size_t at = slotOf(key, keys_.size());
    while (keys_[at] != 0) {
        if (keys_[at] == key) return &pushes_[at];
        at = (at + 1) & (keys_.size() - 1);
    }
    return nullptr;
}

int addDoll(CrowdState& state, Topology topology, const RagdollProfile* profile, std::span<const BodyState> bodies) {
    Doll doll;
    doll.profile = profile;
    doll.group = groupFor(state, topology);
    if (profile != nullptr) doll.pace = paceOf(profile->heightM);
    doll.frozen.assign(bodies.begin(), bodies.end());
    doll.boxes = (static_cast<int>(bodies.size()) + kLanes - 1) / kLanes;
    auto place = std::find_if(state.dolls.begin(), state.dolls.end(),
                              [&](const Doll& other) { return other.removed && other.frozen.size() == bodies.size(); });
    if (place == state.dolls.end()) {
        doll.firstBody = state.bodyTotal;
        doll.firstBox = state.boxTotal;
        state.bodyTotal += static_cast<int>(bodies.size());
        state.boxTotal += doll.boxes;
        place = state.dolls.insert(place, Doll{});
    } else {
        doll.firstBody = place->firstBody;
        doll.firstBox = place->firstBox;
    }
    const int index = static_cast<int>(place - state.dolls.begin());
    *place = std::move(doll);
    state.sweep.push_back(index);
    wake(state, index);
    return index;
}

BodyState bodyState(const CrowdState& state, const Doll& doll, int body) {
    if (doll.asleep()) return doll.frozen[body];
    return readBody(state.batchOf(doll).bodies[body], doll.lane);
}

namespace {

PlacedShape placedMain(const CrowdState& state, const Doll& doll, int body) {
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

}  // namespace

PlacedShape placedShape(const CrowdState& state, const Doll& doll, int body, int shape) {
    PlacedShape main = placedMain(state, doll, body);
    if (shape == 0) return main;
    const AddedShape& added = state.groupOf(doll).topology.shapes[body].more[shape - 1];
    return {&added, main.position + main.axes * added.bodyFromShape.translation,
            main.axes * glm::mat3_cast(added.bodyFromShape.rotation)};
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
    awaken(batch.rest, doll.lane);
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

namespace {

// Where a doll lies, as the kernels' bounds of an awake one.
void boundFrozen(const CrowdState& state, Doll& doll) {
    doll.low = vec3(1e30F);
    doll.high = vec3(-1e30F);
    for (int i = 0; i < state.groupOf(doll).topology.bodyCount(); ++i) {
        const BodyConstants& body = state.groupOf(doll).topology.bodies[i];
        const RigidTransform& at = doll.frozen[i].worldFromBody;
        const mat3 axes = glm::mat3_cast(at.rotation);
        const vec3 half = glm::abs(axes[0]) * body.extent[0] + glm::abs(axes[1]) * body.extent[1] +
                          glm::abs(axes[2]) * body.extent[2] + body.radius + state.tuning.pairMargin;
        doll.low = glm::min(doll.low, at.translation - half);
        doll.high = glm::max(doll.high, at.translation + half);
        for (int shape = 1; shape < state.groupOf(doll).topology.shapeCount(i); ++shape) {
            const PlacedShape placed = placedShape(state, doll, i, shape);
            const vec3 extent = halfBounds(placed) + state.tuning.pairMargin;
            doll.low = glm::min(doll.low, placed.position - extent);
            doll.high = glm::max(doll.high, placed.position + extent);
        }
    }
}

// The last doll of the group takes the lane that becomes free.
void leaveLane(CrowdState& state, int index) {
    Doll& doll = state.dolls[index];
    LUTKA_ASSERT(!doll.asleep());
    Group& group = state.groupOf(doll);
    Batch& batch = group.batches[doll.batch];
    readLane(batch, doll.lane, doll.frozen);
    --group.awake;
    Batch& lastBatch = group.batches[group.awake / kLanes];
    const int lastLane = group.awake % kLanes;
    Doll& last = state.dolls[lastBatch.doll[lastLane]];
    lastBatch.used = lastLane;
    if (&last != &doll) {
        copyLane(lastBatch, lastLane, batch, doll.lane);
        batch.doll[doll.lane] = lastBatch.doll[lastLane];
        copyRest(lastBatch.rest, lastLane, batch.rest, doll.lane);
        last.batch = doll.batch;
        last.lane = doll.lane;
    }
    doll.batch = -1;
}

}  // namespace

void putToSleep(CrowdState& state, int index) {
    leaveLane(state, index);
    Doll& doll = state.dolls[index];
    for (BodyState& body : doll.frozen)
        body.linearVelocity = body.angularVelocity = vec3(0);
    boundFrozen(state, doll);
}

namespace {

void carryAgain(CrowdState& state) {
    state.carried.renew(state.touches.size());
    for (const PairTouch& touch : state.touches)
        if (touch.carried.normal > 0.0F) state.carried.add(touch.carried);
}

}  // namespace

void removeDoll(CrowdState& state, int index) {
    if (state.dolls[index].asleep()) wakeIsland(state, index);
    leaveLane(state, index);
    const auto touches = [&](const PairTouch& touch) { return touch.dollA == index || touch.dollB == index; };
    state.touches.removeIf(touches);
    carryAgain(state);  // a doll in the same place must not inherit them
    std::erase(state.sweep, index);
    std::erase_if(state.motors, [&](const MotorRecord& record) { return record.doll == index; });
    state.dolls[index].motors = 0;
    std::erase_if(state.targets, [&](const TargetRecord& record) { return record.doll == index; });
    std::erase_if(state.forces, [&](const ForceRecord& record) { return record.doll == index; });
    Doll& doll = state.dolls[index];
    doll.profile = nullptr;
    doll.removed = true;
    doll.statics.clear();
}

void gatherActive(CrowdState& state) {
    state.active.clear();
    state.activeGroup.clear();
    for (const auto& group : state.groups) {
        for (int i = 0; i < group->batchesInUse(); ++i) {
            Batch& batch = group->batches[i];
            for (int lane = batch.used; lane < kLanes; ++lane) {
                copyLane(batch, 0, batch, lane);
                copyRest(batch.rest, 0, batch.rest, lane);
            }
            state.active.push_back(&batch);
            state.activeGroup.push_back(group.get());
        }
    }
}

}  // namespace lutka::physics::crowd
