#pragma once

#include <filesystem>
#include <string>

#include "animation/clip.hpp"
#include "animation/skeleton.hpp"
#include "core/result.hpp"

namespace lutka::animation {

/// The clip as motion capture (Biovision's BVH), in world space: centimetres, Y up, angles in degrees in the order Z X
/// Y.
///
/// BVH knows no axes of joints: each joint's are the world's in the bind pose, so that all angles are 0 there. The root
/// has no offset, its way is in its channels. A joint whose translation leaves the bind pose by more than 0.01 mm has
/// position channels, too, which stand in place of its offset, as Blender takes them. Several roots hang on one that is
/// added. Blanks and braces in names become '_', and of equal names the later ones get a number.
[[nodiscard]] std::string bvhText(const Skeleton& skeleton, const Clip& clip,
                                  const RigidTransform& worldFromModel = {});

/// Writes that whole or not at all; ErrorCode::output on failure.
[[nodiscard]] Result<void> writeBvh(const std::filesystem::path& file, const Skeleton& skeleton, const Clip& clip,
                                    const RigidTransform& worldFromModel = {});

}  // namespace lutka::animation
