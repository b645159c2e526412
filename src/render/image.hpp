#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/result.hpp"
#include "render/color.hpp"
#include "render/extent.hpp"

namespace lutka::render {

/// A picture: RGBA, 8 bits each, sRGB, straight alpha, rows from the top without padding.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;  ///< width * height * 4.

    Image() = default;
    /// A picture of one colour.
    Image(Extent size, Color fill);

    [[nodiscard]] Extent size() const { return {width, height}; }
    /// The pixel in column x, row y from the top; both inside the picture.
    [[nodiscard]] Color at(int x, int y) const;
    void set(int x, int y, Color color);
};

/// Writes a PNG whole or not at all; fails with ErrorCode::output.
[[nodiscard]] Result<void> savePng(const Image& image, const std::filesystem::path& file);

/// Reads a PNG (or JPEG, BMP, TGA) as RGBA; fails with ErrorCode::input. Pictures above 16384 pixels a side are
/// refused.
[[nodiscard]] Result<Image> loadPng(const std::filesystem::path& file);

/// What differs between two pictures.
struct ImageDifference {
    bool sameSize = true;         ///< False: nothing else was measured, differingShare is 1.
    double differingShare = 0.0;  ///< Share of pixels with any channel off by more than the tolerance, [0, 1].
    double meanError = 0.0;       ///< Mean over all channels of the absolute difference, [0, 255].
    int maxError = 0;             ///< Largest difference of any channel, [0, 255].
};

/// Compares pixel by pixel; a pixel differs when any of its channels is off by more than `channelTolerance`.
[[nodiscard]] ImageDifference compareImages(const Image& a, const Image& b, int channelTolerance);

/// A picture to look at: grey where equal, red where the pictures differ by more than the tolerance. Same sizes only.
[[nodiscard]] Image differenceImage(const Image& a, const Image& b, int channelTolerance);

}  // namespace lutka::render
