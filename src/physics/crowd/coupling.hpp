#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Brings the pull of a motor in for a substep of `dt` s: its rows, and the impulse that it has built up (with which
/// all joints may already hold: see solveMotor). Returns the work done, J.
double beginMotor(CrowdState& state, MotorRecord& record, float dt);

/// One pass over the motor's soft rows with the inertia of the two bodies alone; the tree spreads it over the doll, and
/// the built-up impulse makes up for the difference over the substeps. Returns the work done, J.
double solveMotor(CrowdState& state, MotorRecord& record);

/// The force's impulse of a substep. Returns the work done, J.
double applyForce(CrowdState& state, const ForceRecord& record, float dt);

/// The motor of a joint; null when there is none. `doll` counts in CrowdState::dolls.
[[nodiscard]] const MotorRecord* findMotor(const CrowdState& state, int doll, int constraint);
void setMotor(CrowdState& state, int doll, int constraint, const std::optional<JointMotor>& motor);

}  // namespace lutka::physics::crowd
