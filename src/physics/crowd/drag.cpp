#include "physics/crowd/drag.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace lutka::physics::crowd {
namespace {

constexpr float kHertz = 12.0F;  // follows a hand within a tenth of a second
constexpr float kDamping = 1.0F;

struct DraggedBody {
    BodyLanes& lanes;
    int lane;
    float inverseMass;
};
DraggedBody draggedBody(CrowdState& state, const DragRecord& record) {
    Doll& doll = state.dolls[state.ragdolls[record.drag.doll]];
    const int body = record.drag.body;
    return {state.batchOf(doll).bodies[body], doll.lane, state.groupOf(doll).topology.bodies[body].inverseMass};
}

mat3 worldInertia(const DraggedBody& body) {
    const WideSymmetric& m = body.lanes.inverseInertia;
    const int l = body.lane;
    return {m.xx.lane[l], m.xy.lane[l], m.xz.lane[l], m.xy.lane[l], m.yy.lane[l],
            m.yz.lane[l], m.xz.lane[l], m.yz.lane[l], m.zz.lane[l]};
}

vec3 pointVelocity(const DraggedBody& body, const vec3& arm) {
    return readVector(body.lanes.velocity, body.lane) + glm::cross(readVector(body.lanes.angular, body.lane), arm);
}

double apply(const DraggedBody& body, const vec3& arm, const vec3& impulse) {
    const vec3 before = pointVelocity(body, arm);
    writeVector(body.lanes.velocity, body.lane,
                readVector(body.lanes.velocity, body.lane) + impulse * body.inverseMass);
    writeVector(body.lanes.angular, body.lane,
                readVector(body.lanes.angular, body.lane) + worldInertia(body) * glm::cross(arm, impulse));
    return static_cast<double>(glm::dot(impulse, 0.5F * (before + pointVelocity(body, arm))));
}

mat3 crossMatrix(const vec3& v) {
    return {0, v.z, -v.y, -v.z, 0, v.x, v.y, -v.x, 0};
}

}  // namespace

double beginDrag(CrowdState& state, DragRecord& record) {
    const DraggedBody body = draggedBody(state, record);
    const mat3 axes(readVector(body.lanes.axisX, body.lane), readVector(body.lanes.axisY, body.lane),
                    readVector(body.lanes.axisZ, body.lane));
    record.arm = axes * record.drag.bodyPoint;
    record.error = readVector(body.lanes.position, body.lane) + record.arm - record.drag.worldTarget;
    const mat3 arm = crossMatrix(record.arm);
    record.mass = glm::inverse(mat3(body.inverseMass) - arm * worldInertia(body) * arm);
    return apply(body, record.arm, record.impulse);
}

double solveDrag(CrowdState& state, DragRecord& record, float dt) {
    const DraggedBody body = draggedBody(state, record);
    const float omega = 2.0F * kPi * kHertz;
    const float a = 2.0F * kDamping + dt * omega;
    const float b = dt * omega * a;
    const float scale = 1.0F / (1.0F + b);
    const vec3 rate = pointVelocity(body, record.arm) + record.error * (omega / a);
    vec3 total = record.impulse - record.mass * rate * (b * scale) - record.impulse * scale;
    const float limit = record.drag.maxForceN * dt;
    const float size = glm::length(total);
    if (size > limit) total *= limit / size;
    const vec3 change = total - record.impulse;
    record.impulse = total;
    return apply(body, record.arm, change);
}

}  // namespace lutka::physics::crowd
