#include "physics/crowd/coupling.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <tuple>

#include "physics/world/joint_error.hpp"

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

struct Joined {
    LaneBody parent;
    LaneBody child;

    [[nodiscard]] vec3 turn() const { return child.turn() - parent.turn(); }
    // An angular impulse on the child, its opposite on the parent; returns the work.
    double apply(const vec3& impulse) const {
        const vec3 before = turn();
        writeVector(child.lanes.angular, child.lane, child.turn() + child.turned(impulse));
        writeVector(parent.lanes.angular, parent.lane, parent.turn() - parent.turned(impulse));
        return static_cast<double>(glm::dot(impulse, 0.5F * (before + turn())));
    }
};

Joined joinedBy(CrowdState& state, const MotorRecord& record) {
    const Doll& doll = state.dolls[record.doll];
    const ConstraintProfile& constraint = doll.profile->constraints[record.constraint];
    return {bodyOf(state, doll, constraint.parent), bodyOf(state, doll, constraint.child)};
}

bool before(const MotorRecord& record, std::pair<int, int> wanted) {
    return std::pair(record.doll, record.constraint) < wanted;
}

}  // namespace

double beginMotor(CrowdState& state, MotorRecord& record, float dt) {
    const Joined bodies = joinedBy(state, record);
    const ConstraintProfile& constraint = state.dolls[record.doll].profile->constraints[record.constraint];
    const MotorError found = motorError(constraint, record.motor, bodies.parent.rotation(), bodies.child.rotation());
    // See MotorConstraint of the Bullet world: the spring at the end of the substep as soft rows.
    const float firmness = record.motor.damping + dt * record.motor.stiffness;
    record.rows = firmness > 0.0F ? found.count : 0;
    if (record.rows == 0) return 0.0;
    record.softness = 1.0F / (dt * firmness);
    record.bound = record.motor.maxTorqueNm * dt;
    vec3 carried(0);
    for (int i = 0; i < record.rows; ++i) {
        const vec3& axis = found.axes[i];
        record.axes[i] = axis;
        record.target[i] = -found.error[i] * record.motor.stiffness / firmness;
        record.mass[i] =
            1.0F / (glm::dot(axis, bodies.parent.turned(axis) + bodies.child.turned(axis)) + record.softness);
        record.impulse[i] = std::clamp(record.impulse[i], -record.bound, record.bound);
        carried += axis * record.impulse[i];
    }
    return bodies.apply(carried);
}

double solveMotor(CrowdState& state, MotorRecord& record) {
    const Joined bodies = joinedBy(state, record);
    double work = 0.0;
    for (int i = 0; i < record.rows; ++i) {
        const float missing =
            record.target[i] - glm::dot(bodies.turn(), record.axes[i]) - record.softness * record.impulse[i];
        const float total = std::clamp(record.impulse[i] + missing * record.mass[i], -record.bound, record.bound);
        work += bodies.apply(record.axes[i] * (total - record.impulse[i]));
        record.impulse[i] = total;
    }
    return work;
}

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

const MotorRecord* findMotor(const CrowdState& state, int doll, int constraint) {
    const auto at = std::lower_bound(state.motors.begin(), state.motors.end(), std::pair(doll, constraint), before);
    const bool found = at != state.motors.end() && at->doll == doll && at->constraint == constraint;
    return found ? &*at : nullptr;
}

void setMotor(CrowdState& state, int doll, int constraint, const std::optional<JointMotor>& motor) {
    auto at = std::lower_bound(state.motors.begin(), state.motors.end(), std::pair(doll, constraint), before);
    const bool known = at != state.motors.end() && at->doll == doll && at->constraint == constraint;
    if (!motor) {
        if (known) state.motors.erase(at);
        return;
    }
    if (!known) at = state.motors.insert(at, MotorRecord{doll, constraint, {}, 0, {}, {}, {}, {}, 0, 0});
    at->motor = *motor;
}

}  // namespace lutka::physics::crowd
