#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lutka::reporting {

/// A line of a chart; its colour is the style's for `--series-N`, N its place counted from 1.
struct ChartLine {
    std::string name;
    std::span<const float> values;  ///< At equal distances of time, the first at 0 s.
};

/// Values over time.
struct LineChart {
    std::string label;           ///< For readers that don't see.
    std::string unit;            ///< Of the values.
    float secondsAValue = 1.0F;  ///< > 0.
    std::optional<float> bound;  ///< Above it is a finding; drawn where it lies near the values.
    std::vector<ChartLine> lines;
};

/// A bar of a chart of times: the fall in the air, then the way to rest.
struct TimeBar {
    std::string name;
    float beginS = 0;           ///< Where the solid part begins; before it the bar is light.
    std::optional<float> endS;  ///< Unset: it goes on past the end of the axis.
};

/// Both as an SVG element without colours of its own, in a viewBox of a width of 520: the same bytes for the same
/// values. A hidden line of class `cursor` stands at 0 s; the attributes data-left, data-right (in the viewBox) and
/// data-seconds (at the right) say how time lies.
[[nodiscard]] std::string lineChartSvg(const LineChart& chart);
[[nodiscard]] std::string timeBarsSvg(const std::string& label, std::span<const TimeBar> bars, float seconds);

/// Ticks from 0 to `top` or just below: about `count`, at steps of 1, 2 or 5 times a power of ten. `top` > 0.
[[nodiscard]] std::vector<float> chartTicks(float top, int count);

}  // namespace lutka::reporting
