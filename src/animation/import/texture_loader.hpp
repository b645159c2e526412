#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "animation/character.hpp"

namespace lutka::animation::rig_import {

/// Finds and decodes a scene's pictures, each once.
///
/// Looks among the embedded ones first, then beside the model: at the path as written where it is relative, then for
/// its base name (also of an absolute Windows path) in the model's folder and its `textures` folders, whatever the
/// case.
class TextureLoader {
  public:
    /// With `enabled` false nothing is loaded and nothing is missing.
    TextureLoader(const aiScene& scene, const std::filesystem::path& model, bool enabled);

    /// Index of the texture, or Material::kNoTexture.
    int load(const std::string& path);

    [[nodiscard]] const std::vector<std::string>& missing() const { return missing_; }
    [[nodiscard]] std::vector<Texture> takeTextures() { return std::move(textures_); }

  private:
    [[nodiscard]] std::optional<Texture> decode(const std::string& path) const;

    const aiScene& scene_;
    std::filesystem::path folder_;
    bool enabled_;
    std::map<std::string, int> known_;
    std::vector<Texture> textures_;
    std::vector<std::string> missing_;
};

}  // namespace lutka::animation::rig_import
