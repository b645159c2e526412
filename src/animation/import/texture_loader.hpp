#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "animation/character.hpp"

namespace lutka::animation::rig_import {

/// The picture in a file's bytes (PNG, JPEG, TGA, BMP …); nothing when it can't be decoded.
[[nodiscard]] std::optional<Texture> decodePicture(std::span<const std::uint8_t> bytes);

/// Finds and decodes a scene's pictures, each once.
///
/// Looks among the embedded ones first, then beside the model: at the path as written where it is relative, then for
/// its base name (also of an absolute Windows path) in the model's folder and its `textures` folders, whatever the
/// case, and with another picture's ending where the one that is named is not there.
class TextureLoader {
  public:
    /// Gives a picture that is in the model file itself, by its path or number there; nothing when it isn't.
    using Embedded = std::function<std::optional<Texture>(const std::string& path)>;

    /// With `enabled` false nothing is loaded and nothing is missing.
    TextureLoader(Embedded embedded, const std::filesystem::path& model, bool enabled);

    /// Index of the texture, or Material::kNoTexture.
    int load(const std::string& path);
    /// The same for a picture that may come along (its file's bytes, or empty): that one goes before one beside the
    /// model.
    int load(const std::string& path, std::span<const std::uint8_t> embedded);

    /// One sentence about all that was not found or can't be decoded, and one a picture that stands in for another;
    /// empty when nothing is to be told.
    [[nodiscard]] std::vector<std::string> sentences() const;
    [[nodiscard]] std::vector<Texture> takeTextures() { return std::move(textures_); }

  private:
    int keep(const std::string& path, std::optional<Texture> texture);
    [[nodiscard]] std::optional<Texture> decode(const std::string& path);

    Embedded embedded_;
    std::filesystem::path folder_;
    bool enabled_;
    std::map<std::string, int> known_;
    std::vector<Texture> textures_;
    std::vector<std::string> missing_;
    std::vector<std::string> replaced_;
};

}  // namespace lutka::animation::rig_import
