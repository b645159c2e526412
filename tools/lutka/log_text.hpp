#pragma once

#include <spdlog/pattern_formatter.h>

#include <memory>

namespace lutka::cli {

/// Of each line that is logged "lutka: level: text", with the text as fitForTerminal() makes it.
[[nodiscard]] std::unique_ptr<spdlog::formatter> logFormatter();

}  // namespace lutka::cli
