#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Predicted motion counts a little more than whole: limbs speed up within a step.
inline constexpr float kForesight = 1.2F;

/// Bounds of all awake dolls for a step of `dt` s.
void findBounds(CrowdState& state, float dt);
/// The same of one batch, from where its dolls are now.
void findBounds(CrowdState& state, Batch& batch, const Topology& topology, float dt);

/// The bounds that findBounds() gave a doll as seen from its root, with the root's own motion in `dt` s and `farther`
/// metres more.
[[nodiscard]] Aabb worldBounds(const Doll& doll, float dt, float farther = 0.0F);
[[nodiscard]] bool meet(const vec3& lowA, const vec3& highA, const vec3& lowB, const vec3& highB);

}  // namespace lutka::physics::crowd
