#pragma once

#include <string>
#include <string_view>

namespace lutka::animation::rig_import {

/// Whether a file that starts with these bytes is Blitz3D's.
[[nodiscard]] bool isB3d(std::string_view start);

/// A B3D file as Assimp 5.2.5 takes it, which counts the vertices of all meshes on: bones name theirs by their number
/// in the mesh that they are below, and get the numbers of that count. Files of one mesh, and all other bytes, stay as
/// they are; so does what is damaged from where it is.
[[nodiscard]] std::string tidyB3d(std::string_view bytes);

}  // namespace lutka::animation::rig_import
