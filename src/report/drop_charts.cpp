#include "report/drop_charts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/markup_text.hpp"
#include "report/svg_chart.hpp"

namespace lutka::reporting {
namespace {

std::string figure(const std::string& title, const std::string& svg, const std::string& caption) {
    return fmt::format("<figure><h3>{}</h3>\n{}\n<figcaption>{}</figcaption></figure>\n", title, svg, caption);
}

std::string dropName(std::size_t drop) {
    return fmt::format("Drop {}", drop + 1);
}

const scene::MeasuredBound* boundNamed(const scene::Checkup& checkup, std::string_view name) {
    const auto found = std::find_if(checkup.bounds.begin(), checkup.bounds.end(),
                                    [&](const scene::MeasuredBound& bound) { return bound.name == name; });
    return found == checkup.bounds.end() ? nullptr : &*found;
}

std::vector<float> scaled(std::span<const float> values, float factor) {
    std::vector<float> out(values.begin(), values.end());
    for (float& value : out)
        value *= factor;
    return out;
}

std::string lines(const std::string& label, const std::string& unit, std::span<const DropTrace> drops,
                  std::vector<float> DropTrace::*member, float factor, std::optional<float> bound) {
    std::vector<std::vector<float>> values;
    for (const DropTrace& drop : drops)
        values.push_back(scaled(drop.*member, factor));
    LineChart chart{label, unit, drops.front().dt, bound, {}};
    for (std::size_t i = 0; i < values.size(); ++i)
        chart.lines.push_back({dropName(i), values[i]});
    return lineChartSvg(chart);
}

std::string worstText(const scene::MeasuredBound& bound, std::string_view what) {
    return fmt::format("{} {:.2f} {} after any substep; {:g} {} are allowed.", what, bound.worst,
                       markupEscaped(bound.unit), bound.bound, markupEscaped(bound.unit));
}

std::string settleFigure(const scene::Checkup& checkup, std::span<const DropTrace> drops) {
    std::vector<TimeBar> bars;
    for (std::size_t i = 0; i < drops.size(); ++i) {
        const float begin = drops[i].firstContactS.value_or(0.0F);
        const auto& settle = checkup.drops[i].settleSeconds;
        bars.push_back({dropName(i), begin, settle ? std::optional(begin + *settle) : std::nullopt});
    }
    const float seconds = drops.front().dt * static_cast<float>(drops.front().energyJ.size() - 1);
    return figure("Time to rest", timeBarsSvg("Time to rest of each drop", bars, seconds),
                  "Light: in the air. Solid: from the first contact until every body is asleep or slower than 1 cm/s.");
}

}  // namespace

std::string dropChartsHtml(const scene::Checkup& checkup, std::span<const DropTrace> drops) {
    if (drops.empty()) return "";
    std::string out = "<div class=\"legend\">";
    for (std::size_t i = 0; i < drops.size(); ++i)
        out += fmt::format("<span class=\"key series-{}\">{}</span>", i + 1, dropName(i));
    out += "</div>\n<div class=\"charts\">\n";
    const scene::MeasuredBound* growth = boundNamed(checkup, "energy growth");
    out += figure(
        "Energy", lines("Energy over time", "J", drops, &DropTrace::energyJ, 1.0F, std::nullopt),
        growth == nullptr
            ? std::string("Kinetic and potential, over the floor.")
            : fmt::format("Kinetic and potential, over the floor. It never rises by more than {:.2f} {} above "
                          "what was left; {:g} {} are allowed.",
                          growth->worst, markupEscaped(growth->unit), growth->bound, markupEscaped(growth->unit)));
    const scene::MeasuredBound* separation = boundNamed(checkup, "joint separation");
    out += figure(
        "Joint separation",
        lines("Widest joint separation over time", "mm", drops, &DropTrace::separationM, 1e3F,
              separation == nullptr ? std::nullopt : std::optional(separation->bound)),
        separation == nullptr ? "" : worstText(*separation, "The widest of all joints, after each step. Worst:"));
    const scene::MeasuredBound* violation = boundNamed(checkup, "limit violation, lasting");
    out += figure("Limit violation",
                  lines("Farthest limit violation over time", "deg", drops, &DropTrace::violationDeg, 1.0F,
                        violation == nullptr ? std::nullopt : std::optional(violation->bound)),
                  violation == nullptr
                      ? ""
                      : fmt::format("The farthest of all joints, after each step. A single joint kept up {:.2f} {} for "
                                    "two frames at worst; {:g} {} are allowed.",
                                    violation->worst, markupEscaped(violation->unit), violation->bound,
                                    markupEscaped(violation->unit)));
    out += settleFigure(checkup, drops);
    return out + "</div>\n";
}

}  // namespace lutka::reporting
