#include "log_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <string_view>

#include "core/utf8.hpp"

namespace lutka::cli {
namespace {

constexpr std::size_t kMostLogged = 4000;

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

class FitText : public spdlog::custom_flag_formatter {
  public:
    void format(const spdlog::details::log_msg& message, const std::tm& /*time*/, spdlog::memory_buf_t& out) override {
        std::string text = oneText(wellFormedUtf8({message.payload.data(), message.payload.size()}, "?"));
        if (text.size() > kMostLogged) {
            std::size_t end = kMostLogged;
            while ((static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
                --end;  // whole characters
            text = fmt::format("{} … ({} more bytes)", text.substr(0, end), text.size() - end);
        }
        out.append(text.data(), text.data() + text.size());
    }
    [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<FitText>(); }
};

}  // namespace

std::unique_ptr<spdlog::formatter> logFormatter() {
    auto formatter = std::make_unique<spdlog::pattern_formatter>();
    formatter->add_flag<FitText>('*').set_pattern("lutka: %^%l%$: %*");
    return formatter;
}

}  // namespace lutka::cli
