#pragma once

#include <span>

#include "physics/doctor/doctor.hpp"

namespace lutka::editor {

/// physics::applyMends() until what was asked for is mended: one mend can bring the next of its kind to light. Fails as
/// that does, and with ErrorCode::input when a finding comes back every time.
[[nodiscard]] Result<physics::RagdollProfile> mendProfile(const physics::RagdollProfile& profile,
                                                          const animation::Character& character,
                                                          const animation::HumanoidMap& map,
                                                          std::span<const physics::Finding> findings);

}  // namespace lutka::editor
