#pragma once

#include <assimp/scene.h>

#include <filesystem>

#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import {

/// Fills out.materials (index = the file's), and with `loadTextures` the textures that they use: embedded ones, or
/// pictures beside the file. What can't be found or decoded stays plain, with one warning for all.
void convertMaterials(const aiScene& scene, const std::filesystem::path& file, bool loadTextures, SourceScene& out);

}  // namespace lutka::animation::rig_import
