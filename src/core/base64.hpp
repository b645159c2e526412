#pragma once

#include <string>
#include <string_view>

namespace lutka {

/// The bytes in base64 with padding, on one line (RFC 4648, section 4).
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace lutka
