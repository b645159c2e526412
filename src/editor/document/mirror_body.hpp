#pragma once

#include <span>

#include "physics/profile/profile.hpp"

namespace lutka::editor {

/// Gives body `to` what `from`, on the other side of the figure, has: shape and mass, the kind, limits and friction of
/// its constraint, and its place and axes mirrored. Where the bind pose has the two limbs in different places `to`
/// keeps its own place and axes. `bindModelFromBody`: all bodies in the bind pose. Neither body may be the root.
void mirrorBody(physics::RagdollProfile& profile, std::span<const RigidTransform> bindModelFromBody, int from, int to);

}  // namespace lutka::editor
