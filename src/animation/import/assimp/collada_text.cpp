#include "animation/import/assimp/collada_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>
#include <system_error>
#include <utility>
#include <vector>

#include "core/utf8.hpp"

namespace lutka::animation::rig_import {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::string_view kNoBindShape = "<bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>";

// A tag with one blank before each attribute and its value in double quotes, as most exporters write it and as the rest
// of the reading knows it; as it is where it is none.
std::string plainTag(std::string_view tag) {
    const auto past = [&](std::string_view set, std::size_t at) {
        return std::min(tag.find_first_not_of(set, at), tag.size());
    };
    const std::size_t name = std::min(tag.find_first_of(" \t\r\n/>", tag.starts_with("</") ? 2 : 1), tag.size());
    std::string out(tag.substr(0, name));
    for (std::size_t at = past(kBlanks, name); at < tag.size(); at = past(kBlanks, at)) {
        const std::string_view rest = tag.substr(at);
        if (rest == ">" || rest == "/>") return out += rest;
        const std::size_t key = std::min(tag.find_first_of(" \t\r\n=", at), tag.size());
        const std::size_t equals = past(kBlanks, key);
        const std::size_t quote = past(kBlanks, std::min(equals + 1, tag.size()));
        if (quote >= tag.size() || tag[equals] != '=' || (tag[quote] != '"' && tag[quote] != '\'')) break;
        const std::size_t end = tag.find(tag[quote], quote + 1);
        if (end == std::string_view::npos) break;
        out += ' ';
        out += tag.substr(at, key - at);
        out += "=\"";
        for (const char c : tag.substr(quote + 1, end - quote - 1)) {
            if (c == '"') out += "&quot;";
            if (c != '"') out += c;
        }
        out += '"';
        at = end + 1;
    }
    return std::string(tag);
}

// The prefix by which a document calls Collada's namespace in all of its tags, with its colon; empty as a rule.
std::string_view prefixOf(std::string_view text) {
    constexpr std::string_view kRoot = ":COLLADA";
    const std::size_t root = text.find(kRoot);
    const std::size_t start = root == std::string_view::npos ? root : text.rfind('<', root);
    if (start == std::string_view::npos) return {};
    const std::string_view prefix = text.substr(start + 1, root - start);
    const bool isName = prefix.size() > 1 && prefix.find_first_of(" \t\r\n\"'<>!?") == std::string_view::npos;
    return isName ? prefix : std::string_view();
}

// A tag whose name stands without that prefix.
std::string withoutPrefix(std::string tag, std::string_view prefix) {
    const std::size_t name = tag.starts_with("</") ? 2 : 1;
    if (!prefix.empty() && std::string_view(tag).substr(std::min(name, tag.size())).starts_with(prefix))
        tag.erase(name, prefix.size());
    return tag;
}

std::string withPlainTags(std::string_view text) {
    const std::string_view prefix = prefixOf(text.substr(0, 4096));
    std::string out;
    out.reserve(text.size());
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t tag = std::min(text.find('<', at), text.size());
        out += text.substr(at, tag - at);
        const std::size_t end = tag < text.size() ? endOfColladaMarkup(text, tag) : tag;
        const std::string_view markup = text.substr(tag, end - tag);
        const bool isTag = !markup.starts_with("<!") && !markup.starts_with("<?");
        isTag ? out += withoutPrefix(plainTag(markup), prefix) : out += markup;
        at = end;
    }
    return out;
}

void appendTidy(std::string_view text, std::string& out) {
    std::size_t at = text.find_first_not_of(kBlanks);
    for (bool first = true; at != std::string_view::npos; first = false) {
        const std::size_t end = text.find_first_of(kBlanks, at);
        if (!first) out += ' ';
        out += text.substr(at, end == std::string_view::npos ? end : end - at);
        at = text.find_first_not_of(kBlanks, end);
    }
}

std::size_t wordsIn(std::string_view text) {
    std::size_t words = 0;
    for (std::size_t at = text.find_first_not_of(kBlanks); at != std::string_view::npos; ++words)
        at = text.find_first_not_of(kBlanks, text.find_first_of(kBlanks, at));
    return words;
}

// Some exporters join triangles to polygons and leave the count of the triangles.
void setCount(std::string& out, std::size_t tag, std::size_t count) {
    constexpr std::string_view kCount = " count=\"";
    const std::size_t found = std::min(out.find(kCount, tag), out.size());
    const std::size_t value = found + kCount.size();
    const std::size_t end = out.find('"', std::min(value, out.size()));
    if (found >= out.find('>', tag) || end == std::string::npos) return;
    out.replace(value, end - value, std::to_string(count));
}

// The order of the numbers of a <v>: Assimp takes pairs of a joint and a weight alone.
struct WeightOrder {
    std::size_t joint = 0;
    std::size_t weight = 1;
    std::size_t stride = 2;
};

// An input of <vertex_weights> in Assimp's order; empty where it has no use for it.
std::string orderedInput(std::string_view tag, WeightOrder& order) {
    std::size_t offset = 0;
    const std::string_view text = colladaAttribute(tag, "offset");
    if (std::from_chars(text.data(), text.data() + text.size(), offset).ec != std::errc()) return std::string(tag);
    constexpr std::size_t kMostInputs = 64;
    order.stride = std::max(order.stride, std::min(offset, kMostInputs) + 1);
    const std::string_view semantic = colladaAttribute(tag, "semantic");
    if (semantic != "JOINT" && semantic != "WEIGHT") return {};
    const bool isJoint = semantic == "JOINT";
    (isJoint ? order.joint : order.weight) = offset;
    std::string out(tag);
    out.replace(static_cast<std::size_t>(text.data() - tag.data()), text.size(), isJoint ? "0" : "1");
    return out;
}

std::string orderedWeights(std::string_view text, const WeightOrder& order) {
    std::string out;
    std::vector<std::string_view> words;
    for (std::size_t at = text.find_first_not_of(kBlanks); at != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
        words.push_back(text.substr(at, end - at));
        at = text.find_first_not_of(kBlanks, end);
        if (words.size() < order.stride) continue;
        for (const std::size_t index : {order.joint, order.weight}) {
            if (!out.empty()) out += ' ';
            out += words[std::min(index, words.size() - 1)];
        }
        words.clear();
    }
    return out;
}

struct Weights {
    std::string counts;  // of pairs, one a vertex
    std::string pairs;   // of joint and weight
};

// Without the pairs whose joint is -1, the bind shape itself: Assimp takes the number for two, so that all later pairs
// are torn apart. A vertex that has no other is left without weights.
Weights withoutBindShape(std::string_view counts, std::string_view pairs) {
    Weights out;
    const auto next = [](std::string_view& text) {
        text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
        const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
        text.remove_prefix(word.size());
        return word;
    };
    for (std::string_view word = next(counts); !word.empty(); word = next(counts)) {
        std::size_t count = 0;
        std::from_chars(word.data(), word.data() + word.size(), count);
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count && !pairs.empty(); ++i) {
            const std::string_view joint = next(pairs);
            const std::string_view weight = next(pairs);
            if (joint.empty() || joint.starts_with('-')) continue;
            if (!out.pairs.empty()) out.pairs += ' ';
            out.pairs.append(joint).append(" ").append(weight);
            ++kept;
        }
        if (!out.counts.empty()) out.counts += ' ';
        out.counts += std::to_string(kept);
    }
    return out;
}

// A <skew> as the matrix that it stands for, which Assimp knows: it asserts over the other. Points go along its second
// axis, so that the first one turns towards that by an angle. As it is where it has other than seven numbers.
std::string matrixOfSkew(std::string_view text) {
    std::array<double, 7> numbers{};
    std::size_t count = 0;
    for (std::size_t at = text.find_first_not_of(kBlanks); at != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
        if (count == numbers.size()) return std::string(text);
        if (std::from_chars(text.data() + at, text.data() + end, numbers[count++]).ec != std::errc())
            return std::string(text);
        at = text.find_first_not_of(kBlanks, end);
    }
    if (count != numbers.size()) return std::string(text);
    const glm::dvec3 turned(numbers[1], numbers[2], numbers[3]);
    const glm::dvec3 along = glm::normalize(glm::dvec3(numbers[4], numbers[5], numbers[6]));
    const glm::dvec3 across = turned - glm::dot(turned, along) * along;
    double share = 0.0;
    if (glm::length(across) > 1e-9 * glm::length(turned)) {
        // In the plane of both axes.
        const double x = glm::length(across);
        const double y = glm::dot(turned, along);
        const double angle = glm::radians(numbers[0]);
        share = (x * std::sin(angle) + y * std::cos(angle)) / (x * std::cos(angle) - y * std::sin(angle)) - y / x;
    }
    glm::dmat4 matrix(1.0);
    if (std::isfinite(share) && share != 0.0) {
        const glm::dvec3 normal = glm::normalize(across);
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column)
                matrix[column][row] += share * along[row] * normal[column];
        }
    }
    std::string out;
    for (int i = 0; i < 16; ++i)
        out += fmt::format("{}{:.17g}", i == 0 ? "" : " ", matrix[i % 4][i / 4]);
    return out;
}

// Writes the text of elements and their tags, and knows in which element it is.
class TidyWriter {
  public:
    explicit TidyWriter(std::size_t size) { out_.reserve(size); }

    void text(std::string_view text) {
        const bool pairs = order_.joint == 0 && order_.weight == 1 && order_.stride == 2;
        if (tag_ == "<v" && inWeights_) {
            weights(pairs ? std::string(text) : orderedWeights(text, order_));
            return;
        }
        if (tag_ == "<skew") {
            out_ += matrixOfSkew(text);
            return;
        }
        const std::size_t start = out_.size();
        appendTidy(text, out_);
        if (tag_ == "<vcount" && inWeights_) counts_ = {start, out_.size() - start};
        if (tag_ == "<vcount" && polygons_ != std::string::npos) setCount(out_, polygons_, wordsIn(text));
        // One exporter leaves the opacity out.
        if (tag_ == "<color" && wordsIn(text) == 3) out_ += " 1";
    }

    void markup(std::string_view markup) {
        tag_ = markup.substr(0, markup.find_first_of(" \t\r\n/>", 1));
        if (skinBegins_ && !tag_.starts_with("<!")) {
            // The matrix is the first in its skin where it is there; without one it is the identity.
            if (tag_ != "<bind_shape_matrix") out_ += kNoBindShape;
            skinBegins_ = false;
        }
        if (tag_ == "<skin") skinBegins_ = true;
        if (tag_ == "<vertex_weights") {
            order_ = WeightOrder{};
            counts_ = {};
        }
        if (tag_ == "<vertex_weights" || markup == "</vertex_weights>") inWeights_ = tag_ == "<vertex_weights";
        if (tag_ == "<input" && inWeights_) {
            out_ += orderedInput(markup, order_);
            return;
        }
        if (isOlderSpelling(markup)) return;
        if (tag_ == "<polylist") polygons_ = out_.size();
        if (markup == "</polylist>") polygons_ = std::string::npos;
        out_ += markup;
    }

    [[nodiscard]] std::string take() { return std::move(out_); }

  private:
    // Whether the markup was written as Collada 1.4 has it, where Assimp does not know it otherwise: its reader of 1.5
    // looks for pictures in the wrong place.
    bool isOlderSpelling(std::string_view markup) {
        constexpr std::string_view kVersion = " version=\"1.5";
        if (tag_ == "<COLLADA") {
            const std::size_t found = markup.find(kVersion);
            if (found == std::string_view::npos) return false;
            is15_ = true;
            const std::size_t end = markup.find('"', found + kVersion.size());
            out_ += markup.substr(0, found);
            out_ += " version=\"1.4.1";
            out_ += markup.substr(std::min(end, markup.size()));
            return true;
        }
        if (tag_ == "<skew" || markup == "</skew>") {
            out_ += tag_ == "<skew" ? "<matrix" : "</matrix>";
            if (tag_ == "<skew") out_ += markup.substr(tag_.size());
            return true;
        }
        if (!is15_) return false;
        if (tag_ == "<init_from") inInitFrom_ = !markup.ends_with("/>");
        if (markup == "</init_from>") inInitFrom_ = false;
        if (tag_ == "<instance_image") {
            const std::string_view image = colladaAttribute(markup, "url");
            if (image.starts_with('#')) out_ += "<source>" + std::string(image.substr(1)) + "</source>";
            return true;
        }
        return markup == "</instance_image>" || (inInitFrom_ && (tag_ == "<ref" || markup == "</ref>"));
    }

    // Their counts stand before them.
    void weights(const std::string& pairs) {
        if (pairs.find('-') == std::string::npos || counts_.second == 0) {
            appendTidy(pairs, out_);
            return;
        }
        const Weights kept = withoutBindShape(out_.substr(counts_.first, counts_.second), pairs);
        out_.replace(counts_.first, counts_.second, kept.counts);
        counts_ = {};
        out_ += kept.pairs;
    }

    std::string out_;
    std::string_view tag_;
    std::pair<std::size_t, std::size_t> counts_{};  // where a skin's counts begin, and their length
    bool is15_ = false;
    bool inInitFrom_ = false;
    bool skinBegins_ = false;
    bool inWeights_ = false;
    WeightOrder order_;
    std::size_t polygons_ = std::string::npos;  // where the tag of the polygons begins that the text is in
};

std::string tidyText(std::string_view text) {
    TidyWriter out(text.size());
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t markup = std::min(text.find('<', at), text.size());
        out.text(text.substr(at, markup - at));
        const std::size_t end = markup < text.size() ? endOfColladaMarkup(text, markup) : markup;
        out.markup(text.substr(markup, end - markup));
        at = end;
    }
    return out.take();
}

std::string lettersOf(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c >= 'A' && c <= 'Z') out += static_cast<char>(c - 'A' + 'a');
        const bool other = static_cast<unsigned char>(c) >= 0x80U || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        if (other) out += c;
    }
    return out;
}

}  // namespace

std::size_t endOfColladaMarkup(std::string_view text, std::size_t start) {
    const auto after = [&](std::string_view end) {
        const std::size_t found = text.find(end, start);
        return found == std::string_view::npos ? text.size() : found + end.size();
    };
    const std::string_view rest = text.substr(start);
    if (rest.starts_with("<!--")) return after("-->");
    if (rest.starts_with("<![CDATA[")) return after("]]>");
    char quote = 0;  // a value may hold '>'
    for (std::size_t at = start; at < text.size(); ++at) {
        const char c = text[at];
        if (quote != 0) {
            if (c == quote) quote = 0;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '>') {
            return at + 1;
        }
    }
    return text.size();
}

std::string_view colladaAttribute(std::string_view tag, std::string_view name) {
    const std::string start = " " + std::string(name) + "=\"";
    const std::size_t found = tag.find(start);
    if (found == std::string_view::npos) return {};
    const std::string_view value = tag.substr(found + start.size());
    const std::string_view text = value.substr(0, value.find('"'));
    return text.find('&') == std::string_view::npos ? text : std::string_view{};
}

// The declaration goes on saying UTF-16, which readers of a string ignore.
std::string decodedCollada(std::string_view bytes) {
    return withPlainTags(isUtf16(bytes) ? utf8OfUtf16(bytes) : std::string(bytes));
}

bool isCollada(std::string_view start) {
    return decodedCollada(start).find("<COLLADA") != std::string::npos;
}

std::string tidyCollada(std::string_view bytes) {
    return tidyText(decodedCollada(bytes));
}

std::map<std::string, std::string> colladaNodeNames(std::string_view document) {
    constexpr std::size_t kLongestName = 256;  // bytes
    std::map<std::string, std::string> names;
    std::map<std::string, int> uses;
    for (std::size_t at = document.find('<'); at < document.size(); at = document.find('<', at)) {
        const std::size_t end = endOfColladaMarkup(document, at);
        const std::string_view tag = document.substr(at, end - at);
        at = end;
        if (!tag.starts_with("<node ")) continue;
        const std::string id(colladaAttribute(tag, "id"));
        const std::string name(colladaAttribute(tag, "name"));
        ++uses[name];
        if (id.empty() || id.size() > kLongestName || name.size() > kLongestName || lettersOf(name).empty()) continue;
        if (lettersOf(id).find(lettersOf(name)) == std::string::npos) names[id] = name;
    }
    std::erase_if(names, [&](const auto& entry) { return uses[entry.second] > 1; });
    return names;
}

}  // namespace lutka::animation::rig_import
