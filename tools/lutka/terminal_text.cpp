#include "terminal_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/utf8.hpp"

namespace lutka::cli {
namespace {

constexpr std::size_t kMostBytes = 4000;

// Our own lists of problems have a line each, set in; no other line break stays.
std::string oneText(std::string_view text) {
    constexpr std::string_view kListed = "\n  ";
    std::string out;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(kListed, at), text.size());
        if (at > 0) out += kListed;
        out += withoutControls(text.substr(at, end - at), ' ');
        at = end + (end < text.size() ? kListed.size() : 1);
    }
    return out;
}

}  // namespace

std::string fitForTerminal(std::string_view message) {
    std::string text = oneText(wellFormedUtf8(message, "?"));
    if (text.size() <= kMostBytes) return text;
    std::size_t end = kMostBytes;
    while ((static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
        --end;  // whole characters
    return fmt::format("{} … ({} more bytes)", text.substr(0, end), text.size() - end);
}

}  // namespace lutka::cli
