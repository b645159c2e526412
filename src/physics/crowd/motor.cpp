#include "physics/crowd/motor.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <tuple>

#include "physics/crowd/firmest_row.hpp"

namespace lutka::physics::crowd {
namespace {

bool before(const MotorRecord& record, std::pair<int, int> wanted) {
    return std::pair(record.doll, record.constraint) < wanted;
}

// What the motors of a doll have in common in a step.
struct Setting {
    int doll = -1;
    Batch* batch = nullptr;  // null: it sleeps
    const Topology* topology = nullptr;
    float substep = 0.0F;
    float firmest = 0.0F;
};

Setting settingOf(CrowdState& state, int index, float dt) {
    const Doll& doll = state.dolls[index];
    if (doll.asleep()) return {index};
    Batch& batch = state.batchOf(doll);
    const Topology& topology = state.groupOf(doll).topology;
    return {index, &batch, &topology, dt / static_cast<float>(state.jobs[batch.job].substeps),
            firmestRow(topology).moment};
}

void writeLanes(MotorLanes& lanes, int lane, const MotorRecord& record, const Setting& setting) {
    const JointMotor& motor = record.motor;
    const float dt = setting.substep;
    const float firmness = motor.damping + dt * motor.stiffness;
    if (firmness <= 0.0F || motor.maxTorqueNm <= 0.0F) return;
    const bool isHinge = setting.topology->joints[record.constraint].isHinge != 0;
    const quat target = isHinge ? glm::angleAxis(motor.angle, vec3(0, 0, 1)) : glm::normalize(motor.target);
    lanes.active = 1;
    lanes.target.x.lane[lane] = target.x;
    lanes.target.y.lane[lane] = target.y;
    lanes.target.z.lane[lane] = target.z;
    lanes.target.w.lane[lane] = target.w;
    writeVector(lanes.rate, lane, isHinge ? vec3(0, 0, motor.rate.z) : motor.rate);
    lanes.weight.lane[lane] = std::min(dt * firmness, setting.firmest);
    lanes.pull.lane[lane] = motor.stiffness / firmness;
    lanes.bound.lane[lane] = motor.maxTorqueNm * dt;
    lanes.gain.lane[lane] = record.bounded ? 0.0F : lanes.weight.lane[lane];
}

}  // namespace

void placeMotors(CrowdState& state, float dt) {
    for (Batch* batch : state.active)
        batch->motors.clear();
    Setting setting;
    for (const MotorRecord& record : state.motors) {
        if (record.doll != setting.doll) setting = settingOf(state, record.doll, dt);
        if (setting.batch == nullptr) continue;
        std::vector<MotorLanes>& motors = setting.batch->motors;
        if (motors.empty()) motors.resize(setting.batch->joints.size());  // of zeros
        writeLanes(motors[record.constraint], state.dolls[record.doll].lane, record, setting);
    }
}

double workOfMotors(const Batch& batch) {
    double work = 0.0;
    for (const MotorLanes& motor : batch.motors)
        for (int lane = 0; motor.active != 0 && lane < batch.used; ++lane)
            work += static_cast<double>(motor.work.lane[lane]);
    return work;
}

void keepMotors(CrowdState& state) {
    for (MotorRecord& record : state.motors) {
        const Doll& doll = state.dolls[record.doll];
        if (doll.asleep()) continue;
        const MotorLanes& lanes = state.batchOf(doll).motors[record.constraint];
        record.bounded = lanes.weight.lane[doll.lane] > 0.0F && lanes.gain.lane[doll.lane] == 0.0F;
    }
}

const MotorRecord* findMotor(const CrowdState& state, int doll, int constraint) {
    const auto at = std::lower_bound(state.motors.begin(), state.motors.end(), std::pair(doll, constraint), before);
    const bool found = at != state.motors.end() && at->doll == doll && at->constraint == constraint;
    return found ? &*at : nullptr;
}

void setMotor(CrowdState& state, int doll, int constraint, const std::optional<JointMotor>& motor) {
    const auto isWanted = [&](auto at) {
        return at != state.motors.end() && at->doll == doll && at->constraint == constraint;
    };
    // Most often they are set one after the other.
    auto at = state.motors.begin() + static_cast<std::ptrdiff_t>(std::min(state.nextMotor, state.motors.size()));
    if (!isWanted(at))
        at = std::lower_bound(state.motors.begin(), state.motors.end(), std::pair(doll, constraint), before);
    const bool known = isWanted(at);
    if (!motor) {
        if (known) state.motors.erase(at);
        if (known) --state.dolls[doll].motors;
        return;
    }
    if (!known) at = state.motors.insert(at, MotorRecord{doll, constraint, {}, false});
    if (!known) ++state.dolls[doll].motors;
    at->motor = *motor;
    state.nextMotor = static_cast<std::size_t>(at - state.motors.begin()) + 1;
}

}  // namespace lutka::physics::crowd
