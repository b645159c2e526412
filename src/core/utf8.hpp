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

/// Whether the bytes begin with the mark of UTF-16, in either byte order.
[[nodiscard]] bool isUtf16(std::string_view bytes);

/// A text in UTF-16 that begins with its mark as UTF-8 without one; lone surrogates become question marks.
[[nodiscard]] std::string utf8OfUtf16(std::string_view bytes);

}  // namespace lutka
