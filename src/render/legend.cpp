#include "render/legend.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#include <stb_easy_font.h>
#pragma GCC diagnostic pop

namespace lutka::render {
namespace {

constexpr Color kInk{236, 238, 240, 255};
constexpr Color kGround{24, 27, 32, 255};
constexpr float kGroundOpacity = 0.72F;
constexpr int kLine = 13;      // of a line, in the font's pixels
constexpr int kSwatch = 9;     // of the colour's square
constexpr int kMargin = 4;     // inside the box, and between square and words
constexpr int kScaleAt = 700;  // pixels of width for each step of size

// A vertex as stb_easy_font writes it: four of them are an upright rectangle.
struct FontVertex {
    float x;
    float y;
    float z;
    std::array<std::uint8_t, 4> color;
};

std::uint8_t mixed(std::uint8_t under, std::uint8_t over, float opacity) {
    return static_cast<std::uint8_t>(static_cast<float>(under) +
                                     (static_cast<float>(over) - static_cast<float>(under)) * opacity);
}

void fill(Image& image, int left, int top, int width, int height, Color color, float opacity = 1.0F) {
    for (int y = std::max(top, 0); y < std::min(top + height, image.height); ++y) {
        for (int x = std::max(left, 0); x < std::min(left + width, image.width); ++x) {
            const Color under = image.at(x, y);
            image.set(x, y,
                      {mixed(under.r, color.r, opacity), mixed(under.g, color.g, opacity),
                       mixed(under.b, color.b, opacity), under.a});
        }
    }
}

void write(Image& image, int left, int top, int scale, std::string text) {
    constexpr std::size_t kRectanglesALetter = 24;
    std::vector<FontVertex> vertices(text.size() * kRectanglesALetter * 4 + 4);
    const int rectangles = stb_easy_font_print(0, 0, text.data(), nullptr, vertices.data(),
                                               static_cast<int>(vertices.size() * sizeof(FontVertex)));
    for (int i = 0; i < rectangles; ++i) {
        const FontVertex& from = vertices[static_cast<std::size_t>(i) * 4];
        const FontVertex& to = vertices[static_cast<std::size_t>(i) * 4 + 2];
        fill(image, left + static_cast<int>(from.x) * scale, top + static_cast<int>(from.y) * scale,
             static_cast<int>(to.x - from.x) * scale, static_cast<int>(to.y - from.y) * scale, kInk);
    }
}

int widthOf(std::string text) {
    return stb_easy_font_width(text.data());
}

}  // namespace

void drawLegend(Image& image, std::span<const LegendEntry> entries) {
    if (entries.empty()) return;
    const int scale = std::clamp(1 + image.width / kScaleAt, 1, 6);
    int widest = 0;
    for (const LegendEntry& entry : entries)
        widest = std::max(widest, widthOf(std::string(entry.text)));
    const int boxWidth = (widest + kSwatch + 3 * kMargin) * scale;
    const int boxHeight = (static_cast<int>(entries.size()) * kLine + 2 * kMargin) * scale;
    const int corner = kMargin * scale;
    fill(image, corner, corner, boxWidth, boxHeight, kGround, kGroundOpacity);
    int top = corner + kMargin * scale;
    for (const LegendEntry& entry : entries) {
        const int left = corner + kMargin * scale;
        fill(image, left, top + scale, kSwatch * scale, kSwatch * scale, entry.color);
        write(image, left + (kSwatch + kMargin) * scale, top + 2 * scale, scale, std::string(entry.text));
        top += kLine * scale;
    }
}

}  // namespace lutka::render
