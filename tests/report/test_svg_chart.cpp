#include "report/svg_chart.hpp"

#include <limits>

#include "support/catch.hpp"

using namespace lutka::reporting;

namespace {

int occurrences(const std::string& text, const std::string& what) {
    int found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
        ++found;
    return found;
}

LineChart chartOf(const std::vector<float>& values, std::optional<float> bound) {
    return {"a label", "mm", 1.0F, bound, {{"first", values}}};
}

}  // namespace

TEST_CASE("ticks are round numbers from 0 to the top") {
    CHECK(chartTicks(6.0F, 6) == std::vector<float>{0, 1, 2, 3, 4, 5, 6});
    CHECK(chartTicks(2200.0F, 4) == std::vector<float>{0, 1000, 2000});
    CHECK(chartTicks(0.9F, 4).size() == 2);  // 0 and 0.5
    for (const float top : {1e-6F, 0.37F, 41.0F, 9.9e8F}) {
        const auto ticks = chartTicks(top, 4);
        CHECK(ticks.size() >= 2);
        CHECK(ticks.size() <= 6);
        CHECK(ticks.back() <= top * 1.001F);
    }
}

TEST_CASE("a chart's line begins at the left, ends at the right, and reaches up as its values do") {
    const std::string svg = lineChartSvg(chartOf({0, 5, 10}, std::nullopt));
    // 184 is the bottom; the top of the axis, at 22, stands for 8 % more than the largest value.
    CHECK_THAT(svg, Catch::Contains("d=\"M52.0 184.0L280.0 109.0L508.0 34.0\""));
    CHECK_THAT(svg, Catch::Contains("data-left=\"52\" data-right=\"508\" data-seconds=\"2\""));
    CHECK(svg == lineChartSvg(chartOf({0, 5, 10}, std::nullopt)));
}

TEST_CASE("a bound is drawn where it lies near the values, and does not flatten them where it is far above") {
    CHECK(occurrences(lineChartSvg(chartOf({0, 8}, 10.0F)), "class=\"bound\"") == 1);
    CHECK(occurrences(lineChartSvg(chartOf({0, 0.3F}, 10.0F)), "class=\"bound\"") == 0);
}

TEST_CASE("values that are no numbers leave gaps, and charts of nothing are still charts") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::string gap = lineChartSvg(chartOf({1, 1, nan, 1, 1}, std::nullopt));
    CHECK(occurrences(gap, "M") == 2);
    CHECK(gap.find("nan") == std::string::npos);
    CHECK_THAT(lineChartSvg(chartOf({}, std::nullopt)), Catch::Contains("</svg>"));
    CHECK_THAT(lineChartSvg(chartOf({0, 0}, std::nullopt)), Catch::Contains("</svg>"));
}

TEST_CASE("names in charts are escaped") {
    const std::vector<float> values{0, 1};  // a line looks at them
    LineChart chart = chartOf(values, std::nullopt);
    chart.label = "\"><script>";
    chart.lines.front().name = "<i>";
    CHECK(lineChartSvg(chart).find("<script>") == std::string::npos);
    CHECK_THAT(lineChartSvg(chart), Catch::Contains("<title>&lt;i&gt;</title>"));
}

TEST_CASE("a bar tells how long the way to rest took, or that it never ended") {
    const std::vector<TimeBar> bars = {{"Drop 1", 0.5F, 2.0F}, {"Drop 2", 0.5F, std::nullopt}};
    const std::string svg = timeBarsSvg("rest", bars, 6.0F);
    CHECK_THAT(svg, Catch::Contains(">1.50 s<") && Catch::Contains(">never at rest<"));
    CHECK_THAT(svg, Catch::Contains("class=\"settling never series-2\" x=\"90.0\" width=\"418.0\""));
}
