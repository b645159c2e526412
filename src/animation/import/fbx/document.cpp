#include "animation/import/fbx/document.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "animation/import/fbx/limits.hpp"
#include "animation/import/fbx/parsers.hpp"

namespace lutka::animation::rig_import::fbx {
namespace {

std::size_t sizeOf(char type) {
    switch (type) {
        case 'd':
        case 'l':
            return 8;
        case 'f':
        case 'i':
            return 4;
        default:
            return 1;
    }
}

template <class T>
void append(std::span<const std::uint8_t> bytes, std::vector<double>& out) {
    for (std::size_t at = 0; at + sizeof(T) <= bytes.size(); at += sizeof(T)) {
        T value;
        std::memcpy(&value, bytes.data() + at, sizeof(T));
        out.push_back(static_cast<double>(value));
    }
}

// zlib's stream, of exactly that many bytes; empty when it is damaged.
std::vector<std::uint8_t> inflated(std::span<const std::uint8_t> packed, std::size_t size) {
    std::vector<std::uint8_t> out(size);
    uLongf length = static_cast<uLongf>(size);
    const int state = uncompress(out.data(), &length, packed.data(), static_cast<uLong>(packed.size()));
    if (state != Z_OK || length != size) out.clear();
    return out;
}

std::vector<double> unpacked(const PackedArray& array) {
    const std::size_t size = array.count * sizeOf(array.type);
    std::vector<std::uint8_t> inflatedBytes;
    std::span<const std::uint8_t> bytes = array.bytes;
    if (array.deflated) {
        inflatedBytes = inflated(array.bytes, size);
        bytes = inflatedBytes;
    }
    std::vector<double> out;
    if (bytes.size() < size) return out;
    bytes = bytes.first(size);
    out.reserve(array.count);
    switch (array.type) {
        case 'd':
            append<double>(bytes, out);
            break;
        case 'f':
            append<float>(bytes, out);
            break;
        case 'l':
            append<std::int64_t>(bytes, out);
            break;
        case 'i':
            append<std::int32_t>(bytes, out);
            break;
        default:
            append<std::uint8_t>(bytes, out);
    }
    return out;
}

// Documents from FBX 8 on, and those that ask for it, count time in the newer unit.
double ticksPerSecond(const Document& document) {
    constexpr double kOld = 46'186'158'000.0;
    constexpr double kNew = 141'120'000.0;
    constexpr int kOldDefinition = 127;
    const Record* header = document.root.child("FBXHeaderExtension");
    const Record* flags = header != nullptr ? header->child("OtherFlags") : nullptr;
    const Record* definition = flags != nullptr ? flags->child("TCDefinition") : nullptr;
    const Record* version = header != nullptr ? header->child("FBXHeaderVersion") : nullptr;
    if (definition != nullptr && version != nullptr && version->integer(0) >= 1004)
        return definition->integer(0) == kOldDefinition ? kOld : kNew;
    return document.version < 8000 ? kOld : kNew;
}

}  // namespace

const Record* Record::child(std::string_view childName) const {
    for (const Record& record : children) {
        if (record.name == childName) return &record;
    }
    return nullptr;
}

double Record::number(std::size_t place, double otherwise) const {
    if (place >= values.size()) return otherwise;
    if (const auto* whole = std::get_if<std::int64_t>(&values[place])) return static_cast<double>(*whole);
    const auto* real = std::get_if<double>(&values[place]);
    return real != nullptr && std::isfinite(*real) ? *real : otherwise;
}

std::int64_t Record::integer(std::size_t place, std::int64_t otherwise) const {
    if (place >= values.size()) return otherwise;
    if (const auto* whole = std::get_if<std::int64_t>(&values[place])) return *whole;
    const auto* real = std::get_if<double>(&values[place]);
    return real != nullptr && std::abs(*real) < 9e18 ? static_cast<std::int64_t>(*real) : otherwise;
}

std::string_view Record::text(std::size_t place) const {
    if (place >= values.size()) return {};
    const auto* text = std::get_if<std::string_view>(&values[place]);
    return text != nullptr ? *text : std::string_view{};
}

std::vector<double> Record::numbers() const {
    if (values.size() == 1) {
        if (const auto* packed = std::get_if<PackedArray>(values.data())) return unpacked(*packed);
        if (const auto* plain = std::get_if<std::vector<double>>(values.data())) return *plain;
    }
    std::vector<double> out;
    out.reserve(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        out.push_back(number(i, std::numeric_limits<double>::quiet_NaN()));
    return out;
}

std::vector<double> Record::numbersOf(std::string_view childName) const {
    const Record* found = child(childName);
    return found != nullptr ? found->numbers() : std::vector<double>{};
}

bool isFbx(std::span<const std::uint8_t> beginning) {
    const std::string_view text(reinterpret_cast<const char*>(beginning.data()), beginning.size());
    if (text.starts_with(kBinaryMagic)) return true;
    // ASCII: a comment that names the format, or its first section; after a byte order mark and blanks.
    const std::size_t start = text.find_first_not_of("\xEF\xBB\xBF \t\r\n");
    if (start == std::string_view::npos) return false;
    const std::string_view first = text.substr(start, text.find('\n', start) - start);
    if (first.starts_with(";") && first.find("FBX") != std::string_view::npos) return true;
    return first.starts_with("FBXHeaderExtension") ||
           (first.starts_with(";") && text.find("FBXHeaderExtension") != std::string_view::npos);
}

Result<Document> parseDocument(std::vector<std::uint8_t> bytes, const std::string& location) {
    Document document;
    document.bytes = std::move(bytes);
    const std::string_view text(reinterpret_cast<const char*>(document.bytes.data()), document.bytes.size());
    document.binary = text.starts_with(kBinaryMagic);
    const std::optional<Error> failed =
        document.binary ? parseBinary(document, location) : parseAscii(document, location);
    if (failed) return *failed;
    if (document.version != 0 && document.version < 6000) {
        return Error{ErrorCode::input,
                     fmt::format("FBX {} is too old; 6.0 is the oldest that can be read", document.version / 1000.0),
                     location, "convert it to FBX 2013 or later"};
    }
    document.ticksPerSecond = ticksPerSecond(document);
    return document;
}

}  // namespace lutka::animation::rig_import::fbx
