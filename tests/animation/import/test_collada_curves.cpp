// Collada's curves that are no straight lines from key to key, which is all that Assimp plays.

#include <glm/geometric.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "animation/import/assimp/collada_curves.hpp"
#include "animation/import/assimp/collada_ids.hpp"
#include "animation/import/assimp/collada_nodes.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

std::string sourceOf(const std::string& id, const std::string& numbers, int stride) {
    return "<source id=\"" + id + "\"><float_array id=\"" + id + "-array\">" + numbers +
           "</float_array><accessor source=\"#" + id + "-array\" stride=\"" + std::to_string(stride) +
           "\"><param name=\"P\" type=\"float\"/></accessor></source>";
}

// A curve from 0 to 10 and on to 4, at 0, 1 and 1.5 s.
std::string curveOf(const std::string& kinds, const std::string& more) {
    return "<library_animations><animation>" + sourceOf("t", "0 1 1.5", 1) + sourceOf("v", "0 10 4", 1) +
           sourceOf("in", "-1 0 0.6 10 1.2 4", 2) + sourceOf("out", "0.4 0 1.3 10 2 4", 2) +
           "<source id=\"k\"><Name_array id=\"ka\">" + kinds +
           "</Name_array></source><sampler id=\"s\"><input semantic=\"INPUT\" source=\"#t\"/><input "
           "semantic=\"OUTPUT\" source=\"#v\"/><input semantic=\"INTERPOLATION\" source=\"#k\"/>" +
           more + "</sampler></animation></library_animations>";
}

constexpr const char* kTangents =
    "<input semantic=\"IN_TANGENT\" source=\"#in\"/><input semantic=\"OUT_TANGENT\" source=\"#out\"/>";

std::vector<double> numbersOf(const std::string& text, const std::string& id) {
    const std::string array = "<float_array id=\"" + id + "-array\"";
    const std::size_t tag = text.find(array);
    REQUIRE(tag != std::string::npos);
    const std::size_t start = text.find('>', tag) + 1;
    std::istringstream in(text.substr(start, text.find('<', start) - start));
    std::vector<double> numbers;
    for (double number = 0.0; in >> number;)
        numbers.push_back(number);
    return numbers;
}

}  // namespace

TEST_CASE("a stepped Collada curve holds its keys until the next") {
    const std::string text = rig_import::straightenedCollada(curveOf("STEP STEP STEP", "")).text;
    const std::vector<double> times = numbersOf(text, "s-times");
    const std::vector<double> values = numbersOf(text, "s-values");
    CHECK(values == std::vector<double>{0, 0, 10, 10, 4});
    REQUIRE(times.size() == 5);
    CHECK(times[1] == Approx(1.0).margin(2e-4));
    CHECK(times[1] < 1.0);
    CHECK(times[3] < 1.5);
    CHECK(text.find("<sampler id=\"s\"><input semantic=\"INPUT\" source=\"#s-times\"/>") != std::string::npos);
}

TEST_CASE("a Collada spline follows its tangents, be its segments of different kinds or not") {
    const std::string text = rig_import::straightenedCollada(curveOf("BEZIER LINEAR BEZIER", kTangents)).text;
    const std::vector<double> times = numbersOf(text, "s-times");
    const std::vector<double> values = numbersOf(text, "s-values");
    REQUIRE(times.size() == values.size());
    CHECK(times.size() == 62);  // 60 pieces of the first second, one straight one after it
    for (std::size_t i = 0; i + 1 < times.size(); ++i) {
        CHECK(times[i] < times[i + 1]);
        if (times[i] > 1.0) continue;
        // Points 0, 0.4, 0.6 and 1 of time, values 0, 0, 10 and 10: found by small steps along the curve.
        double nearest = 9.0;
        double there = 0.0;
        for (int k = 0; k <= 20'000; ++k) {
            const double s = k / 20'000.0;
            const double r = 1.0 - s;
            const double time = 3 * r * r * s * 0.4 + 3 * r * s * s * 0.6 + s * s * s;
            if (std::abs(time - times[i]) >= nearest) continue;
            nearest = std::abs(time - times[i]);
            there = 10.0 * (3 * r * s * s + s * s * s);
        }
        CHECK(values[i] == Approx(there).margin(5e-3));
    }
    CHECK(values.back() == 4.0);
}

TEST_CASE("a Collada curve of Hermite's kind leaves and reaches its keys along its tangents") {
    // From 0 to 10 in the first second, along tangents of a second's way and 6 up, and 0 up.
    std::string curve = curveOf("HERMITE HERMITE LINEAR", kTangents);
    const auto give = [&](const std::string& from, const std::string& to) {
        const std::size_t place = curve.find(from);
        REQUIRE(place != std::string::npos);
        curve.replace(place, from.size(), to);
    };
    give("-1 0 0.6 10 1.2 4", "1 0 1 0 0.5 0");
    give("0.4 0 1.3 10 2 4", "1 6 0.5 0 1 0");
    const std::string text = rig_import::straightenedCollada(curve).text;
    const std::vector<double> times = numbersOf(text, "s-times");
    const std::vector<double> values = numbersOf(text, "s-values");
    REQUIRE(times.size() == values.size());
    REQUIRE(times.size() > 60);
    for (std::size_t i = 0; i < 60; ++i) {
        const double t = times[i];
        INFO(t);
        CHECK(values[i] == Approx(10 * (3 * t * t - 2 * t * t * t) + 6 * (t * t * t - 2 * t * t + t)).margin(1e-5));
    }
}

TEST_CASE("a Collada channel may name the angle of a rotation by its place or in small letters") {
    const std::string start =
        "<node id=\"A\"><rotate sid=\"r\">0 0 1 0</rotate><matrix sid=\"m\"/><translate sid=\"t\"/>"
        "<rotate sid=\"rotate.x\">1 0 0 0</rotate><rotate>0 1 0 0</rotate></node>";
    const auto plain = [&](const std::string& target) {
        const std::string text =
            rig_import::settledCollada(start + "<channel source=\"#s\" target=\"" + target + "\"/>").text;
        const std::size_t place = text.find("target=\"") + 8;
        return text.substr(place, text.find('"', place) - place);
    };
    CHECK(plain("A/r(3)") == "A/r.ANGLE");
    CHECK(plain("A/r.angle") == "A/r.ANGLE");
    CHECK(plain("A/t.x") == "A/t.X");
    CHECK(plain("A/t(0)") == "A/t.X");
    for (const char* kept : {"A/r.ANGLE", "A/m(3)", "A/m(3)(0)", "A/r"})
        CHECK(plain(kept) == kept);
    CHECK(plain("A/rotate.x") != "A/rotate.X");  // a dot may belong to the name
    CHECK(plain("A/rotate.x(3)") == plain("A/rotate.x.ANGLE"));
    CHECK(plain("A/rotate.x(3)").find(".ANGLE") != std::string::npos);
}

TEST_CASE("tangents of a Collada spline that are values alone stand at thirds of the way") {
    std::string text = curveOf("BEZIER LINEAR LINEAR", kTangents);
    const auto replace = [&](const std::string& what, const std::string& with) {
        text.replace(text.find(what), what.size(), with);
    };
    replace(sourceOf("in", "-1 0 0.6 10 1.2 4", 2), sourceOf("in", "0 8 4", 1));
    replace(sourceOf("out", "0.4 0 1.3 10 2 4", 2), sourceOf("out", "6 10 4", 1));
    const std::string straight = rig_import::straightenedCollada(text).text;
    const std::vector<double> times = numbersOf(straight, "s-times");
    const std::vector<double> values = numbersOf(straight, "s-values");
    REQUIRE(times.size() == 62);
    CHECK(times[30] == Approx(0.5));
    CHECK(values[30] == Approx((0.0 + 3 * 6.0 + 3 * 8.0 + 10.0) / 8.0));
    CHECK(values[60] == Approx(10.0));
}

TEST_CASE("each channel of a Collada animation has a sampler of its own") {
    const auto channel = [](const std::string& sampler, const std::string& target) {
        return "<channel source=\"#" + sampler + "\" target=\"" + target + "\"/>";
    };
    const std::string text = curveOf("LINEAR LINEAR LINEAR", "") + channel("s", "n/move.X");
    CHECK(rig_import::withOwnSamplers(text) == text);
    const std::string sampler = text.substr(text.find("<sampler"), text.find("</animation>") - text.find("<sampler"));
    const auto called = [&](const std::string& id) {
        std::string copy = sampler;
        copy.replace(copy.find("\"s\""), 3, "\"" + id + "\"");
        return copy;
    };
    CHECK(rig_import::withOwnSamplers(text + channel("s", "n/move.Y") + channel("no", "n/a") + channel("s", "n/b")) ==
          text + called("s-1") + channel("s-1", "n/move.Y") + channel("no", "n/a") + called("s-2") +
              channel("s-2", "n/b"));
}

TEST_CASE("turns about an axis that a Collada curve makes between far keys are cut into small ones") {
    const std::string channel = "<channel source=\"#s\" target=\"n/turnX.ANGLE\"/>";
    const std::string text = rig_import::straightenedCollada(curveOf("LINEAR LINEAR LINEAR", "") + channel).text;
    const std::vector<double> times = numbersOf(text, "s-times");
    const std::vector<double> values = numbersOf(text, "s-values");
    REQUIRE(times.size() == 9);  // 5 pieces of 2 degrees, and 3 on to 4
    for (std::size_t i = 0; i < times.size(); ++i)
        CHECK(values[i] == Approx(times[i] <= 1.0 ? 10.0 * times[i] : 10.0 - 12.0 * (times[i] - 1.0)));
    const std::string place = "<channel source=\"#s\" target=\"n/place.X\"/>";
    CHECK(rig_import::straightenedCollada(curveOf("LINEAR LINEAR LINEAR", "") + place).text ==
          curveOf("LINEAR LINEAR LINEAR", "") + place);
}

TEST_CASE("turns about an axis that a Collada curve has a key for at each frame keep these keys") {
    const std::string channel = "<channel source=\"#s\" target=\"n/turnX.ANGLE\"/>";
    std::string baked = curveOf("LINEAR LINEAR LINEAR", "") + channel;
    baked.replace(baked.find("0 1 1.5"), 7, "0 0.0416667 0.0833333");
    CHECK(rig_import::straightenedCollada(baked).text == baked);
}

TEST_CASE("Collada samplers without an end are looked through once") {
    // Tens of thousands, each of which would be looked for to the end of the document.
    std::string open = "<library_animations><animation>";
    for (int i = 0; i < 60'000; ++i)
        open += "<sampler id=\"s\">";
    open += "<channel source=\"#s\" target=\"n/turnX.ANGLE\"/>";
    CHECK(rig_import::withOwnSamplers(open) == open);
    CHECK(rig_import::straightenedCollada(open).text == open);
}

TEST_CASE("straight Collada curves, and splines without tangents, stay as they are") {
    for (const std::string& text : {curveOf("LINEAR LINEAR LINEAR", ""), curveOf("BEZIER BEZIER BEZIER", ""),
                                    curveOf("STEP", ""), std::string("<sampler>STEP"), std::string("STEP")})
        CHECK(rig_import::straightenedCollada(text).text == text);
}

// A curve of 100,000 keys that `samplers` samplers name.
std::string manyCurves(std::size_t samplers) {
    std::string text = curveOf("STEP STEP STEP", "");
    const auto replace = [&](const std::string& what, const std::string& with) {
        text.replace(text.find(what), what.size(), with);
    };
    std::string times;
    std::string kinds;
    std::string values;
    for (int i = 0; i < 100'000; ++i) {
        times += std::to_string(i) + " ";
        kinds += "STEP ";
        values += "1 ";
    }
    replace("0 1 1.5", times);
    replace("0 10 4", values);
    replace("STEP STEP STEP", kinds);
    const std::size_t start = text.find("<sampler");
    const std::string sampler = text.substr(start, text.find("</animation>") - start);
    for (std::size_t i = 1; i < samplers; ++i)
        text.insert(start, sampler);
    return text;
}

TEST_CASE("Collada's curves that would be too many numbers stay, which is told") {
    CHECK(rig_import::straightenedCollada(manyCurves(2)).isWhole);
    const std::string many = manyCurves(100);
    const rig_import::StraightenedCollada out = rig_import::straightenedCollada(many);
    CHECK_FALSE(out.isWhole);
    CHECK(out.text.size() < many.size() + 100'000'000);
    CHECK(out.text.find("<sampler id=\"s\"><input semantic=\"INPUT\" source=\"#s-times\"/>") != std::string::npos);
    CHECK(out.text.find("<sampler id=\"s\"><input semantic=\"INPUT\" source=\"#t\"/>") != std::string::npos);
    // What stands in an accessor counts, too, for many samplers would repeat it; and so does one curve of ten years.
    std::string text = curveOf("BEZIER STEP STEP", kTangents);
    text.insert(text.find("<param"), std::string(9'950'000, ' '));
    CHECK(rig_import::straightenedCollada(text).isWhole);
    text.replace(text.find("0 1 1.5"), 7, "0 3e8 4e8");
    CHECK_FALSE(rig_import::straightenedCollada(text).isWhole);
}

TEST_CASE("a Collada sampler in a sampler does not write the document twice") {
    std::string text = curveOf("STEP STEP STEP", "");
    const std::size_t start = text.find("<sampler");
    const std::string sampler = text.substr(start, text.find("</animation>") - start);
    text.insert(text.find("</sampler>"), sampler);
    const std::string out = rig_import::straightenedCollada(text).text;
    CHECK(out.find("</library_animations>") == out.rfind("</library_animations>"));
}

TEST_CASE("a source without the text of an accessor takes nothing of a later one") {
    std::string text = curveOf("STEP STEP STEP", "");
    const std::size_t start = text.find("<param", text.find("#v-array\" stride"));
    text.replace(start - 1, text.find("</source>", start) - start + 1, "/>");
    const std::string out = rig_import::straightenedCollada(text).text;
    const std::size_t values = out.find("<source id=\"s-values\"");
    REQUIRE(values != std::string::npos);
    CHECK(out.substr(values, out.find("</source>", values) - values)
              .ends_with("stride=\"1\"></accessor></technique_common>"));
}

TEST_CASE("Collada's curves are read whole or not at all") {
    const auto withValues = [](const std::string& values) {
        std::string text = curveOf("STEP STEP STEP", "");
        text.replace(text.find("0 10 4"), 6, values);
        return text;
    };
    CHECK(numbersOf(rig_import::straightenedCollada(withValues("0 +10 4")).text, "s-values") ==
          std::vector<double>{0, 0, 10, 10, 4});
    for (const std::string values : {"0 ten 4 7", "0 10 1e999", "0 10 <!-- and --> 4", "<![CDATA[0 10 4]]>"})
        CHECK(rig_import::straightenedCollada(withValues(values)).text == withValues(values));
    const std::string cut = curveOf("STEP <!-- and --> STEP STEP", "");
    CHECK(rig_import::straightenedCollada(cut).text == cut);
}

TEST_CASE("Collada curves that stay straight though they bend are told") {
    const auto holds = [](const std::string& kinds) {
        const std::string text = curveOf(kinds, "");
        return rig_import::holdsOtherCurves(rig_import::ColladaDocument(text));
    };
    CHECK(holds("LINEAR CARDINAL LINEAR"));
    CHECK(holds("BSPLINE BSPLINE BSPLINE"));
    CHECK_FALSE(holds("LINEAR HERMITE BEZIER"));
    CHECK_FALSE(holds("LINEAR CARDINALIS LINEAR"));
    const std::string joints = "<library_controllers><Name_array>A CARDINAL</Name_array></library_controllers>";
    CHECK_FALSE(rig_import::holdsOtherCurves(rig_import::ColladaDocument(joints)));
}
