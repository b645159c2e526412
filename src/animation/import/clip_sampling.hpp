#pragma once

#include <assimp/scene.h>

#include <span>
#include <string>
#include <vector>

#include "animation/clip.hpp"
#include "animation/import/rigid_pose.hpp"

namespace lutka::animation::rig_import {

/// All animations as rigid poses at a fixed rate: that of their keys, times the smallest whole number that reaches 30
/// frames a second (at most 120), so that the frames fall on the keys. A clip starts at the file's time 0, or at its
/// first key when that lies further off than the clip is long. `matters` marks the joints whose scale shows in a skin.
/// Clips that would be absurdly long are cut, with a warning.
[[nodiscard]] std::vector<Clip> sampleAnimations(const aiScene& scene, const NodeTree& tree, const RigidPoser& poser,
                                                 const Skeleton& skeleton, std::span<const bool> matters,
                                                 std::vector<std::string>& warnings);

}  // namespace lutka::animation::rig_import
