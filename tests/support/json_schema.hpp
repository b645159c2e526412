#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace lutka::test {

/// Checks a document against the part of JSON Schema 2020-12 that our schemas use (type, const, enum, properties,
/// required, additionalProperties, items, minItems, maxItems, bounds of numbers, oneOf, local $ref); a line a problem.
/// A keyword that is none of these is a problem too, so that nothing goes unchecked.
[[nodiscard]] std::vector<std::string> checkSchema(const nlohmann::json& schema, const nlohmann::json& document);

}  // namespace lutka::test
