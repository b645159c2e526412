#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "animation/character.hpp"
#include "animation/humanoid/map_humanoid.hpp"
#include "animation/import/import_character.hpp"
#include "core/result.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "physics/profile/profile.hpp"
#include "physics/rig/rig.hpp"

namespace lutka::scene {

/// A character with everything that follows from it: what a simulation, the CLI and the editor start from.
struct RagdollAsset {
    animation::Character character;
    animation::HumanoidMap map;
    physics::RagdollProfile profile;
    physics::Rig rig;
    float sizeM = 0.0F;      ///< Diagonal of the box around its skin and joints in the bind pose.
    bool fromModel = false;  ///< The model's own file brought the ragdoll along.
    bool rebound = false;    ///< The profile was made for another rig and was bound to this one by role.
};

struct LoadOptions {
    animation::ImportOptions import;
    animation::MapOptions map;
    physics::FitOptions fit;
    std::optional<std::filesystem::path> profile;  ///< Set: this file's profile instead of a fitted one.
    std::optional<physics::RagdollProfile> given;  ///< Likewise, one that is there already; not with `profile`.
    bool refit = false;       ///< A ragdoll that the model's own file brings along (glTF) is not taken.
    bool keepShapes = false;  ///< A profile of another rig keeps its shapes; otherwise they are fitted to this one.
};

/// A profile without roles, and LoadOptions::fit with rig any, take the character as any rig: no map is asked for
/// (RagdollAsset::map is no humanoid's, and holds standardFromModel alone).
///
/// import → map → fit (or take the ragdoll that the file brings along; or read the profile and bind it: by joints when
/// it was made for this rig, else by role). Of a file with several figures a profile's own is taken when none is asked
/// for: that whose joints it names. A ragdoll in the file that is none of this figure is told as a warning.
/// Fails with ErrorCode::input: the file can't be read, isn't a humanoid (the reason is the mapper's), or the profile
/// doesn't fit the rig.
[[nodiscard]] Result<std::unique_ptr<RagdollAsset>> loadRagdoll(const std::filesystem::path& model,
                                                                const LoadOptions& options = {});

/// Whether loading failed because the figure is no humanoid, so that FitOptions::rig any would take it.
[[nodiscard]] bool wantsAnyRig(const Error& error);

/// map → fit → bind for a character that is there already. Wrong usage where its skeleton is not valid
/// (animation::validate()).
[[nodiscard]] Result<std::unique_ptr<RagdollAsset>> makeRagdoll(animation::Character character,
                                                                const LoadOptions& options = {});

}  // namespace lutka::scene
