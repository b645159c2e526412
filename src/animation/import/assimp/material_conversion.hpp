#pragma once

#include <assimp/scene.h>

#include "animation/import/model_folder.hpp"
#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import {

/// Fills out.materials (index = the file's), and with `loadTextures` the textures that they use: embedded ones, or
/// pictures in the model's folder. What can't be found or decoded stays plain, with one warning for all.
void convertMaterials(const aiScene& scene, const ModelFolder& folder, bool loadTextures, SourceScene& out);

}  // namespace lutka::animation::rig_import
