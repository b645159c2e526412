#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Puts the targets of bodies into their batches' lanes, for substeps of `dt` s. Their dolls must be awake.
void placeTargets(CrowdState& state, float dt);
/// What the targets of a batch's bodies did in the last substep, J.
[[nodiscard]] double workOfTargets(const Batch& batch);
/// What kinematic bodies gave to those that they pushed in the last substep, J: such a push does not move them, so that
/// their rows don't feel it.
[[nodiscard]] double workOfPushes(const CrowdState& state, const Job& job);
/// Whether the body follows its target exactly in this step.
[[nodiscard]] bool isKinematic(const Batch& batch, int body, int lane);

/// `doll` counts in CrowdState::dolls.
void setTarget(CrowdState& state, int doll, int body, const std::optional<BodyTarget>& target);

}  // namespace lutka::physics::crowd
