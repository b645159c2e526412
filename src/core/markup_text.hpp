#pragma once

#include <string>
#include <string_view>

namespace lutka {

/// Text inside an element or a quoted attribute of HTML and XML. Names come from files, so what is no well-formed UTF-8
/// and control characters (except tab and line feed) become U+FFFD: no reader takes them.
[[nodiscard]] std::string markupEscaped(std::string_view text);

}  // namespace lutka
