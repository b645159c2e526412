#pragma once

#include <filesystem>
#include <optional>

#include "animation/character.hpp"
#include "animation/humanoid/map_humanoid.hpp"
#include "core/result.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::exporting {

/// The ragdoll that a .glb or .gltf file brings along (KHR_physics_rigid_bodies): bodies on the joints that the map
/// knows, joined as a tree below the hips by hinges and cone-twist joints. What writeGltf() wrote comes back as it was.
///
/// Empty when the file has no such bodies. Fails with ErrorCode::input when it has, and they are no ragdoll of this
/// figure; the message says why. `base` gives what such a file does not hold: name, height, stance.
[[nodiscard]] Result<std::optional<physics::RagdollProfile>> readGltfPhysics(const std::filesystem::path& file,
                                                                             const animation::Character& character,
                                                                             const animation::HumanoidMap& map,
                                                                             const physics::RagdollProfile& base);

}  // namespace lutka::exporting
