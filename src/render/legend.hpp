#pragma once

#include <span>
#include <string_view>

#include "render/image.hpp"

namespace lutka::render {

/// A colour and what it means.
struct LegendEntry {
    Color color;
    std::string_view text;  ///< ASCII.
};

/// Draws a box with the entries, one a line, into the picture's upper left corner, on a dark ground. The letters grow
/// with the picture; what does not fit is cut off. Nothing when there are no entries.
void drawLegend(Image& image, std::span<const LegendEntry> entries);

}  // namespace lutka::render
