#pragma once

#include <spdlog/pattern_formatter.h>

#include <memory>

namespace lutka::cli {

/// Of each line that is logged "lutka: level: text", with the text fit for a terminal: without control characters,
/// which paths and what files hold may bring along, and of a few thousand bytes at most.
[[nodiscard]] std::unique_ptr<spdlog::formatter> logFormatter();

}  // namespace lutka::cli
