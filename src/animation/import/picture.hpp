#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "animation/character.hpp"

namespace lutka::animation::rig_import {

/// What the pictures of one model may take. A picture is judged by its header, before it is decoded.
struct PictureLimits {
    std::size_t mostPixels = std::size_t{8192} * 8192;    ///< A larger picture is left out.
    int mostSide = 4096;                                  ///< A longer one is halved until it is not.
    std::size_t mostKept = std::size_t{96} << 20U;        ///< Pixels of all together, 4 bytes each.
    std::size_t mostDecoded = std::size_t{512} << 20U;    ///< Pixels that are decoded at all: it takes time.
    std::size_t mostFileBytes = std::size_t{256} << 20U;  ///< Of a picture's file.
};

/// Decodes a model's pictures (PNG, JPEG, TGA, BMP …) within limits of all together: one may take half of what is left,
/// so that there is always some for the next, and is halved in both directions until it does. One pixel is always had.
class PictureDecoder {
  public:
    explicit PictureDecoder(const PictureLimits& limits = {}) : limits_(limits) {}

    enum class Outcome { decoded, damaged, tooLarge };
    struct Decoded {
        Outcome outcome = Outcome::damaged;
        Texture texture;  ///< Where it was decoded.
    };
    /// `name` is for sentences(), which tell what was too large.
    [[nodiscard]] Decoded decode(std::span<const std::uint8_t> file, const std::string& name);
    /// Whether a picture of that size may be made at all; a refusal is remembered. For pixels that the model file holds
    /// as they are, which fitted() then brings into the limits.
    [[nodiscard]] bool admits(int width, int height, const std::string& name);
    [[nodiscard]] Texture fitted(Texture texture, const std::string& name);

    [[nodiscard]] const PictureLimits& limits() const { return limits_; }
    /// One about the pictures that were made smaller and one about those that were left out; empty without such.
    [[nodiscard]] std::vector<std::string> sentences() const;

  private:
    PictureLimits limits_;
    std::size_t kept_ = 0;     // pixels
    std::size_t decoded_ = 0;  // pixels
    std::vector<std::string> smaller_;
    std::vector<std::string> tooLarge_;
};

}  // namespace lutka::animation::rig_import
