#pragma once

#include <string_view>

namespace lutka {

/// What stands in the text or a quoted attribute of XML and HTML for a character that means markup there; empty: the
/// character itself.
[[nodiscard]] constexpr std::string_view markupEntity(char c) {
    switch (c) {
        case '&':
            return "&amp;";
        case '<':
            return "&lt;";
        case '>':
            return "&gt;";
        case '"':
            return "&quot;";
        case '\'':
            return "&#39;";
        default:
            return {};
    }
}

}  // namespace lutka
