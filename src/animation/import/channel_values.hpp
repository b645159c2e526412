#pragma once

#include <cstddef>

#include "animation/import/affine.hpp"
#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import {

/// The key's value; with splines it stands between its two tangents.
[[nodiscard]] dvec4 keyAt(const SourceChannel& channel, std::size_t key);

/// The value at a time: held before the first and after the last key.
[[nodiscard]] dvec4 valueAt(const SourceChannel& channel, double time);

/// The part of a clip without splines from `start` to `end`, which is beyond it, as a clip that begins at 0.
[[nodiscard]] SourceClip cutClip(const SourceClip& clip, double start, double end);

}  // namespace lutka::animation::rig_import
