#include "animation/import/assimp/collada_sources.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "animation/import/assimp/collada_text.hpp"

namespace lutka::animation::rig_import {
namespace {

std::vector<std::string_view> splitWords(std::string_view text) {
    std::vector<std::string_view> words;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        words.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return words;
}

}  // namespace

std::vector<double> colladaNumbers(std::string_view text) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    while (at != end) {
        double number = 0.0;
        if (*at == '+') ++at;  // which from_chars refuses
        const auto [next, error] = std::from_chars(at, end, number);
        if (error != std::errc()) return {};
        numbers.push_back(number);
        at = std::find_if(next, end, [](char c) { return c != ' '; });
    }
    return numbers;
}

std::map<std::string, ColladaSource> colladaSources(std::string_view text, const std::vector<ColladaTag>& tags) {
    std::map<std::string, ColladaSource> sources;
    ColladaSource* source = nullptr;
    const ColladaTag* accessor = nullptr;  // that is open
    bool inAnimations = false;
    for (std::size_t i = 0; i + 1 < tags.size(); ++i) {
        const ColladaTag& tag = tags[i];
        if (tag.opens("library_animations")) inAnimations = true;
        if (tag.closes("library_animations")) inAnimations = false;
        if (!inAnimations) continue;
        if (tag.opens("source")) {
            source = &sources[std::string(colladaAttribute(tag.text, "id"))];
            accessor = nullptr;
        }
        if (source == nullptr) continue;
        std::string_view inside = text.substr(tag.end, tags[i + 1].start - tag.end);
        if (inside.find('<') != std::string_view::npos) inside = {};  // a comment cuts it
        if (tag.opens("float_array")) source->numbers = colladaNumbers(inside);
        if (tag.opens("Name_array")) {
            source->names = splitWords(inside);
            source->bends = std::any_of(source->names.begin(), source->names.end(), [](std::string_view name) {
                return name == "STEP" || name == "BEZIER" || name == "HERMITE";
            });
        }
        if (tag.opens("accessor")) {
            const std::string_view stride = colladaAttribute(tag.text, "stride");
            std::from_chars(stride.data(), stride.data() + stride.size(), source->stride);
            source->stride = std::max<std::size_t>(source->stride, 1);
            accessor = tag.isEmpty() ? nullptr : &tag;
        }
        if (tag.closes("accessor") && accessor != nullptr) {
            source->params = text.substr(accessor->end, tag.start - accessor->end);
            accessor = nullptr;
        }
    }
    return sources;
}

std::string withPlainParams(const std::string& text) {
    if (text.find("<library_animations") == std::string::npos) return text;
    const std::vector<ColladaTag> tags = colladaTags(text);
    ColladaEdits edits(text);
    bool inAnimations = false;
    bool areNumbers = false;
    for (std::size_t i = 0; i < tags.size(); ++i) {
        const ColladaTag& tag = tags[i];
        if (tag.opens("library_animations")) inAnimations = !tag.isEmpty();
        if (tag.closes("library_animations")) inAnimations = false;
        if (tag.opens("float_array") || tag.opens("Name_array")) areNumbers = tag.opens("float_array");
        if (!inAnimations || !areNumbers || !tag.opens("accessor")) continue;
        std::size_t stride = 1;
        const std::string_view stated = colladaAttribute(tag.text, "stride");
        std::from_chars(stated.data(), stated.data() + stated.size(), stride);
        const auto past = tag.isEmpty() ? std::optional(i + 1) : pastColladaElement(tags, i, "accessor");
        if (!past) break;
        std::size_t numbers = 0;
        for (std::size_t param = i + 1; param < *past; ++param) {
            const std::string_view type = colladaAttribute(tags[param].text, "type");
            if (tags[param].opens("param") && !type.empty()) numbers += type == "float4x4" ? 16 : 1;
        }
        constexpr std::size_t kMost = 64;
        const std::size_t end = tags[*past - 1].end;
        i = *past - 1;
        if (numbers == stride || stride == 0 || stride > kMost) continue;
        std::string plain(tag.text.substr(0, tag.text.size() - (tag.isEmpty() ? 2 : 1)));
        plain += '>';
        for (std::size_t param = 0; param < stride; ++param)
            plain += "<param type=\"float\"/>";
        edits.replace(tag.start, end, plain + "</accessor>");
    }
    return edits.take();
}

std::string colladaSourceText(const std::string& id, const std::vector<double>& numbers, std::size_t stride,
                              std::string_view params) {
    std::string text =
        fmt::format("<source id=\"{0}\"><float_array id=\"{0}-array\" count=\"{1}\">", id, numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i)
        text += fmt::format("{}{:.9g}", i > 0 ? " " : "", numbers[i]);
    return text + fmt::format(
                      "</float_array><technique_common><accessor source=\"#{}-array\" count=\"{}\" stride=\"{}\">{}"
                      "</accessor></technique_common></source>",
                      id, numbers.size() / stride, stride, params);
}

}  // namespace lutka::animation::rig_import
