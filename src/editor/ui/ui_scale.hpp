#pragma once

namespace lutka::editor {

/// What the window system tells of a monitor; 0: it does not.
struct MonitorMeasures {
    float contentScale = 1.0F;  ///< What its user has set for all programs.
    int heightPixels = 0;
    float heightMm = 0.0F;
};

/// How much larger than on 96 dots per inch panels are to be: the user's own setting; where that says nothing, by the
/// size of a pixel, so that a small 4K screen has panels that can be read. [0.75, 4].
[[nodiscard]] float uiScaleFor(const MonitorMeasures& monitor);

}  // namespace lutka::editor
