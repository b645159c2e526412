#include "report/html_text.hpp"

#include <nlohmann/json.hpp>

#include "core/markup_text.hpp"

namespace lutka::reporting {
namespace {

bool startsClosingTag(std::string_view text) {
    constexpr std::string_view kTag = "</script";
    if (text.size() < kTag.size()) return false;
    for (std::size_t i = 0; i < kTag.size(); ++i) {
        const char c = text[i];
        const bool upper = c >= 'A' && c <= 'Z';
        if ((upper ? static_cast<char>(c - 'A' + 'a') : c) != kTag[i]) return false;
    }
    return true;
}

}  // namespace

std::string htmlOfMessage(std::string_view text) {
    std::string out = markupEscaped(text);
    std::size_t from = 0;
    while (true) {
        const std::size_t open = out.find('`', from);
        const std::size_t close = open == std::string::npos ? open : out.find('`', open + 1);
        if (close == std::string::npos) return out;
        const std::string code = "<code>" + out.substr(open + 1, close - open - 1) + "</code>";
        out.replace(open, close + 1 - open, code);
        from = open + code.size();
    }
}

std::string scriptJson(const nlohmann::ordered_json& json) {
    std::string out;
    for (const char c : json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace))
        c == '<' ? out += "\\u003c" : out += c;
    return out;
}

std::string scriptSource(std::string_view source) {
    std::string out;
    out.reserve(source.size());
    for (std::size_t at = 0; at < source.size(); ++at) {
        out += source[at];
        if (startsClosingTag(source.substr(at))) out += '\\';
    }
    return out;
}

}  // namespace lutka::reporting
