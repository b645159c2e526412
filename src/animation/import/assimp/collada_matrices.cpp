#include "animation/import/assimp/collada_matrices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "animation/import/assimp/collada_nodes.hpp"
#include "animation/import/assimp/collada_sources.hpp"
#include "animation/import/assimp/collada_tags.hpp"
#include "animation/import/assimp/collada_text.hpp"

namespace lutka::animation::rig_import {
namespace {

constexpr std::size_t kMostOfMatrices = 10'000'000;  // of a document
constexpr std::size_t kNumbers = 16;                 // of a matrix, row after row

// A channel of one number of a matrix.
struct MatrixNumber {
    std::size_t tag = 0;
    std::size_t place = 0;  // the number that is meant where the first index is the row's
    const ColladaSource* times = nullptr;
    const ColladaSource* values = nullptr;

    [[nodiscard]] std::size_t keys() const { return std::min(times->numbers.size(), values->numbers.size()); }
    [[nodiscard]] double at(double time) const {
        const auto end = times->numbers.begin() + static_cast<std::ptrdiff_t>(keys());
        const auto next = std::upper_bound(times->numbers.begin(), end, time);
        const auto after = static_cast<std::size_t>(next - times->numbers.begin());
        if (after == 0) return values->numbers.front();
        if (after == keys()) return values->numbers[after - 1];
        const double span = times->numbers[after] - times->numbers[after - 1];
        const double share = (time - times->numbers[after - 1]) / span;
        return values->numbers[after - 1] + share * (values->numbers[after] - values->numbers[after - 1]);
    }
};

std::size_t transposed(std::size_t place) {
    return place % 4 * 4 + place / 4;
}

// The number that "(1)(3)" or "(7)" calls.
std::optional<std::size_t> numberCalled(std::string_view member) {
    std::array<std::size_t, 2> indices{};
    std::size_t count = 0;
    while (!member.empty() && count < indices.size()) {
        const auto [end, error] = std::from_chars(member.data() + 1, member.data() + member.size(), indices[count++]);
        if (error != std::errc() || *end != ')') return std::nullopt;
        member.remove_prefix(static_cast<std::size_t>(end - member.data()) + 1);
    }
    if (!member.empty()) return std::nullopt;
    if (count == 1) return indices[0] < kNumbers ? std::optional(indices[0]) : std::nullopt;
    return indices[0] < 4 && indices[1] < 4 ? std::optional(4 * indices[0] + indices[1]) : std::nullopt;
}

// How far the last row goes from 0 0 0 1.
double offAffine(const std::vector<MatrixNumber>& elements, bool transpose) {
    double worst = 0.0;
    for (const MatrixNumber& element : elements) {
        const std::size_t place = transpose ? transposed(element.place) : element.place;
        if (place < 12) continue;
        for (const double value : element.values->numbers)
            worst = std::max(worst, std::abs(value - (place == 15 ? 1.0 : 0.0)));
    }
    return worst;
}

// The channels of one animation that move one matrix.
struct AnimatedMatrix {
    std::string target;  // id/sid
    std::vector<double> rest;
    std::vector<MatrixNumber> elements;
};

std::map<std::string, std::pair<std::string, std::string>> samplersOf(const std::vector<ColladaTag>& tags) {
    std::map<std::string, std::pair<std::string, std::string>> samplers;  // id → sources of times and values
    std::pair<std::string, std::string>* sampler = nullptr;
    for (const ColladaTag& tag : tags) {
        if (tag.opens("sampler")) sampler = &samplers[std::string(colladaAttribute(tag.text, "id"))];
        if (tag.closes("sampler")) sampler = nullptr;
        if (sampler == nullptr || !tag.opens("input")) continue;
        if (colladaAttribute(tag.text, "semantic") == "INPUT") sampler->first = tag.target("source");
        if (colladaAttribute(tag.text, "semantic") == "OUTPUT") sampler->second = tag.target("source");
    }
    return samplers;
}

std::map<std::string, std::vector<double>> matricesOf(const ColladaDocument& document) {
    std::map<std::string, std::vector<double>> matrices;  // by id/sid
    const ColladaNodes nodes(document.tags);
    for (const ColladaNode& node : nodes.all()) {
        for (const ColladaTransform& transform : node.transforms) {
            if (transform.kind != "matrix" || transform.tag + 1 >= document.tags.size()) continue;
            const std::size_t start = document.tags[transform.tag].end;
            std::vector<double> numbers =
                colladaNumbers(document.text.substr(start, document.tags[transform.tag + 1].start - start));
            if (numbers.size() == kNumbers)
                matrices.emplace(fmt::format("{}/{}", node.id, transform.sid), std::move(numbers));
        }
    }
    return matrices;
}

std::vector<AnimatedMatrix> groupsOf(const ColladaDocument& document,
                                     const std::map<std::string, ColladaSource>& sources) {
    const auto samplers = samplersOf(document.tags);
    const auto matrices = matricesOf(document);
    std::map<std::pair<std::size_t, std::string>, AnimatedMatrix> groups;
    std::vector<std::size_t> open;  // animations
    for (std::size_t i = 0; i < document.tags.size(); ++i) {
        const ColladaTag& tag = document.tags[i];
        if (tag.opens("animation") && !tag.isEmpty()) open.push_back(i);
        if (tag.closes("animation") && !open.empty()) open.pop_back();
        if (!tag.opens("channel")) continue;
        const std::string_view target = colladaAttribute(tag.text, "target");
        const std::size_t bracket = target.find('(');
        if (bracket == std::string_view::npos) continue;
        const std::string whole(target.substr(0, bracket));
        const auto place = numberCalled(target.substr(bracket));
        const auto rest = matrices.find(whole);
        const auto sampler = samplers.find(tag.target("source"));
        if (!place || rest == matrices.end() || sampler == samplers.end()) continue;
        const auto times = sources.find(sampler->second.first);
        const auto values = sources.find(sampler->second.second);
        if (times == sources.end() || values == sources.end()) continue;
        const MatrixNumber element{i, *place, &times->second, &values->second};
        if (values->second.stride != 1 || element.keys() == 0) continue;
        AnimatedMatrix& group = groups[{open.empty() ? 0 : open.back(), whole}];
        group.target = whole;
        group.rest = rest->second;
        group.elements.push_back(element);
    }
    std::vector<AnimatedMatrix> out;
    out.reserve(groups.size());
    for (auto& [key, group] : groups)
        out.push_back(std::move(group));
    return out;
}

std::vector<double> timesOf(const AnimatedMatrix& group) {
    std::vector<double> times;
    for (const MatrixNumber& element : group.elements) {
        const auto first = element.times->numbers.begin();
        times.insert(times.end(), first, first + static_cast<std::ptrdiff_t>(element.keys()));
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

std::string channelOf(const AnimatedMatrix& group, const std::vector<double>& times, const std::string& id) {
    const bool transpose = offAffine(group.elements, false) > offAffine(group.elements, true) + 1e-4;
    std::vector<double> values;
    values.reserve(times.size() * kNumbers);
    for (const double time : times) {
        const std::size_t first = values.size();
        values.insert(values.end(), group.rest.begin(), group.rest.end());
        for (const MatrixNumber& element : group.elements)
            values[first + (transpose ? transposed(element.place) : element.place)] = element.at(time);
    }
    return colladaSourceText(id + "-times", times, 1, "<param name=\"TIME\" type=\"float\"/>") +
           colladaSourceText(id + "-values", values, kNumbers, "<param name=\"TRANSFORM\" type=\"float4x4\"/>") +
           fmt::format(
               "<sampler id=\"{0}\"><input semantic=\"INPUT\" source=\"#{0}-times\"/><input semantic=\"OUTPUT\" "
               "source=\"#{0}-values\"/></sampler><channel source=\"#{0}\" target=\"{1}\"/>",
               id, group.target);
}

}  // namespace

StraightenedCollada withWholeMatrices(std::string text) {
    if (text.find(")\"") == std::string::npos || text.find("<channel") == std::string::npos) return {std::move(text)};
    const ColladaDocument document(text);
    const std::map<std::string, ColladaSource> sources = colladaSources(text, document.tags);
    std::size_t left = kMostOfMatrices;
    ColladaChanges changes;
    for (const AnimatedMatrix& group : groupsOf(document, sources)) {
        const std::vector<double> times = timesOf(group);
        left -= std::min(left, times.size() * (kNumbers + 1));
        if (left == 0) break;
        for (std::size_t i = 0; i < group.elements.size(); ++i) {
            const std::size_t at = group.elements[i].tag;
            const ColladaTag& tag = document.tags[at];
            const bool closes =
                !tag.isEmpty() && at + 1 < document.tags.size() && document.tags[at + 1].closes("channel");
            changes.push_back({tag.start, closes ? document.tags[at + 1].end : tag.end,
                               i > 0 ? "" : channelOf(group, times, fmt::format("own-matrix-{}", changes.size()))});
        }
    }
    std::sort(changes.begin(), changes.end(),
              [](const ColladaChange& a, const ColladaChange& b) { return a.start < b.start; });
    ColladaEdits edits(text);
    for (const ColladaChange& change : changes)
        edits.replace(change.start, change.end, change.with);
    return {edits.take(), left > 0};
}

}  // namespace lutka::animation::rig_import
