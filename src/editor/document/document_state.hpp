#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "editor/document/part_edits.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::editor {

/// Everything that editing changes of the ragdoll; undo keeps whole ones.
struct DocumentState {
    /// Bindings that the user chose. kNoJoint: the role shall have no joint.
    std::array<std::optional<int>, animation::kRoleCount> fixed{};
    physics::FitOptions fit;
    AllPartEdits edits;
    std::vector<PairEdit> pairs;          ///< Of the collision filter.
    std::filesystem::path openedProfile;  ///< The profile's file that `base` was read from; empty: fitted.

    // What follows from the above.
    animation::HumanoidMap map;
    physics::RagdollProfile base;     ///< As fitted, or as read from a file.
    physics::RagdollProfile profile;  ///< `base` with `edits`.
    /// What `base` changes of a plain fit (a profile that was opened, mends): taken into `edits` when a new fit takes
    /// its place, so that nobody's work is lost by mapping another joint.
    AllPartEdits baseEdits;
    std::vector<PairEdit> basePairs;  ///< Likewise.
};

/// The map with what the user fixed. Fails with ErrorCode::input, in the mapper's words, when that is no humanoid.
[[nodiscard]] Result<animation::HumanoidMap> mapWithFixed(
    const animation::Character& character, const std::array<std::optional<int>, animation::kRoleCount>& fixed);

}  // namespace lutka::editor
