#include "report/view_texture.hpp"

#include <algorithm>

#include "core/base64.hpp"
#include "render/png_bytes.hpp"

namespace lutka::reporting {
namespace {

// An odd last row or column is left out.
render::Image halved(const render::Image& from) {
    render::Image half({std::max(from.width / 2, 1), std::max(from.height / 2, 1)}, {});
    for (int y = 0; y < half.height; ++y) {
        for (int x = 0; x < half.width; ++x) {
            const int x1 = std::min(2 * x + 1, from.width - 1);
            const int y1 = std::min(2 * y + 1, from.height - 1);
            const render::Color four[] = {from.at(2 * x, 2 * y), from.at(x1, 2 * y), from.at(2 * x, y1),
                                          from.at(x1, y1)};
            const auto mean = [&](std::uint8_t render::Color::*channel) {
                int sum = 2;  // rounds
                for (const render::Color& color : four)
                    sum += color.*channel;
                return static_cast<std::uint8_t>(sum / 4);
            };
            half.set(
                x, y,
                {mean(&render::Color::r), mean(&render::Color::g), mean(&render::Color::b), mean(&render::Color::a)});
        }
    }
    return half;
}

}  // namespace

std::string textureUri(const animation::Texture& texture, int side) {
    const std::size_t pixels = static_cast<std::size_t>(std::max(texture.width, 0)) * std::max(texture.height, 0);
    if (pixels == 0 || texture.rgba.size() != pixels * 4) return "";
    render::Image image;
    image.width = texture.width;
    image.height = texture.height;
    image.rgba = texture.rgba;
    while (std::max(image.width, image.height) > side)
        image = halved(image);
    const auto png = render::pngBytes(image);
    return png ? "data:image/png;base64," + base64(png.value()) : "";
}

}  // namespace lutka::reporting
