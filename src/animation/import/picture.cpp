#include "animation/import/picture.hpp"

#include <fmt/format.h>
#include <stb/stb_image.h>

#include <algorithm>
#include <limits>
#include <memory>

namespace lutka::animation::rig_import {
namespace {

std::size_t pixelsOf(int width, int height) {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

// Each pixel the mean of four; of an odd last row or column the pixel itself counts twice.
Texture halved(const Texture& source) {
    Texture out;
    out.name = source.name;
    out.width = std::max(source.width / 2, 1);
    out.height = std::max(source.height / 2, 1);
    out.rgba.resize(4 * pixelsOf(out.width, out.height));
    const auto channel = [&](int x, int y, int i) {
        const int column = std::min(x, source.width - 1);
        const int row = std::min(y, source.height - 1);
        return unsigned{source.rgba[4 * (pixelsOf(source.width, row) + static_cast<std::size_t>(column)) + i]};
    };
    std::size_t at = 0;
    for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x) {
            for (int i = 0; i < 4; ++i, ++at) {
                const unsigned sum = channel(2 * x, 2 * y, i) + channel(2 * x + 1, 2 * y, i) +
                                     channel(2 * x, 2 * y + 1, i) + channel(2 * x + 1, 2 * y + 1, i);
                out.rgba[at] = static_cast<std::uint8_t>((sum + 2) / 4);
            }
        }
    }
    return out;
}

}  // namespace

bool PictureDecoder::admits(int width, int height, const std::string& name) {
    if (width <= 0 || height <= 0) return false;
    const std::size_t pixels = pixelsOf(width, height);
    if (pixels > limits_.mostPixels || pixels > limits_.mostDecoded - decoded_) {
        tooLarge_.push_back(fmt::format("{} ({} x {})", name, width, height));
        return false;
    }
    decoded_ += pixels;
    return true;
}

Texture PictureDecoder::fitted(Texture texture, const std::string& name) {
    const int width = texture.width;
    const int height = texture.height;
    const std::size_t most = (limits_.mostKept - kept_) / 2;
    while (std::max(texture.width, texture.height) > 1 && (std::max(texture.width, texture.height) > limits_.mostSide ||
                                                           pixelsOf(texture.width, texture.height) > most)) {
        texture = halved(texture);
    }
    kept_ += std::min(pixelsOf(texture.width, texture.height), limits_.mostKept - kept_);
    if (texture.width != width || texture.height != height)
        smaller_.push_back(fmt::format("{} ({} x {} to {} x {})", name, width, height, texture.width, texture.height));
    return texture;
}

PictureDecoder::Decoded PictureDecoder::decode(std::span<const std::uint8_t> file, const std::string& name) {
    if (file.size() > std::min<std::size_t>(limits_.mostFileBytes, std::numeric_limits<int>::max())) {
        tooLarge_.push_back(fmt::format("{} ({} MiB)", name, file.size() >> 20U));
        return {Outcome::tooLarge, {}};
    }
    const int length = static_cast<int>(file.size());
    Texture texture;
    int channels = 0;
    if (stbi_info_from_memory(file.data(), length, &texture.width, &texture.height, &channels) == 0) return {};
    if (texture.width <= 0 || texture.height <= 0) return {};
    if (!admits(texture.width, texture.height, name)) return {Outcome::tooLarge, {}};
    {
        const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
            stbi_load_from_memory(file.data(), length, &texture.width, &texture.height, &channels, 4), stbi_image_free);
        if (!pixels) return {};
        texture.rgba.assign(pixels.get(), pixels.get() + 4 * pixelsOf(texture.width, texture.height));
    }
    return {Outcome::decoded, fitted(std::move(texture), name)};
}

std::vector<std::string> PictureDecoder::sentences() const {
    std::vector<std::string> out;
    if (!smaller_.empty()) {
        out.push_back(fmt::format("pictures were made smaller, to {} pixels a side and {} million together: {}",
                                  limits_.mostSide, limits_.mostKept / 1'000'000, fmt::join(smaller_, ", ")));
    }
    if (!tooLarge_.empty()) {
        out.push_back(
            fmt::format("pictures of more than {} million pixels ({} million together) or {} MiB were left out: {}",
                        limits_.mostPixels / 1'000'000, limits_.mostDecoded / 1'000'000, limits_.mostFileBytes >> 20U,
                        fmt::join(tooLarge_, ", ")));
    }
    return out;
}

}  // namespace lutka::animation::rig_import
