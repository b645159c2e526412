#include "animation/import/assimp/collada_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "animation/import/assimp/collada_sources.hpp"
#include "animation/import/assimp/collada_tags.hpp"
#include "animation/import/assimp/collada_text.hpp"

namespace lutka::animation::rig_import {
namespace {

constexpr double kSecondsAPiece = 1.0 / 60.0;
constexpr double kJump = 1e-4;  // seconds
// Of a document: many samplers may name one long source, so the file's size bounds nothing.
constexpr std::size_t kMostNumbers = 10'000'000;

// One curve of a sampler, all components together.
struct Curve {
    const std::vector<double>* times = nullptr;
    const ColladaSource* values = nullptr;
    const std::vector<std::string_view>* kinds = nullptr;  // one a key: of the way to the next; null: straight
    // Tangents as points of time and value for each component, or as values alone: then at thirds of the way.
    const ColladaSource* in = nullptr;
    const ColladaSource* out = nullptr;
    // Of a turn about an axis. Angles between keys are not what Assimp makes of the turns about several axes there.
    bool isAngle = false;

    [[nodiscard]] std::size_t width() const { return values->stride; }
    [[nodiscard]] double value(std::size_t key, std::size_t component) const {
        return values->numbers[key * width() + component];
    }
    [[nodiscard]] bool hasTimes(const ColladaSource& tangents) const {
        return tangents.numbers.size() >= times->size() * 2 * width();
    }
    [[nodiscard]] bool isSpline(std::size_t key) const {
        const auto fits = [&](const ColladaSource* tangents) {
            return tangents != nullptr && tangents->numbers.size() >= times->size() * width();
        };
        return (kindOf(key) == "BEZIER" || kindOf(key) == "HERMITE") && fits(in) && fits(out);
    }
    [[nodiscard]] std::string_view kindOf(std::size_t key) const {
        return kinds != nullptr ? (*kinds)[key] : std::string_view("LINEAR");
    }
    // Into how many pieces a straight turn from a key to the next is cut: of two degrees each. Where keys lie as near
    // as frames, the turn is baked already, and keys between them would hide how many frames a second has. An axis that
    // turns, too, is not cut: between keys it is no axis.
    [[nodiscard]] double piecesOfTurn(std::size_t key) const {
        constexpr double kPiece = 2.0;  // degrees
        constexpr double kMost = 10'000.0;
        constexpr double kFrame = 1.0 / 20.0 + 1e-4;  // seconds
        if (!isAngle || (width() != 1 && width() != 4) || (*times)[key + 1] - (*times)[key] <= kFrame) return 1.0;
        for (std::size_t axis = 0; axis + 1 < width(); ++axis) {
            if (!(std::abs(value(key + 1, axis) - value(key, axis)) < 1e-4)) return 1.0;
        }
        const std::size_t angle = width() - 1;
        return std::clamp(std::ceil(std::abs(value(key + 1, angle) - value(key, angle)) / kPiece), 1.0, kMost);
    }
    struct Point {
        double time = 0.0;
        double value = 0.0;
    };
    // The inner points of the Bezier curve from a key to the next. Hermite's tangents are three times the way there.
    [[nodiscard]] Point leaving(std::size_t key, std::size_t component, double start, double end) const {
        const double third = (end - start) / 3.0;
        if (kindOf(key) != "HERMITE") return tangent(*out, key, component, start + third);
        const Point way = tangent(*out, key, component, 3.0 * third);
        return {start + way.time / 3.0, value(key, component) + way.value / 3.0};
    }
    [[nodiscard]] Point arriving(std::size_t key, std::size_t component, double start, double end) const {
        const double third = (end - start) / 3.0;
        if (kindOf(key) != "HERMITE") return tangent(*in, key + 1, component, end - third);
        const Point way = tangent(*in, key + 1, component, 3.0 * third);
        return {end - way.time / 3.0, value(key + 1, component) - way.value / 3.0};
    }
    [[nodiscard]] Point tangent(const ColladaSource& tangents, std::size_t key, std::size_t component,
                                double third) const {
        const std::size_t place = key * width() + component;
        if (!hasTimes(tangents)) return {third, tangents.numbers[place]};
        return {tangents.numbers[2 * place], tangents.numbers[2 * place + 1]};
    }
};

// The value of a cubic Bezier curve over time: its four points, of which the time runs ahead.
double bezierAt(const std::array<double, 4>& times, const std::array<double, 4>& values, double time) {
    const auto at = [](const std::array<double, 4>& p, double s) {
        const double r = 1.0 - s;
        return r * r * r * p[0] + 3.0 * r * r * s * p[1] + 3.0 * r * s * s * p[2] + s * s * s * p[3];
    };
    double low = 0.0;
    double high = 1.0;
    constexpr int kHalvings = 40;
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        (at(times, middle) < time ? low : high) = middle;
    }
    return at(values, 0.5 * (low + high));
}

struct Pieces {
    std::vector<double> times;
    std::vector<double> values;

    // The key's values follow. `left` is of kMostNumbers.
    void beginKey(double time, const Curve& curve, std::size_t& left) {
        times.push_back(time);
        left -= std::min(left, curve.width() + 1);
    }
};

// The keys that come after a key and before the next.
void addBetween(const Curve& curve, std::size_t key, Pieces& pieces, std::size_t& left) {
    const double start = (*curve.times)[key];
    const double end = (*curve.times)[key + 1];
    if (!(end > start) || !std::isfinite(end - start)) return;
    if (curve.kindOf(key) == "STEP") {
        pieces.beginKey(end - std::min(kJump, 0.5 * (end - start)), curve, left);
        for (std::size_t c = 0; c < curve.width(); ++c)
            pieces.values.push_back(curve.value(key, c));
        return;
    }
    const bool isSpline = curve.isSpline(key);
    const double most = isSpline ? static_cast<double>(kMostNumbers) : curve.piecesOfTurn(key);
    const auto parts = static_cast<std::size_t>(std::min(std::ceil((end - start) / kSecondsAPiece - 0.01), most));
    for (std::size_t part = 1; part < parts && left > 0; ++part) {
        const double time = start + (end - start) * static_cast<double>(part) / static_cast<double>(parts);
        pieces.beginKey(time, curve, left);
        for (std::size_t c = 0; c < curve.width(); ++c) {
            if (!isSpline) {
                const double share = static_cast<double>(part) / static_cast<double>(parts);
                pieces.values.push_back(curve.value(key, c) + share * (curve.value(key + 1, c) - curve.value(key, c)));
                continue;
            }
            const Curve::Point out = curve.leaving(key, c, start, end);
            const Curve::Point in = curve.arriving(key, c, start, end);
            pieces.values.push_back(
                bezierAt({start, std::clamp(out.time, start, end), std::clamp(in.time, start, end), end},
                         {curve.value(key, c), out.value, in.value, curve.value(key + 1, c)}, time));
        }
    }
}

// Cut short where nothing is left.
Pieces piecesOf(const Curve& curve, std::size_t& left) {
    Pieces pieces;
    const std::size_t keys = std::min(curve.times->size(), curve.values->numbers.size() / curve.width());
    for (std::size_t key = 0; key < keys && left > 0; ++key) {
        pieces.beginKey((*curve.times)[key], curve, left);
        for (std::size_t c = 0; c < curve.width(); ++c)
            pieces.values.push_back(curve.value(key, c));
        if (key + 1 < keys) addBetween(curve, key, pieces, left);
    }
    return pieces;
}

// The samplers whose channels turn something about an axis: by its angle, or by all four numbers of a rotation.
std::set<std::string> angleSamplers(const std::vector<ColladaTag>& tags,
                                    const std::map<std::string, std::string>& outputs,
                                    const std::map<std::string, ColladaSource>& sources) {
    std::set<std::string> ids;
    for (const ColladaTag& tag : tags) {
        if (!tag.opens("channel")) continue;
        const std::string_view target = colladaAttribute(tag.text, "target");
        const std::string sampler = tag.target("source");
        const auto output = outputs.find(sampler);
        const auto source = output == outputs.end() ? sources.end() : sources.find(output->second);
        const bool isWhole = source != sources.end() && source->second.stride == 4 &&
                             target.find_first_of(".(") == std::string_view::npos;
        if (isWhole || target.ends_with(".ANGLE")) ids.insert(sampler);
    }
    return ids;
}

// The sources of the values of all samplers.
std::map<std::string, std::string> outputsOf(const std::vector<ColladaTag>& tags) {
    std::map<std::string, std::string> outputs;
    std::string sampler;
    for (const ColladaTag& tag : tags) {
        if (tag.opens("sampler")) sampler = colladaAttribute(tag.text, "id");
        if (!sampler.empty() && tag.opens("input") && colladaAttribute(tag.text, "semantic") == "OUTPUT")
            outputs[sampler] = tag.target("source");
    }
    return outputs;
}

// What stands in place of a sampler; empty where it stays: it is straight, or nothing is left of kMostNumbers.
std::string straightSampler(const std::string& id, const std::map<std::string, std::string>& inputs,
                            const std::map<std::string, ColladaSource>& sources, bool isAngle, std::size_t& left) {
    const auto source = [&](const char* semantic) -> const ColladaSource* {
        const auto input = inputs.find(semantic);
        const auto found = input == inputs.end() ? sources.end() : sources.find(input->second);
        return found == sources.end() ? nullptr : &found->second;
    };
    const ColladaSource* times = source("INPUT");
    const ColladaSource* values = source("OUTPUT");
    const ColladaSource* kinds = source("INTERPOLATION");
    if (times == nullptr || values == nullptr) return {};
    const bool hasKinds = kinds != nullptr && kinds->names.size() >= times->numbers.size();
    if (!isAngle && (!hasKinds || !kinds->bends)) return {};
    const Curve curve{&times->numbers,       values, hasKinds ? &kinds->names : nullptr, source("IN_TANGENT"),
                      source("OUT_TANGENT"), isAngle};
    left -= std::min(left, times->params.size() + values->params.size());  // written once more, too
    const Pieces pieces = piecesOf(curve, left);
    if (left == 0 || pieces.times.size() <= times->numbers.size()) return {};
    return colladaSourceText(id + "-times", pieces.times, 1, times->params) +
           colladaSourceText(id + "-values", pieces.values, curve.width(), values->params) +
           fmt::format(
               "<sampler id=\"{0}\"><input semantic=\"INPUT\" source=\"#{0}-times\"/><input "
               "semantic=\"OUTPUT\" source=\"#{0}-values\"/></sampler>",
               id);
}

}  // namespace

bool holdsOtherCurves(const ColladaDocument& document) {
    constexpr std::string_view kBlanks = " \t\r\n";
    bool inAnimations = false;
    for (std::size_t i = 0; i + 1 < document.tags.size(); ++i) {
        const ColladaTag& tag = document.tags[i];
        if (tag.opens("library_animations")) inAnimations = true;
        if (tag.closes("library_animations")) inAnimations = false;
        if (!inAnimations || !tag.opens("Name_array")) continue;  // joints have any names
        std::string_view inside = document.text.substr(tag.end, document.tags[i + 1].start - tag.end);
        while (!inside.empty()) {
            const std::string_view word = inside.substr(0, inside.find_first_of(kBlanks));
            if (word == "CARDINAL" || word == "BSPLINE") return true;
            inside.remove_prefix(std::min(word.size() + 1, inside.size()));
        }
    }
    return false;
}

StraightenedCollada straightenedCollada(std::string text) {
    const auto holds = [&](const char* word) { return text.find(word) != std::string::npos; };
    if (!holds("BEZIER") && !holds("HERMITE") && !holds("STEP") && !holds(".ANGLE\"") && !holds("stride=\"4\""))
        return {std::move(text)};
    const std::vector<ColladaTag> tags = colladaTags(text);
    const std::map<std::string, ColladaSource> sources = colladaSources(text, tags);
    const std::set<std::string> angles = angleSamplers(tags, outputsOf(tags), sources);
    std::size_t left = kMostNumbers;
    ColladaEdits edits(text);
    for (std::size_t i = 0; i < tags.size(); ++i) {
        if (!tags[i].opens("sampler") || tags[i].isEmpty()) continue;
        const std::optional<std::size_t> past = pastColladaElement(tags, i, "sampler");
        if (!past) break;
        std::map<std::string, std::string> inputs;
        for (std::size_t input = i + 1; input < *past; ++input) {
            if (tags[input].opens("input"))
                inputs[std::string(colladaAttribute(tags[input].text, "semantic"))] = tags[input].target("source");
        }
        const std::string id(colladaAttribute(tags[i].text, "id"));
        const bool isAngle = angles.count(id) > 0;
        const std::string straight = id.empty() ? std::string() : straightSampler(id, inputs, sources, isAngle, left);
        if (!straight.empty()) edits.replace(tags[i].start, tags[*past - 1].end, straight);
        i = *past - 1;
    }
    return {edits.take(), left > 0};
}

}  // namespace lutka::animation::rig_import
