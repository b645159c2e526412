#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/result.hpp"

namespace lutka::animation::rig_import::fbx {

/// An array of a binary document as it lies in the file; numbers() unpacks it when it is needed.
struct PackedArray {
    char type = 'd';                      ///< 'f', 'd', 'i', 'l', 'b' or 'c', as in the file.
    std::uint32_t count = 0;              ///< Elements; not more than `bytes` can hold.
    bool deflated = false;                ///< zlib.
    std::span<const std::uint8_t> bytes;  ///< Points into the file's bytes.
};

/// A value of a record. Text points into the file's bytes or into the document; arrays written as text are unpacked.
using Value = std::variant<std::int64_t, double, std::string_view, PackedArray, std::vector<double>>;

/// A record of an FBX document: `Name: values { children }`.
struct Record {
    std::string_view name;
    std::vector<Value> values;
    std::vector<Record> children;

    /// The first child of that name; null without one.
    [[nodiscard]] const Record* child(std::string_view childName) const;
    /// The number in that place; `otherwise` where there is none or it isn't finite.
    [[nodiscard]] double number(std::size_t place, double otherwise = 0.0) const;
    [[nodiscard]] std::int64_t integer(std::size_t place, std::int64_t otherwise = 0) const;
    /// The text in that place, empty without.
    [[nodiscard]] std::string_view text(std::size_t place) const;
    /// The record's numbers: its one array, or its scalar values one by one. Empty when the array is damaged.
    /// Times are exact up to 2^53.
    [[nodiscard]] std::vector<double> numbers() const;
    /// The same of a child; empty without that child.
    [[nodiscard]] std::vector<double> numbersOf(std::string_view childName) const;
};

/// A document's record tree. Keeps the bytes that its records point into.
struct Document {
    Document() = default;
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;
    Document(Document&&) = default;
    Document& operator=(Document&&) = default;
    ~Document() = default;

    std::vector<std::uint8_t> bytes;
    std::deque<std::string> texts;  ///< Texts that are not in the file as they are (ASCII escapes).
    bool binary = false;
    int version = 0;  ///< 7400 for 7.4.
    double ticksPerSecond = 46'186'158'000.0;
    Record root;  ///< Without name and values; its children are the document's sections.
};

/// Whether the beginning of a file is that of an FBX document, binary or ASCII.
[[nodiscard]] bool isFbx(std::span<const std::uint8_t> beginning);

/// Parses a document of any version, binary or ASCII. Fails with ErrorCode::input when the bytes are no such document,
/// are older than FBX 6, break off, nest records deeper than 64 or hold more than 4 million records, 8 million values
/// or 64 million numbers in arrays.
[[nodiscard]] Result<Document> parseDocument(std::vector<std::uint8_t> bytes, const std::string& location);

}  // namespace lutka::animation::rig_import::fbx
