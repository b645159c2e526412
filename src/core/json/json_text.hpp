#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "core/rigid_transform.hpp"

namespace lutka {

/// The double whose shortest decimal is the float's shortest decimal: 0.1F becomes 0.1, not 0.10000000149011612, and
/// reads back as the same float. Zero loses its sign.
[[nodiscard]] nlohmann::ordered_json jsonNumber(float value);
/// [x, y, z]
[[nodiscard]] nlohmann::ordered_json jsonVector(const vec3& v);
/// [x, y, z, w]
[[nodiscard]] nlohmann::ordered_json jsonQuaternion(const quat& q);

/// Like dump(2) and a newline, with arrays of plain values on one line: a change of one number is a change of one line.
[[nodiscard]] std::string jsonText(const nlohmann::ordered_json& json);

/// Deeper nesting is refused: what we read has less than ten levels, and all that walks a document may recurse.
inline constexpr std::size_t kDeepestJson = 64;

/// The document; `duplicateKeys` gains a line for each key that an object has twice, of which a parser silently keeps
/// one. Fails with ErrorCode::input, with the JSON pointer and the line and column, when it is no JSON, holds a number
/// that no double can hold, or is nested deeper than kDeepestJson.
[[nodiscard]] Result<nlohmann::json> parseJson(std::string_view text, std::string_view source,
                                               std::vector<std::string>& duplicateKeys);

/// A key as a step of a JSON pointer (RFC 6901), without the slash before it.
[[nodiscard]] std::string jsonPointerStep(std::string_view key);

}  // namespace lutka
