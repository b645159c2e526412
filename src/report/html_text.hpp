#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace lutka::reporting {

/// markupEscaped() of a message, in which what stands between two grave accents is code: `lutka inspect`.
[[nodiscard]] std::string htmlOfMessage(std::string_view text);

/// JSON for the content of a script element: nothing in it can end the element or begin a comment, since every '<' is
/// written as an escape.
[[nodiscard]] std::string scriptJson(const nlohmann::ordered_json& json);

/// The source of a script for the content of a script element. In strings, where alone it can stand, "</script" means
/// the same with a backslash.
[[nodiscard]] std::string scriptSource(std::string_view source);

}  // namespace lutka::reporting
