#include "physics/world/joint_spring.hpp"

#include <cmath>

namespace lutka::physics {

std::optional<JointMotor> motorOf(const JointSpring& spring) {
    constexpr float unbounded = 1e9F;  // N m
    if (!spring.works()) return std::nullopt;
    JointMotor motor;
    motor.target = spring.rest;
    motor.angle = 2.0F * std::atan2(spring.rest.z, spring.rest.w);
    motor.stiffness = spring.stiffness;
    motor.damping = spring.damping;
    motor.maxTorqueNm = unbounded;
    return motor;
}

std::optional<DollState> withSprings(const RagdollProfile& profile, const DollState& state) {
    std::optional<DollState> sprung;
    for (std::size_t i = 0; i < state.motors.size(); ++i) {
        if (state.motors[i] || !profile.constraints[i].spring.works()) continue;
        if (!sprung) sprung = state;
        sprung->motors[i] = motorOf(profile.constraints[i].spring);
    }
    return sprung;
}

}  // namespace lutka::physics
