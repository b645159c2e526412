#include "physics/crowd/drag.hpp"

#include <glm/geometric.hpp>

namespace lutka::physics::crowd {
namespace {

constexpr float kHertz = 12.0F;  // follows a hand within a tenth of a second
constexpr float kDamping = 1.0F;

// The spring holds the whole doll as stiffly as this frequency says; a limb alone follows without swinging.
float massOf(const Topology& topology) {
    float mass = 0;
    for (const BodyConstants& body : topology.bodies)
        mass += 1.0F / body.inverseMass;
    return mass;
}

Doll& dollOf(CrowdState& state, const DragRecord& record) {
    return state.dolls[record.doll];
}

}  // namespace

void placeDrags(CrowdState& state, float dt) {
    for (Batch* batch : state.active)
        batch->drags.clear();
    const float omega = 2.0F * kPi * kHertz;
    for (DragRecord& record : state.drags) {
        const Doll& doll = dollOf(state, record);
        Batch& batch = state.batchOf(doll);
        record.index = batch.drags.size();
        DragLanes& lanes = batch.drags.emplace_back();  // of zeros
        lanes.body = record.drag.body;
        writeVector(lanes.localPoint, doll.lane, record.drag.bodyPoint);
        writeVector(lanes.target, doll.lane, record.drag.worldTarget);
        writeVector(lanes.rate, doll.lane, record.drag.worldVelocity);
        const float mass = massOf(state.groupOf(doll).topology);
        const float substep = dt / static_cast<float>(state.jobs[batch.job].substeps);
        const float answer = substep * omega * (substep * omega + 2.0F * kDamping);
        lanes.weight.lane[doll.lane] = mass * answer;
        lanes.pull.lane[doll.lane] = substep * omega * omega / answer;
        lanes.bound.lane[doll.lane] = record.drag.maxForceN * substep;
        lanes.gain.lane[doll.lane] = record.bounded ? 0.0F : lanes.weight.lane[doll.lane];
    }
}

void beginDrag(CrowdState& state, DragRecord& record) {
    const Doll& doll = dollOf(state, record);
    const BodyLanes& body = state.batchOf(doll).bodies[record.drag.body];
    const mat3 axes(readVector(body.axisX, doll.lane), readVector(body.axisY, doll.lane),
                    readVector(body.axisZ, doll.lane));
    record.before = readVector(body.velocity, doll.lane) +
                    glm::cross(readVector(body.angular, doll.lane), axes * record.drag.bodyPoint);
}

DragDeed endDrag(CrowdState& state, DragRecord& record) {
    const Doll& doll = dollOf(state, record);
    const Batch& batch = state.batchOf(doll);
    const BodyLanes& body = batch.bodies[record.drag.body];
    const DragLanes& lanes = batch.drags[record.index];
    record.bounded = lanes.gain.lane[doll.lane] == 0.0F;
    const vec3 after = readVector(body.steadyVelocity, doll.lane) +
                       glm::cross(readVector(body.steadyAngular, doll.lane), readVector(lanes.arm, doll.lane));
    const vec3 impulse = readVector(lanes.impulse, doll.lane);
    return {static_cast<double>(glm::dot(impulse, 0.5F * (record.before + after))), impulse};
}

}  // namespace lutka::physics::crowd
