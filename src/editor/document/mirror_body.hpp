#pragma once

#include <span>

#include "editor/document/document_state.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::editor {

/// Gives body `to` what `from`, on the other side of the figure, has: shape and mass, the kind, limits and friction of
/// its constraint, and its place and axes mirrored. Where the bind pose has the two limbs in different places `to`
/// keeps its own place and axes. `bindModelFromBody`: all bodies in the bind pose. Neither body may be the root.
void mirrorBody(physics::RagdollProfile& profile, std::span<const RigidTransform> bindModelFromBody, int from, int to);

/// Gives the bodies on the other side what these have in `profile`, as edits of `state`, whose edits make it; those
/// that are given both keep both.
void mirrorEdits(DocumentState& state, physics::RagdollProfile profile,
                 std::span<const RigidTransform> bindModelFromBody, std::span<const int> bodies);

}  // namespace lutka::editor
