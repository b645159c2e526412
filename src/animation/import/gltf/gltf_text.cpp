#include "animation/import/gltf/gltf_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "animation/import/gltf/gltf_json.hpp"
#include "animation/import/source_limits.hpp"
#include "core/letter_case.hpp"
#include "core/utf8.hpp"

namespace lutka::animation::rig_import::gltf {
namespace {

using nlohmann::json;

// Whether arrays and objects stand deeper within one another than kMaxJsonDepth: nlohmann's document is copied and
// written by recursion.
bool isNestedTooDeep(std::string_view text) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '\\') ++i;
        if (c == '"') quoted = !quoted;
        if (quoted) continue;
        if (c == '{' || c == '[') ++depth;
        if (c == '}' || c == ']') --depth;
        if (depth > kMaxJsonDepth) return true;
    }
    return false;
}

// JSON knows one kind of number, so some writers have 2.0 for 2: what is whole becomes an index here.
void makeWhole(json& value) {
    constexpr double kMost = 9e15;  // above, not all whole numbers are there
    if (value.is_number_float()) {
        const double number = value.get<double>();
        if (number >= 0.0 && number < kMost && number == std::floor(number)) value = static_cast<std::uint64_t>(number);
        return;
    }
    if (!value.is_structured()) return;
    for (json& entry : value)
        makeWhole(entry);
}

// The code of "\uXXXX" that starts here; -1 where there is none.
int escapedUnit(std::string_view text, std::size_t at) {
    if (text.substr(at, 2) != "\\u" || at + 6 > text.size()) return -1;
    int code = 0;
    for (const char c : text.substr(at + 2, 4)) {
        const std::size_t digit = std::string_view("0123456789abcdef").find(lowerCased(std::string(1, c)));
        if (digit == std::string_view::npos) return -1;
        code = 16 * code + static_cast<int>(digit);
    }
    return code;
}

// Whether a word that stands for a value is as a whole a number that is none, as C, C#, JavaScript, Python and
// Microsoft's libraries write such, or one too large for any.
bool isNoNumber(std::string_view word) {
    std::string plain = lowerCased(std::string(word));
    char* end = nullptr;
    if (const double number = std::strtod(plain.c_str(), &end); *end == '\0' && !std::isfinite(number)) return true;
    if (plain.starts_with('-') || plain.starts_with('+')) plain.erase(0, 1);
    if (plain == "\xE2\x88\x9E") return true;  // the sign of infinity
    plain.erase(std::find_if_not(plain.rbegin(), plain.rend(), [](char c) { return c == '0'; }).base(), plain.end());
    constexpr std::array<std::string_view, 4> kMicrosoft = {"1.#inf", "1.#ind", "1.#qnan", "1.#snan"};
    return std::find(kMicrosoft.begin(), kMicrosoft.end(), plain) != kMicrosoft.end();
}

// Copies a document, well-formed as UTF-8, with what is mended.
class Mender {
  public:
    explicit Mender(std::string_view text) : text_(text) { out_.reserve(text.size()); }

    std::string mended() {
        while (at_ < text_.size()) {
            if (text_[at_] == '"') {
                copyString();
            } else if (std::string_view(" \t\r\n{}[],:").find(text_[at_]) != std::string_view::npos) {
                out_ += text_[at_++];
            } else {
                copyWord();
            }
        }
        return std::move(out_);
    }
    [[nodiscard]] bool mendedNames() const { return mendedNames_; }
    [[nodiscard]] bool mendedNumbers() const { return mendedNumbers_; }

  private:
    void copyString() {
        out_ += text_[at_++];
        while (at_ < text_.size() && text_[at_] != '"') {
            const int unit = escapedUnit(text_, at_);
            const auto isHalf = [](int code, int first) { return code >= first && code < first + 0x400; };
            if (isHalf(unit, 0xD800) && isHalf(escapedUnit(text_, at_ + 6), 0xDC00)) {
                copy(12);
            } else if (isHalf(unit, 0xD800) || isHalf(unit, 0xDC00)) {
                mendName("\\ufffd", 6);
            } else if (text_[at_] == '\\') {
                copy(2);
            } else if (static_cast<unsigned char>(text_[at_]) < 0x20U) {
                mendName(" ", 1);
            } else {
                copy(1);
            }
        }
        copy(1);  // the closing quote
    }

    void copyWord() {
        const std::size_t end = std::min(text_.find_first_of(" \t\r\n{}[],:\"", at_), text_.size());
        const std::string_view word = text_.substr(at_, end - at_);
        at_ = end;
        const bool isNone = isNoNumber(word);
        mendedNumbers_ = mendedNumbers_ || isNone;
        // As a text, which is no number and no index for whoever reads it, and is named where it is refused.
        if (isNone) out_ += '"';
        out_ += word;
        if (isNone) out_ += '"';
    }

    void copy(std::size_t bytes) {
        out_ += text_.substr(std::min(at_, text_.size()), bytes);
        at_ += bytes;
    }

    void mendName(std::string_view instead, std::size_t bytes) {
        out_ += instead;
        at_ += bytes;
        mendedNames_ = true;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::string out_;
    bool mendedNames_ = false;
    bool mendedNumbers_ = false;
};

// Where a parser stopped, for people: "line 3, character 17".
std::string placeOf(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, std::min(byte > 0 ? byte - 1 : 0, text.size()));
    const std::size_t lineStart = before.rfind('\n');
    const std::size_t column = lineStart == std::string_view::npos ? before.size() : before.size() - lineStart - 1;
    return fmt::format("line {}, character {}", std::count(before.begin(), before.end(), '\n') + 1, column + 1);
}

}  // namespace

json parseGltfText(std::span<const std::uint8_t> text, std::set<std::string>& leftOut) {
    std::string_view view(reinterpret_cast<const char*>(text.data()), text.size());
    std::string converted;
    if (isUtf16(view)) view = converted = utf8OfUtf16(view);
    if (view.size() > kMaxJsonBytes)
        throw Damage{fmt::format("its JSON has more than {} MB", kMaxJsonBytes >> 20U), "export only the character"};
    if (isNestedTooDeep(view))
        throw Damage{fmt::format("its JSON is nested deeper than {}", kMaxJsonDepth), "export only the character"};
    json document = json::parse(view, nullptr, false);
    if (document.is_discarded()) {
        const std::string wellFormed = wellFormedUtf8(view, "\xEF\xBF\xBD");
        Mender mender(wellFormed);
        const std::string mended = mender.mended();
        try {
            document = json::parse(mended);
        } catch (const json::parse_error& error) {
            throw Damage{fmt::format("the glTF's JSON is broken or cut off ({})", placeOf(mended, error.byte))};
        }
        if (mender.mendedNames() || wellFormed != view) leftOut.insert("characters of names that are no text");
        if (mender.mendedNumbers()) leftOut.insert("numbers of its JSON that are none (NaN, Infinity)");
    }
    if (!document.is_object()) throw Damage{"the glTF's JSON is broken or cut off"};
    makeWhole(document);
    return document;
}

}  // namespace lutka::animation::rig_import::gltf
