#include "physics/crowd/target.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <tuple>

#include "physics/crowd/firmest_row.hpp"

namespace lutka::physics::crowd {
namespace {

bool isBefore(const TargetRecord& record, std::pair<int, int> wanted) {
    return std::pair(record.doll, record.body) < wanted;
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
    const FirmestRow firmest = firmestRow(topology);
    const bool kinematic = target.weight >= 1.0F;
    lanes.kinematic.lane[lane] = kinematic ? 1.0F : 0.0F;
    if (kinematic) {
        lanes.weight.lane[lane] = firmest.massKg;
        lanes.turnWeight.lane[lane] = firmest.moment;
        lanes.pull.lane[lane] = 1.0F / dt;
        return;
    }
    // The critically damped spring at the substep's end, as in motor_kernels.hpp.
    const BodyConstants& constants = topology.bodies[body];
    const float omega = 2.0F * kPi * frequencyOf(target.weight);
    const float answer = dt * omega * (dt * omega + 2.0F);
    const float moment = std::max({constants.inertia[0], constants.inertia[1], constants.inertia[2]});
    lanes.weight.lane[lane] = std::min(answer / constants.inverseMass, firmest.massKg);
    lanes.turnWeight.lane[lane] = std::min(answer * moment, firmest.moment);
    lanes.pull.lane[lane] = omega / (dt * omega + 2.0F);
}

// A kinematic body that is let go of goes on as its frame moved. Its lanes have, besides, a part of what gravity gave
// it in the last substep: its row is heavy, and not infinitely so.
void letGo(CrowdState& state, const TargetRecord& record) {
    if (!record.followed || record.followed->weight < 1.0F) return;
    const Doll& doll = state.dolls[record.doll];
    BodyLanes& body = state.batchOf(doll).bodies[record.body];
    writeVector(body.velocity, doll.lane, record.followed->linearVelocity);
    writeVector(body.angular, doll.lane, record.followed->angularVelocity);
}

}  // namespace

void placeTargets(CrowdState& state, float dt) {
    for (const auto& group : state.groups)
        for (Batch& batch : group->batches)
            batch.targets.clear();
    for (TargetRecord& record : state.targets) {
        record.followed = record.target;
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

double workOfPushes(const CrowdState& state, const Job& job) {
    double work = 0.0;
    // What one side gives the other: the impulse on `other` times how the point of a kinematic body moves.
    const auto pushes = [&](int doll, int body, const vec3& arm, const vec3& impulse) {
        const Doll& kinematic = state.dolls[doll];
        const Batch& batch = state.batchOf(kinematic);
        const int lane = kinematic.lane;
        if (!isKinematic(batch, body, lane)) return;
        const TargetLanes& target = batch.targets[body];
        const vec3 velocity = readVector(target.before, lane) + readVector(batch.bodies[body].steadyVelocity, lane);
        const vec3 angular = readVector(target.turnBefore, lane) + readVector(batch.bodies[body].steadyAngular, lane);
        work += static_cast<double>(0.5F * glm::dot(impulse, velocity + glm::cross(angular, arm)));
    };
    for (std::size_t block = job.firstBlock; block < job.firstBlock + job.blockCount; ++block) {
        const PairContactLanes& pair = state.pairs[block];
        for (int lane = 0; lane < kLanes; ++lane) {
            const int index = state.touchOfLane[block][lane];
            const float pressed = pair.normalImpulse.lane[lane];
            if (index < 0 || pressed <= 0.0F) continue;
            const PairTouch& touch = state.touches[index];
            const vec3 onA = readVector(pair.normal, lane) * pressed + frictionOf(pair, lane);
            pushes(touch.dollA, touch.bodyA, readVector(pair.armA, lane), -onA);
            pushes(touch.dollB, touch.bodyB, readVector(pair.armB, lane), onA);
        }
    }
    return work;
}

bool isKinematic(const Batch& batch, int body, int lane) {
    return !batch.targets.empty() && batch.targets[body].kinematic.lane[lane] > 0.0F;
}

void setTarget(CrowdState& state, int doll, int body, const std::optional<BodyTarget>& target) {
    auto at = std::lower_bound(state.targets.begin(), state.targets.end(), std::pair(doll, body), isBefore);
    const bool known = at != state.targets.end() && at->doll == doll && at->body == body;
    if (known && (!target || target->weight < 1.0F)) letGo(state, *at);
    if (!target) {
        if (known) state.targets.erase(at);
        return;
    }
    if (!known) at = state.targets.insert(at, TargetRecord{doll, body, {}, {}});
    at->target = *target;
}

}  // namespace lutka::physics::crowd
