#include "log_text.hpp"

#include <ctime>
#include <string>

#include "terminal_text.hpp"

namespace lutka::cli {
namespace {

class FitText : public spdlog::custom_flag_formatter {
  public:
    void format(const spdlog::details::log_msg& message, const std::tm& /*time*/, spdlog::memory_buf_t& out) override {
        const std::string text = fitForTerminal({message.payload.data(), message.payload.size()});
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
