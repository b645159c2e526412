#pragma once

#include "physics/fit/body_plan.hpp"

namespace lutka::physics {

/// Radius of a man's segment as a share of his height.
[[nodiscard]] float radiusShare(Role role);

}  // namespace lutka::physics
