#pragma once

#include <string>
#include <string_view>

namespace lutka {

/// The text with every byte that is no part of well-formed UTF-8 replaced: names come from all sorts of files, and most
/// formats that we write take nothing else.
[[nodiscard]] std::string wellFormedUtf8(std::string_view text, std::string_view replacement);

}  // namespace lutka
