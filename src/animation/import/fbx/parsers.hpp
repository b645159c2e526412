#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "animation/import/fbx/document.hpp"

namespace lutka::animation::rig_import::fbx {

inline constexpr std::string_view kBinaryMagic = "Kaydara FBX Binary  ";

/// Fill `document.root` and `document.version` from `document.bytes`; the error when they can't.
[[nodiscard]] std::optional<Error> parseBinary(Document& document, const std::string& location);
[[nodiscard]] std::optional<Error> parseAscii(Document& document, const std::string& location);

}  // namespace lutka::animation::rig_import::fbx
