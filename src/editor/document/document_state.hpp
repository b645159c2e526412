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

/// Which bodies a ragdoll has beside those of a plain fit, and which it lacks.
struct BodySet {
    std::vector<std::string> addedJoints;  ///< Paths of the joints that the further bodies hang on.
    std::vector<std::string> removed;      ///< By name.
};
[[nodiscard]] BodySet bodySetBetween(const physics::RagdollProfile& fitted, const physics::RagdollProfile& given);
/// The fit with these bodies added and removed, as far as the character has their joints.
[[nodiscard]] physics::RagdollProfile withBodySet(physics::RagdollProfile fitted, const animation::Character& character,
                                                  const animation::HumanoidMap& map, const BodySet& bodies);

struct DocumentState;
/// What the user fixed by the joints of one skeleton, told by those of another with the same paths; who has none is
/// free.
void takeFixedTo(DocumentState& state, const animation::Skeleton& from, const animation::Skeleton& to);

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
    BodySet baseBodies;               ///< Likewise; it stays from one fit to the next.
};

/// The map with what the user fixed. Fails with ErrorCode::input, in the mapper's words, when that is no humanoid.
[[nodiscard]] Result<animation::HumanoidMap> mapWithFixed(
    const animation::Character& character, const std::array<std::optional<int>, animation::kRoleCount>& fixed);

}  // namespace lutka::editor
