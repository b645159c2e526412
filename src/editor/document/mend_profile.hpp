#pragma once

#include <span>
#include <vector>

#include "editor/document/document_state.hpp"
#include "physics/doctor/doctor.hpp"

namespace lutka::editor {

/// The roles that the user fixed on joints that can't be theirs, as far as they are the cause of findings in `asked`:
/// those of bodies with a finding joint-not-below or limb-uneven in `all`, and of their parents, where such a body is,
/// or is linked to, one of those in `asked`.
[[nodiscard]] std::vector<animation::Role> fixedToBlame(const DocumentState& state,
                                                        std::span<const physics::Finding> all,
                                                        std::span<const physics::Finding> asked);

/// physics::applyMends() until what was asked for is mended: one mend can bring the next of its kind to light.
/// `remapped`: the findings are of before another mapping, and those that went with it need no mend. Fails as
/// applyMends() does, and with ErrorCode::input when a finding comes back every time.
[[nodiscard]] Result<physics::RagdollProfile> mendProfile(const physics::RagdollProfile& profile,
                                                          const animation::Character& character,
                                                          const animation::HumanoidMap& map,
                                                          std::span<const physics::Finding> findings,
                                                          bool remapped = false);

}  // namespace lutka::editor
