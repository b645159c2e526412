#include "render/image.hpp"

#include <stb_image.h>
#include <stb_image_write.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "core/assert.hpp"
#include "core/files.hpp"
#include "render/png_bytes.hpp"

namespace lutka::render {
namespace {

constexpr int kChannels = 4;
constexpr int kLargestSide = 16384;

std::size_t offsetOf(const Image& image, int x, int y) {
    LUTKA_ASSERT(x >= 0 && x < image.width && y >= 0 && y < image.height);
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) *
           kChannels;
}

void appendBytes(void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

// The largest difference of any channel of one pixel.
int pixelError(const Image& a, const Image& b, std::size_t offset) {
    int worst = 0;
    for (std::size_t channel = 0; channel < kChannels; ++channel) {
        worst = std::max(worst, std::abs(static_cast<int>(a.rgba[offset + channel]) - b.rgba[offset + channel]));
    }
    return worst;
}

}  // namespace

Image::Image(Extent extent, Color fill)
    : width(extent.width), height(extent.height), rgba(static_cast<std::size_t>(width) * height * kChannels) {
    for (std::size_t at = 0; at < rgba.size(); at += kChannels) {
        rgba[at] = fill.r;
        rgba[at + 1] = fill.g;
        rgba[at + 2] = fill.b;
        rgba[at + 3] = fill.a;
    }
}

Color Image::at(int x, int y) const {
    const std::size_t at = offsetOf(*this, x, y);
    return {rgba[at], rgba[at + 1], rgba[at + 2], rgba[at + 3]};
}

void Image::set(int x, int y, Color color) {
    const std::size_t at = offsetOf(*this, x, y);
    rgba[at] = color.r;
    rgba[at + 1] = color.g;
    rgba[at + 2] = color.b;
    rgba[at + 3] = color.a;
}

Result<std::string> pngBytes(const Image& image) {
    std::string bytes;
    const int written = stbi_write_png_to_func(appendBytes, &bytes, image.width, image.height, kChannels,
                                               image.rgba.data(), image.width * kChannels);
    if (written == 0) return Error{ErrorCode::internal, "the picture can't be encoded as PNG", "", ""};
    return bytes;
}

Result<void> savePng(const Image& image, const std::filesystem::path& file) {
    const auto bytes = pngBytes(image);
    if (!bytes) return Error{ErrorCode::output, bytes.error().message, file.string(), ""};
    return writeFileAtomically(file, std::string_view(bytes.value()));
}

Result<Image> loadPng(const std::filesystem::path& file) {
    const Result<std::vector<unsigned char>> bytes = readFile(file, std::size_t{1} << 30U);
    if (!bytes) return bytes.error();
    const auto fail = [&](const std::string& why) { return Error{ErrorCode::input, why, file.string(), ""}; };
    const int size = static_cast<int>(bytes.value().size());
    int width = 0;
    int height = 0;
    int channels = 0;
    // The header first: a hostile size must not be allocated.
    if (stbi_info_from_memory(bytes.value().data(), size, &width, &height, &channels) == 0) {
        return fail("is not a picture that can be read");
    }
    if (width > kLargestSide || height > kLargestSide) return fail("has more than 16384 pixels a side");
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes.value().data(), size, &width, &height, &channels, kChannels), stbi_image_free);
    if (!pixels) return fail("is a damaged picture");
    Image image;
    image.width = width;
    image.height = height;
    image.rgba.assign(pixels.get(), pixels.get() + static_cast<std::size_t>(width) * height * kChannels);
    return image;
}

ImageDifference compareImages(const Image& a, const Image& b, int channelTolerance) {
    ImageDifference difference;
    if (a.width != b.width || a.height != b.height) {
        difference.sameSize = false;
        difference.differingShare = 1.0;
        return difference;
    }
    std::size_t differing = 0;
    double sum = 0.0;
    for (std::size_t at = 0; at < a.rgba.size(); at += kChannels) {
        const int error = pixelError(a, b, at);
        difference.maxError = std::max(difference.maxError, error);
        if (error > channelTolerance) ++differing;
        for (std::size_t channel = 0; channel < kChannels; ++channel) {
            sum += std::abs(static_cast<int>(a.rgba[at + channel]) - b.rgba[at + channel]);
        }
    }
    const auto channels = static_cast<double>(std::max<std::size_t>(a.rgba.size(), 1));
    difference.differingShare = static_cast<double>(differing) * kChannels / channels;
    difference.meanError = sum / channels;
    return difference;
}

Image differenceImage(const Image& a, const Image& b, int channelTolerance) {
    LUTKA_ASSERT(a.width == b.width && a.height == b.height);
    Image out(a.size(), colors::white);
    for (std::size_t at = 0; at < a.rgba.size(); at += kChannels) {
        const auto grey = static_cast<std::uint8_t>(64 + (a.rgba[at] + a.rgba[at + 1] + a.rgba[at + 2]) / 6);
        const bool differs = pixelError(a, b, at) > channelTolerance;
        out.rgba[at] = differs ? 255 : grey;
        out.rgba[at + 1] = differs ? 0 : grey;
        out.rgba[at + 2] = differs ? 0 : grey;
    }
    return out;
}

}  // namespace lutka::render
