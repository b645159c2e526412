#pragma once

#include "render/extent.hpp"

namespace lutka::editor {

/// What the window system tells of a monitor; 0: it does not.
struct MonitorMeasures {
    float contentScale = 1.0F;  ///< What its user has set for all programs.
    int heightPixels = 0;
    float heightMm = 0.0F;
};

/// How much larger than on 96 dots per inch panels are to be, [0.75, 4]. The user's own setting comes first. Without
/// one it goes by the size of a pixel, so that panels can be read on a small 4K screen.
[[nodiscard]] float uiScaleFor(const MonitorMeasures& monitor);

/// The window for panels of that scale: larger with them, and at most nine tenths of what the monitor has free; never
/// smaller than `usual`.
[[nodiscard]] render::Extent windowSizeFor(render::Extent usual, float scale, render::Extent free);

}  // namespace lutka::editor
