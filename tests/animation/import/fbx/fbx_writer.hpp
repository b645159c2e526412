#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace lutka::test {

/// A record of an FBX document to be written. Texts of the form "Class::name" are names of objects.
struct FbxRecord {
    using Value = std::variant<std::int64_t, double, std::string, std::vector<double>, std::vector<std::int32_t>>;

    std::string name;
    std::vector<Value> values;
    std::vector<FbxRecord> children;
};

/// The document as text.
[[nodiscard]] std::string asciiFbx(const std::vector<FbxRecord>& sections);

/// The document in binary: records of 64 bits from version 7500 on; arrays deflated where asked for.
[[nodiscard]] std::string binaryFbx(const std::vector<FbxRecord>& sections, std::uint32_t version, bool deflate);

/// Properties70 of numbers: name and one or three of them.
[[nodiscard]] FbxRecord fbxProperties(const std::vector<std::pair<std::string, std::vector<double>>>& properties);

/// A connection "OO", or "OP" with a property.
[[nodiscard]] FbxRecord fbxLink(std::int64_t child, std::int64_t parent, const std::string& property = "");

}  // namespace lutka::test
