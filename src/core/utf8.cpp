#include "core/utf8.hpp"

#include <cstdint>

namespace lutka {
namespace {

constexpr std::string_view kLittleEndianMark = "\xFF\xFE";
constexpr std::string_view kBigEndianMark = "\xFE\xFF";

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

void appendUtf8(std::uint32_t code, std::string& out) {
    const auto put = [&](std::uint32_t byte) { out += static_cast<char>(static_cast<unsigned char>(byte)); };
    const auto tail = [&](unsigned shift) { put(0x80U | ((code >> shift) & 0x3FU)); };
    if (code < 0x80U) {
        put(code);
    } else if (code < 0x800U) {
        put(0xC0U | (code >> 6U));
        tail(0);
    } else if (code < 0x10000U) {
        put(0xE0U | (code >> 12U));
        tail(6);
        tail(0);
    } else {
        put(0xF0U | (code >> 18U));
        tail(12);
        tail(6);
        tail(0);
    }
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

bool isUtf16(std::string_view bytes) {
    return bytes.starts_with(kLittleEndianMark) || bytes.starts_with(kBigEndianMark);
}

std::string utf8OfUtf16(std::string_view bytes) {
    const bool little = bytes.starts_with(kLittleEndianMark);
    const auto unit = [&](std::size_t at) {
        const auto first = static_cast<unsigned char>(bytes[at]);
        const auto second = static_cast<unsigned char>(bytes[at + 1]);
        return static_cast<std::uint32_t>(little ? first | (second << 8U) : second | (first << 8U));
    };
    std::string out;
    out.reserve(bytes.size() / 2);
    for (std::size_t at = 2; at + 1 < bytes.size(); at += 2) {
        std::uint32_t code = unit(at);
        if (code >= 0xD800U && code < 0xE000U) {
            const std::uint32_t low = at + 3 < bytes.size() ? unit(at + 2) : 0;
            const bool pair = code < 0xDC00U && low >= 0xDC00U && low < 0xE000U;
            code = pair ? 0x10000U + ((code - 0xD800U) << 10U) + (low - 0xDC00U) : std::uint32_t{'?'};
            at += pair ? 2 : 0;
        }
        appendUtf8(code, out);
    }
    return out;
}

}  // namespace lutka
