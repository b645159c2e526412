#pragma once

#include <filesystem>

#include "animation/import/source_scene.hpp"
#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// Reads a BVH file: joints and end sites as nodes, the motion as one clip named "Motion", no meshes. The format states
/// neither unit nor up axis; Z is given as up where the motion stands on that floor and not on Y's.
///
/// The nodes' pose is the file's zero pose, unless nearly all of it points along one axis, or its trunk is bent over
/// though the motion stands upright, as many captures are exported: then it is the frame of the motion that shows the
/// figure most plainly (upright, with straight limbs; the earliest of those that do), which a warning tells.
[[nodiscard]] Result<SourceScene> readBvh(const std::filesystem::path& file);

}  // namespace lutka::animation::rig_import
