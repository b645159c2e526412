#pragma once

#include <span>
#include <string>
#include <vector>

#include "editor/view/selection.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::editor {

/// The bodies on the other side in place of those that are selected; who has no other side, and what is no body, stays.
void selectMirror(Selection& selection, const physics::RagdollProfile& profile);
/// All that hangs on a selected body is selected as well; the active item stays the active one.
void selectChildren(Selection& selection, const physics::RagdollProfile& profile);

/// Bodies by their names, which outlive a ragdoll that is made anew, and back; those that it lacks are left out.
[[nodiscard]] std::vector<std::string> namesOf(const physics::RagdollProfile& profile, std::span<const int> bodies);
[[nodiscard]] std::vector<int> bodiesNamed(const physics::RagdollProfile& profile, std::span<const std::string> names);

}  // namespace lutka::editor
