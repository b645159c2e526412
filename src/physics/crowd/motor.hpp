#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Puts the motors of awake dolls into their batches' lanes, for a step of `dt` s. Call it after makeJobs().
void placeMotors(CrowdState& state, float dt);
/// What a batch's motors did in the last substep, J.
[[nodiscard]] double workOfMotors(const Batch& batch);
/// Remembers at a step's end which of them are at their bound.
void keepMotors(CrowdState& state);

/// The motor of a joint; null when there is none. `doll` counts in CrowdState::dolls.
[[nodiscard]] const MotorRecord* findMotor(const CrowdState& state, int doll, int constraint);
void setMotor(CrowdState& state, int doll, int constraint, const std::optional<JointMotor>& motor);

}  // namespace lutka::physics::crowd
