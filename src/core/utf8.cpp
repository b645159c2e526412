#include "core/utf8.hpp"

namespace lutka {
namespace {

// Length of the well-formed UTF-8 sequence that starts here, 0 if there is none (The Unicode Standard, table 3-7).
std::size_t sequenceAt(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) -> unsigned {
        return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0U;
    };
    const auto follows = [&](std::size_t i, unsigned low, unsigned high) { return byte(i) >= low && byte(i) <= high; };
    const unsigned lead = byte(0);
    if (lead < 0x80U) return 1;
    if (lead >= 0xC2U && lead <= 0xDFU) return follows(1, 0x80U, 0xBFU) ? 2 : 0;
    if (lead >= 0xE0U && lead <= 0xEFU) {
        const unsigned low = lead == 0xE0U ? 0xA0U : 0x80U;
        const unsigned high = lead == 0xEDU ? 0x9FU : 0xBFU;
        return follows(1, low, high) && follows(2, 0x80U, 0xBFU) ? 3 : 0;
    }
    if (lead >= 0xF0U && lead <= 0xF4U) {
        const unsigned low = lead == 0xF0U ? 0x90U : 0x80U;
        const unsigned high = lead == 0xF4U ? 0x8FU : 0xBFU;
        return follows(1, low, high) && follows(2, 0x80U, 0xBFU) && follows(3, 0x80U, 0xBFU) ? 4 : 0;
    }
    return 0;
}

}  // namespace

std::string wellFormedUtf8(std::string_view text, std::string_view replacement) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = sequenceAt(text, at);
        out += length > 0 ? text.substr(at, length) : replacement;
        at += length > 0 ? length : 1;
    }
    return out;
}

std::string withoutControls(std::string_view text, char replacement) {
    std::string out;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
        const bool wide = byte(at) == 0xC2U && byte(at + 1) >= 0x80U && byte(at + 1) < 0xA0U;
        out += wide || byte(at) < 0x20U || byte(at) == 0x7FU ? replacement : text[at];
        if (wide) ++at;
    }
    return out;
}

}  // namespace lutka
