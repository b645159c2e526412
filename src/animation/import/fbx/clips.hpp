#pragma once

#include <span>
#include <string>
#include <vector>

#include "animation/import/fbx/model_tree.hpp"
#include "animation/import/fbx/motion.hpp"
#include "animation/import/fbx/scene_layout.hpp"
#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import::fbx {

/// Motions as channels, sampled at the file's frame rate (a multiple of it up to 120 a second when it is below 30), so
/// that euler angles between keys, pivots and inherited scales come out as the file means them. Rotations take no turn
/// from one sample to the next. Channels of all clips together are bounded; what goes beyond is cut, with a warning.
[[nodiscard]] std::vector<SourceClip> sampleMotions(std::span<const Motion> motions, const ModelTree& tree,
                                                    const SceneLayout& layout, double framesPerSecond,
                                                    std::vector<std::string>& warnings);

/// Frames a second by the document's settings (TimeMode, CustomFrameRate).
[[nodiscard]] double frameRateOf(const Properties& settings);

}  // namespace lutka::animation::rig_import::fbx
