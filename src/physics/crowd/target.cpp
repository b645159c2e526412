#include "physics/crowd/target.hpp"

#include <algorithm>
#include <tuple>

namespace lutka::physics::crowd {
namespace {

// Of a kinematic body, over its doll's mass: so much that what hangs on it moves it by some micrometres a substep,
// which the next one takes back, and so little that floats still hold a hand beside it.
constexpr float kHeavy = 200.0F;

bool isBefore(const TargetRecord& record, std::pair<int, int> wanted) {
    return std::pair(record.doll, record.body) < wanted;
}

// Mass of a doll, and the longest of its bodies: the arm that its weight may turn a body at.
struct Size {
    float massKg = 0.0F;
    float reach = 0.0F;
};
Size sizeOf(const Topology& topology) {
    Size size;
    for (const BodyConstants& body : topology.bodies) {
        size.massKg += 1.0F / body.inverseMass;
        size.reach = std::max(size.reach, body.reach + body.radius);
    }
    return size;
}

void writeLanes(TargetLanes& lanes, int lane, const BodyTarget& target, const Topology& topology, int body, float dt) {
    lanes.active = 1;
    const quat turn = glm::normalize(target.worldFromBody.rotation);
    writeVector(lanes.position, lane, target.worldFromBody.translation);
    writeVector(lanes.rate, lane, target.linearVelocity);
    writeVector(lanes.turnRate, lane, target.angularVelocity);
    lanes.rotation.x.lane[lane] = turn.x;
    lanes.rotation.y.lane[lane] = turn.y;
    lanes.rotation.z.lane[lane] = turn.z;
    lanes.rotation.w.lane[lane] = turn.w;
    const Size size = sizeOf(topology);
    const float heavy = kHeavy * size.massKg;
    const bool kinematic = target.weight >= 1.0F;
    lanes.kinematic.lane[lane] = kinematic ? 1.0F : 0.0F;
    if (kinematic) {
        lanes.weight.lane[lane] = heavy;
        lanes.turnWeight.lane[lane] = heavy * size.reach * size.reach;
        lanes.pull.lane[lane] = 1.0F / dt;
        return;
    }
    // The critically damped spring at the substep's end, as in motor_kernels.hpp.
    const BodyConstants& constants = topology.bodies[body];
    const float omega = 2.0F * kPi * frequencyOf(target.weight);
    const float answer = dt * omega * (dt * omega + 2.0F);
    const float moment = std::max({constants.inertia[0], constants.inertia[1], constants.inertia[2]});
    lanes.weight.lane[lane] = std::min(answer / constants.inverseMass, heavy);
    lanes.turnWeight.lane[lane] = std::min(answer * moment, heavy * size.reach * size.reach);
    lanes.pull.lane[lane] = omega / (dt * omega + 2.0F);
}

}  // namespace

void placeTargets(CrowdState& state, float dt) {
    for (const auto& group : state.groups)
        for (Batch& batch : group->batches)
            batch.targets.clear();
    for (const TargetRecord& record : state.targets) {
        const Doll& doll = state.dolls[record.doll];
        Batch& batch = state.batchOf(doll);
        const Topology& topology = state.groupOf(doll).topology;
        if (batch.targets.empty()) batch.targets.resize(topology.bodies.size());  // of zeros
        writeLanes(batch.targets[record.body], doll.lane, record.target, topology, record.body, dt);
    }
}

double workOfTargets(const Batch& batch) {
    double work = 0.0;
    for (const TargetLanes& target : batch.targets)
        for (int lane = 0; target.active != 0 && lane < batch.used; ++lane)
            work += static_cast<double>(target.work.lane[lane]);
    return work;
}

bool isKinematic(const Batch& batch, int body, int lane) {
    return !batch.targets.empty() && batch.targets[body].kinematic.lane[lane] > 0.0F;
}

void setTarget(CrowdState& state, int doll, int body, const std::optional<BodyTarget>& target) {
    auto at = std::lower_bound(state.targets.begin(), state.targets.end(), std::pair(doll, body), isBefore);
    const bool known = at != state.targets.end() && at->doll == doll && at->body == body;
    if (!target) {
        if (known) state.targets.erase(at);
        return;
    }
    if (!known) at = state.targets.insert(at, TargetRecord{doll, body, {}});
    at->target = *target;
}

}  // namespace lutka::physics::crowd
