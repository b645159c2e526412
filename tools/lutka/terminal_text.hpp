#pragma once

#include <string>
#include <string_view>

namespace lutka::cli {

/// A message fit for a terminal, whatever paths, arguments and files brought into it: well-formed UTF-8, without
/// control characters but the line breaks of our own lists, and of a few thousand bytes at most.
[[nodiscard]] std::string fitForTerminal(std::string_view message);

}  // namespace lutka::cli
