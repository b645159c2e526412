#include "core/markup_text.hpp"

#include "core/utf8.hpp"

namespace lutka {
namespace {

constexpr std::string_view kReplacementCharacter = "\xEF\xBF\xBD";  // U+FFFD

}  // namespace

std::string markupEscaped(std::string_view text) {
    std::string out;
    for (const char c : wellFormedUtf8(text, kReplacementCharacter)) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            default: {
                const auto byte = static_cast<unsigned char>(c);
                const bool control = (byte < 0x20 && c != '\t' && c != '\n') || byte == 0x7F;
                control ? out += kReplacementCharacter : out += c;
            }
        }
    }
    return out;
}

}  // namespace lutka
