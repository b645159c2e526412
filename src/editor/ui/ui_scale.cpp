#include "editor/ui/ui_scale.hpp"

#include <algorithm>
#include <cmath>

namespace lutka::editor {

float uiScaleFor(const MonitorMeasures& monitor) {
    constexpr float least = 0.75F;
    constexpr float most = 4.0F;
    if (std::abs(monitor.contentScale - 1.0F) > 0.01F) return std::clamp(monitor.contentScale, least, most);
    constexpr float usual = 1080.0F;  // lines of a monitor on which 1 is right, unless it is a large one
    const float byLines = std::max(static_cast<float>(monitor.heightPixels) / usual, 1.0F);
    constexpr float mmPerInch = 25.4F;
    const float dpi =
        monitor.heightMm > 0.0F ? static_cast<float>(monitor.heightPixels) * mmPerInch / monitor.heightMm : 0.0F;
    constexpr float leastDpi = 50.0F;  // what is below is no measure but a projector's or a virtual screen's guess
    const float byDpi = dpi > leastDpi ? std::max(dpi / 96.0F, 1.0F) : byLines;
    constexpr float step = 0.25F;
    return std::clamp(std::floor(std::min(byLines, byDpi) / step + 0.01F) * step, 1.0F, most);
}

render::Extent windowSizeFor(render::Extent usual, float scale, render::Extent free) {
    constexpr float share = 0.9F;
    const auto length = [&](int own, int room) {
        const float wanted = std::min(static_cast<float>(own) * scale, static_cast<float>(room) * share);
        return std::max(static_cast<int>(wanted), own);
    };
    return {length(usual.width, free.width), length(usual.height, free.height)};
}

}  // namespace lutka::editor
