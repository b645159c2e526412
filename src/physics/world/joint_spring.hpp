#pragma once

#include <optional>

#include "physics/world/world.hpp"

namespace lutka::physics {

/// A joint's own spring as the motor that a world runs in it while no other is set; none where it does nothing.
[[nodiscard]] std::optional<JointMotor> motorOf(const JointSpring& spring);
/// The state with its joints' springs for the motors that it lacks; none where it lacks none, as without springs.
[[nodiscard]] std::optional<DollState> withSprings(const RagdollProfile& profile, const DollState& state);

}  // namespace lutka::physics
