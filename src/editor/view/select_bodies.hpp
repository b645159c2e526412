#pragma once

#include "editor/view/selection.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::editor {

/// The bodies on the other side in place of those that are selected; who has no other side, and what is no body, stays.
void selectMirror(Selection& selection, const physics::RagdollProfile& profile);
/// All that hangs on a selected body is selected as well; the active item stays the active one.
void selectChildren(Selection& selection, const physics::RagdollProfile& profile);

}  // namespace lutka::editor
