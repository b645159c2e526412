#include "physics/crowd/force.hpp"

#include <glm/geometric.hpp>

namespace lutka::physics::crowd {
namespace {

struct LaneBody {
    BodyLanes& lanes;
    int lane;
    float inverseMass;

    [[nodiscard]] vec3 turn() const { return readVector(lanes.angular, lane); }
    [[nodiscard]] quat rotation() const {
        const Wide4& q = lanes.rotation;
        return {q.w.lane[lane], q.x.lane[lane], q.y.lane[lane], q.z.lane[lane]};
    }
    // World inverse inertia times a vector.
    [[nodiscard]] vec3 turned(const vec3& v) const {
        const WideSymmetric& m = lanes.inverseInertia;
        const int l = lane;
        return {m.xx.lane[l] * v.x + m.xy.lane[l] * v.y + m.xz.lane[l] * v.z,
                m.xy.lane[l] * v.x + m.yy.lane[l] * v.y + m.yz.lane[l] * v.z,
                m.xz.lane[l] * v.x + m.yz.lane[l] * v.y + m.zz.lane[l] * v.z};
    }
};

LaneBody bodyOf(CrowdState& state, const Doll& doll, int body) {
    return {state.batchOf(doll).bodies[body], doll.lane, state.groupOf(doll).topology.bodies[body].inverseMass};
}

}  // namespace

double applyForce(CrowdState& state, const ForceRecord& record, float dt) {
    const LaneBody body = bodyOf(state, state.dolls[record.doll], record.body);
    const vec3 arm = body.rotation() * record.point;
    const auto speed = [&] { return readVector(body.lanes.velocity, body.lane) + glm::cross(body.turn(), arm); };
    const vec3 impulse = record.force * dt;
    const vec3 early = speed();
    writeVector(body.lanes.velocity, body.lane,
                readVector(body.lanes.velocity, body.lane) + impulse * body.inverseMass);
    writeVector(body.lanes.angular, body.lane, body.turn() + body.turned(glm::cross(arm, impulse)));
    return static_cast<double>(glm::dot(impulse, 0.5F * (early + speed())));
}

}  // namespace lutka::physics::crowd
