#include "report/svg_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/markup_text.hpp"

namespace lutka::reporting {
namespace {

constexpr float kWidth = 520;
constexpr float kLeft = 52;
constexpr float kRight = 508;
constexpr float kTop = 22;
constexpr float kHeight = 210;
constexpr float kBottom = 184;
constexpr float kHeadroom = 1.08F;     // over the largest value
constexpr float kBoundInSight = 2.5F;  // a bound farther above the values than this would flatten them

struct Axes {
    float seconds = 1;
    float top = 1;
    float bottomPx = kBottom;

    [[nodiscard]] float x(float s) const { return kLeft + (kRight - kLeft) * s / seconds; }
    [[nodiscard]] float y(float value) const { return bottomPx - (bottomPx - kTop) * value / top; }
};

// Ticks at 0.1 print as 0.1, not as 0.10000000149.
std::string tickText(float value) {
    return fmt::format("{:.6g}", value);
}

std::string opened(const std::string& label, const Axes& axes, float height) {
    return fmt::format(
        "<svg class=\"chart\" viewBox=\"0 0 {:g} {:g}\" role=\"img\" aria-label=\"{}\" data-left=\"{:g}\" "
        "data-right=\"{:g}\" data-seconds=\"{:g}\">\n",
        kWidth, height, markupEscaped(label), kLeft, kRight, axes.seconds);
}

void addTimeAxis(const Axes& axes, std::string& out) {
    for (const float s : chartTicks(axes.seconds, 6)) {
        out += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                           axes.x(s), axes.bottomPx + 17, s == 0 ? "0 s" : tickText(s));
    }
    out += fmt::format("<line class=\"axis\" x1=\"{:g}\" x2=\"{:g}\" y1=\"{:g}\" y2=\"{:g}\"/>\n", kLeft, kRight,
                       axes.bottomPx, axes.bottomPx);
}

void addValueAxis(const LineChart& chart, const Axes& axes, std::string& out) {
    for (const float value : chartTicks(axes.top, 4)) {
        const float y = axes.y(value);
        out += fmt::format("<line class=\"grid\" x1=\"{:g}\" x2=\"{:g}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", kLeft, kRight,
                           y, y);
        out += fmt::format("<text class=\"tick\" x=\"{:g}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", kLeft - 8,
                           y + 4, tickText(value));
    }
    out += fmt::format("<text class=\"tick\" x=\"{:g}\" y=\"12\" text-anchor=\"end\">{}</text>\n", kLeft - 8,
                       markupEscaped(chart.unit));
}

void addLine(const ChartLine& line, std::size_t place, float secondsAValue, const Axes& axes, std::string& out) {
    out += fmt::format("<path class=\"line series-{}\" d=\"", place + 1);
    bool pen = false;  // a value that is no number leaves a gap
    for (std::size_t i = 0; i < line.values.size(); ++i) {
        const float value = line.values[i];
        if (!std::isfinite(value)) {
            pen = false;
            continue;
        }
        const float x = axes.x(static_cast<float>(i) * secondsAValue);
        out += fmt::format("{}{:.1f} {:.1f}", pen ? "L" : "M", x, axes.y(std::clamp(value, 0.0F, axes.top)));
        pen = true;
    }
    out += fmt::format("\"><title>{}</title></path>\n", markupEscaped(line.name));
}

void close(const Axes& axes, std::string& out) {
    out += fmt::format("<line class=\"cursor\" x1=\"{0:g}\" x2=\"{0:g}\" y1=\"{1:g}\" y2=\"{2:g}\"/>\n</svg>", kLeft,
                       kTop, axes.bottomPx);
}

}  // namespace

std::vector<float> chartTicks(float top, int count) {
    const float rough = top / static_cast<float>(count);
    const float power = std::pow(10.0F, std::floor(std::log10(rough)));
    float step = 10 * power;
    for (const float factor : {5.0F, 2.0F, 1.0F}) {
        if (factor * power >= rough * 0.999F) step = factor * power;
    }
    std::vector<float> ticks;
    for (int i = 0; static_cast<float>(i) * step <= top * 1.0001F; ++i)
        ticks.push_back(static_cast<float>(i) * step);
    return ticks;
}

std::string lineChartSvg(const LineChart& chart) {
    float most = 0;
    std::size_t values = 2;
    for (const ChartLine& line : chart.lines) {
        values = std::max(values, line.values.size());
        for (const float value : line.values)
            most = std::isfinite(value) ? std::max(most, value) : most;
    }
    const bool bounded = chart.bound && *chart.bound <= most * kBoundInSight;
    if (bounded) most = std::max(most, *chart.bound);
    Axes axes;
    axes.seconds = static_cast<float>(values - 1) * chart.secondsAValue;
    axes.top = most > 0 ? most * kHeadroom : 1.0F;
    std::string out = opened(chart.label, axes, kHeight);
    addValueAxis(chart, axes, out);
    addTimeAxis(axes, out);
    if (bounded) {
        out += fmt::format("<line class=\"bound\" x1=\"{:g}\" x2=\"{:g}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", kLeft, kRight,
                           axes.y(*chart.bound), axes.y(*chart.bound));
        out +=
            fmt::format("<text class=\"boundText\" x=\"{:g}\" y=\"{:.1f}\" text-anchor=\"end\">allowed: {} {}</text>\n",
                        kRight, axes.y(*chart.bound) - 5, tickText(*chart.bound), markupEscaped(chart.unit));
    }
    for (std::size_t i = 0; i < chart.lines.size(); ++i)
        addLine(chart.lines[i], i, chart.secondsAValue, axes, out);
    close(axes, out);
    return out;
}

std::string timeBarsSvg(const std::string& label, std::span<const TimeBar> bars, float seconds) {
    constexpr float kRow = 54;
    constexpr float kBar = 16;
    Axes axes;
    axes.seconds = seconds;
    std::string out = opened(label, axes, kHeight);
    for (const float s : chartTicks(seconds, 6)) {
        out += fmt::format("<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:g}\" y2=\"{2:g}\"/>\n",
                           axes.x(s), kTop, kBottom);
    }
    for (std::size_t i = 0; i < bars.size(); ++i) {
        const TimeBar& bar = bars[i];
        const float y = kTop + kRow * (static_cast<float>(i) + 0.5F) - kBar / 2;
        const float end = std::min(bar.endS.value_or(seconds), seconds);
        const auto rect = [&](const char* part, float from, float to) {
            out += fmt::format(
                "<rect class=\"{} series-{}\" x=\"{:.1f}\" width=\"{:.1f}\" y=\"{:.1f}\" height=\"{:g}\"/>\n", part,
                i + 1, axes.x(from), std::max(axes.x(to) - axes.x(from), 0.0F), y, kBar);
        };
        rect("air", 0, bar.beginS);
        rect(bar.endS ? "settling" : "settling never", bar.beginS, end);
        out += fmt::format("<text class=\"tick\" x=\"{:g}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", kLeft - 8,
                           y + kBar / 2 + 4, markupEscaped(bar.name));
        // Beside the bar where there is room, else on it.
        const std::string text = bar.endS ? fmt::format("{:.2f} s", *bar.endS - bar.beginS) : "never at rest";
        const bool beside = axes.x(end) + 60 < kRight;
        out += fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n",
                           beside ? "value" : "value inside", beside ? axes.x(end) + 7 : axes.x(end) - 7,
                           y + kBar / 2 + 4, beside ? "start" : "end", text);
    }
    addTimeAxis(axes, out);
    close(axes, out);
    return out;
}

}  // namespace lutka::reporting
