#pragma once

#include <span>
#include <vector>

#include "animation/skeleton.hpp"
#include "render/camera.hpp"

namespace lutka::editor {

/// The joint that is seen nearest to the mouse, within `pixels`; animation::kNoJoint when there is none. Of joints at
/// one place the one that moves skin wins, then the one nearer to the root: helpers and end nodes lie on them.
[[nodiscard]] int jointUnder(const animation::Skeleton& skeleton, std::span<const vec3> worldOfJoint,
                             const render::Camera& camera, const vec2& mouse, render::Extent window, float pixels);

}  // namespace lutka::editor
