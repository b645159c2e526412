#pragma once

#include <string>
#include <vector>

#include "animation/skeleton.hpp"

namespace lutka::animation {

/// jointPath() of every joint, in time linear in the paths' length: asked for one by one, each looks at the whole
/// skeleton anew.
[[nodiscard]] std::vector<std::string> jointPaths(const Skeleton& skeleton);

}  // namespace lutka::animation
