#pragma once

#include <filesystem>

#include "animation/character.hpp"

namespace lutka::cli {

/// Whether a clip of that name is BVH, the joints' motion alone. Else it is glTF, with the skin and its pictures.
[[nodiscard]] bool isMotionAlone(const std::filesystem::path& file);

/// Writes the clip so. `allKeys`: a glTF keeps those that it needs not, as BVH always does. Leaves on errors.
void writeClip(const std::filesystem::path& file, const animation::Character& character, const animation::Clip& clip,
               const RigidTransform& worldFromModel, bool allKeys);

}  // namespace lutka::cli
