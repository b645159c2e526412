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
#include "animation/import/model_folder.hpp"
#include "animation/import/picture.hpp"

namespace lutka::animation::rig_import {

/// Finds and decodes a scene's pictures, each once.
///
/// Looks for a picture in this order; only what the folder admits is opened:
/// 1. among the embedded ones;
/// 2. at the path as written;
/// 3. by its base name (also of an absolute Windows path) in the model's folder and its `textures` folders, whatever
///    the case of its letters;
/// 4. there with the ending of another kind of picture.
class TextureLoader {
  public:
    /// Gives a picture that is in the model file itself, by its path or number there; nothing when it isn't.
    using Embedded = std::function<std::optional<PictureDecoder::Decoded>(const std::string& path, PictureDecoder&)>;

    /// With `enabled` false nothing is loaded and nothing is missing.
    TextureLoader(Embedded embedded, ModelFolder folder, bool enabled);

    /// Index of the texture, or Material::kNoTexture.
    int load(const std::string& path);
    /// The same for a picture that may come along (its file's bytes, or empty): that one goes before one beside the
    /// model.
    int load(const std::string& path, std::span<const std::uint8_t> embedded);

    /// One sentence about all that was not found or can't be decoded, one about what lies outside of the folder, one
    /// about pictures that stand in for others, and PictureDecoder's; empty when nothing is to be told.
    [[nodiscard]] std::vector<std::string> sentences() const;
    [[nodiscard]] std::vector<Texture> takeTextures() { return std::move(textures_); }

  private:
    int keep(const std::string& path, PictureDecoder::Decoded picture);
    [[nodiscard]] PictureDecoder::Decoded read(const std::string& path);
    [[nodiscard]] std::string hintAbove() const;

    Embedded embedded_;
    ModelFolder folder_;
    PictureDecoder decoder_;
    bool enabled_;
    std::map<std::string, int> known_;
    std::vector<Texture> textures_;
    std::vector<std::string> missing_;
    std::vector<std::string> outside_;
    std::vector<std::string> replaced_;
};

}  // namespace lutka::animation::rig_import
