#include "animation/import/fbx/fbx_writer.hpp"

#include <zlib.h>

#include <cstring>
#include <sstream>

namespace lutka::test {
namespace {

template <class T>
void put(std::string& out, T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    out.append(bytes, sizeof(T));
}

template <class T>
void writeRow(std::ostream& out, const std::vector<T>& numbers) {
    out << '*' << numbers.size() << " {\n a: ";
    for (std::size_t i = 0; i < numbers.size(); ++i)
        out << (i > 0 ? "," : "") << numbers[i];
    out << "\n}";
}

void writeText(std::ostream& out, const FbxRecord& record) {
    out << record.name << ": ";
    for (std::size_t i = 0; i < record.values.size(); ++i) {
        if (i > 0) out << ", ";
        const FbxRecord::Value& value = record.values[i];
        if (const auto* whole = std::get_if<std::int64_t>(&value)) out << *whole;
        if (const auto* real = std::get_if<double>(&value)) out << *real;
        if (const auto* text = std::get_if<std::string>(&value)) out << '"' << *text << '"';
        if (const auto* reals = std::get_if<std::vector<double>>(&value)) writeRow(out, *reals);
        if (const auto* wholes = std::get_if<std::vector<std::int32_t>>(&value)) writeRow(out, *wholes);
    }
    if (!record.children.empty()) {
        out << " {\n";
        for (const FbxRecord& child : record.children)
            writeText(out, child);
        out << '}';
    }
    out << '\n';
}

template <class T>
void putArray(std::string& out, char type, const std::vector<T>& numbers, bool deflate) {
    std::string bytes(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
    if (deflate) {
        uLongf length = compressBound(static_cast<uLong>(bytes.size()));
        std::string packed(length, '\0');
        compress(reinterpret_cast<Bytef*>(packed.data()), &length, reinterpret_cast<const Bytef*>(bytes.data()),
                 static_cast<uLong>(bytes.size()));
        packed.resize(length);
        bytes = packed;
    }
    out += type;
    put(out, static_cast<std::uint32_t>(numbers.size()));
    put(out, static_cast<std::uint32_t>(deflate ? 1 : 0));
    put(out, static_cast<std::uint32_t>(bytes.size()));
    out += bytes;
}

std::string binaryText(const std::string& text) {
    const std::size_t colons = text.find("::");
    if (colons == std::string::npos) return text;
    return text.substr(colons + 2) + std::string("\0\1", 2) + text.substr(0, colons);
}

std::string binaryValues(const FbxRecord& record, bool deflate) {
    std::string out;
    for (const FbxRecord::Value& value : record.values) {
        if (const auto* whole = std::get_if<std::int64_t>(&value)) {
            out += 'L';
            put(out, *whole);
        }
        if (const auto* real = std::get_if<double>(&value)) {
            out += 'D';
            put(out, *real);
        }
        if (const auto* text = std::get_if<std::string>(&value)) {
            const std::string written = binaryText(*text);
            out += 'S';
            put(out, static_cast<std::uint32_t>(written.size()));
            out += written;
        }
        if (const auto* reals = std::get_if<std::vector<double>>(&value)) putArray(out, 'd', *reals, deflate);
        if (const auto* wholes = std::get_if<std::vector<std::int32_t>>(&value)) putArray(out, 'i', *wholes, deflate);
    }
    return out;
}

// The record, to stand at byte `start` of the document.
std::string binaryRecord(const FbxRecord& record, std::size_t start, bool wide, bool deflate) {
    const std::size_t head = wide ? 25 : 13;
    const std::string values = binaryValues(record, deflate);
    std::string children;
    const std::size_t childrenStart = start + head + record.name.size() + values.size();
    for (const FbxRecord& child : record.children)
        children += binaryRecord(child, childrenStart + children.size(), wide, deflate);
    if (!record.children.empty()) children += std::string(head, '\0');
    std::string out;
    const std::uint64_t fields[] = {childrenStart + children.size(), record.values.size(), values.size()};
    for (const std::uint64_t field : fields)
        wide ? put(out, field) : put(out, static_cast<std::uint32_t>(field));
    out += static_cast<char>(record.name.size());
    return out + record.name + values + children;
}

}  // namespace

std::string asciiFbx(const std::vector<FbxRecord>& sections) {
    std::ostringstream out;
    out.precision(17);
    out << "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n FBXVersion: 7400\n}\n";
    for (const FbxRecord& section : sections)
        writeText(out, section);
    return out.str();
}

std::string binaryFbx(const std::vector<FbxRecord>& sections, std::uint32_t version, bool deflate) {
    std::string out("Kaydara FBX Binary  \0\x1a\0", 23);
    put(out, version);
    const bool wide = version >= 7500;
    for (const FbxRecord& section : sections)
        out += binaryRecord(section, out.size(), wide, deflate);
    return out + std::string(wide ? 25 : 13, '\0');
}

FbxRecord fbxProperties(const std::vector<std::pair<std::string, std::vector<double>>>& properties) {
    FbxRecord out{"Properties70", {}, {}};
    for (const auto& [name, numbers] : properties) {
        FbxRecord& entry =
            out.children.emplace_back(FbxRecord{"P", {name, std::string(), std::string(), std::string()}, {}});
        for (const double number : numbers)
            entry.values.emplace_back(number);
    }
    return out;
}

FbxRecord fbxLink(std::int64_t child, std::int64_t parent, const std::string& property) {
    FbxRecord out{"C", {std::string(property.empty() ? "OO" : "OP"), child, parent}, {}};
    if (!property.empty()) out.values.emplace_back(property);
    return out;
}

}  // namespace lutka::test
