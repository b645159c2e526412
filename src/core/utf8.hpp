#pragma once

#include <string>
#include <string_view>

namespace lutka {

/// The text with every byte that is no part of well-formed UTF-8 replaced: names come from all sorts of files, and most
/// formats that we write take nothing else.
[[nodiscard]] std::string wellFormedUtf8(std::string_view text, std::string_view replacement);

/// The text with every control character (C0, delete, and C1 in UTF-8) replaced: those of a file's names would move the
/// cursor and colour the terminal that they are printed on, and XML has no place for them.
[[nodiscard]] std::string withoutControls(std::string_view text, char replacement);

}  // namespace lutka
