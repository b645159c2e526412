#include <fmt/format.h>

#include <cstring>

#include "animation/import/fbx/limits.hpp"
#include "animation/import/fbx/parsers.hpp"

namespace lutka::animation::rig_import::fbx {
namespace {

constexpr std::size_t kHeaderBytes = 27;
constexpr int kFirstWideVersion = 7500;

class BinaryParser {
  public:
    BinaryParser(Document& document, std::string location)
        : document_(document), bytes_(document.bytes), location_(std::move(location)) {}

    std::optional<Error> parse() {
        if (bytes_.size() < kHeaderBytes) return error("breaks off in its header");
        // A zero, a 26 (which ends a text), and the byte order follow the magic.
        const std::uint8_t* mark = bytes_.data() + kBinaryMagic.size();
        if (mark[0] != 0) return error("is a binary file that was copied as a text, which has damaged it");
        if (mark[2] == 1) return error("has the byte order of old Macs (big-endian), which is not read");
        at_ = kHeaderBytes - 4;
        document_.version = static_cast<int>(read<std::uint32_t>());
        wide_ = document_.version >= kFirstWideVersion;
        while (!failed_ && readRecord(document_.root, bytes_.size(), 1)) {
        }
        return failed_;
    }

  private:
    std::optional<Error> error(std::string message) {
        return Error{ErrorCode::input, std::move(message), location_, "export the file again"};
    }

    bool fail(std::string message) {
        if (!failed_) failed_ = error(fmt::format("{} (at byte {})", message, at_));
        return false;
    }

    [[nodiscard]] bool has(std::uint64_t count, std::size_t end) const { return at_ <= end && count <= end - at_; }

    // The caller has checked that the bytes are there.
    template <class T>
    T read() {
        T value;
        std::memcpy(&value, bytes_.data() + at_, sizeof(T));
        at_ += sizeof(T);
        return value;
    }

    std::uint64_t readOffset() { return wide_ ? read<std::uint64_t>() : read<std::uint32_t>(); }

    std::string_view readText(std::size_t length) {
        const std::string_view text(reinterpret_cast<const char*>(bytes_.data()) + at_, length);
        at_ += length;
        return text;
    }

    // One record into `parent`; false at the end of the list, and after a failure.
    bool readRecord(Record& parent, std::size_t end, int depth) {
        const std::size_t head = wide_ ? 25 : 13;
        // The document's last list may lack its closing null record.
        if (!has(head, end)) return depth == 1 ? false : fail("a record breaks off");
        const std::uint64_t recordEnd = readOffset();
        const std::uint64_t valueCount = readOffset();
        const std::uint64_t valueBytes = readOffset();
        const auto nameLength = read<std::uint8_t>();
        if (recordEnd == 0) return false;
        if (depth > kMaxRecordDepth) return fail(fmt::format("records are nested deeper than {}", kMaxRecordDepth));
        if (++records_ > kMaxRecords) return fail(fmt::format("more than {} records", kMaxRecords));
        if (recordEnd > end || recordEnd < at_ || !has(nameLength, recordEnd))
            return fail("a record reaches beyond what holds it");
        const std::string_view name = readText(nameLength);
        if (!has(valueBytes, recordEnd)) return fail("a record's values reach beyond it");
        const std::size_t valuesEnd = at_ + static_cast<std::size_t>(valueBytes);
        // Each value takes at least two bytes.
        if (valueCount > valueBytes / 2 || (values_ += valueCount) > kMaxValues) return fail("too many values");
        Record& record = parent.children.emplace_back();
        record.name = name;
        record.values.reserve(static_cast<std::size_t>(valueCount));
        for (std::uint64_t i = 0; i < valueCount; ++i) {
            if (!readValue(record, valuesEnd)) return false;
        }
        at_ = valuesEnd;
        while (!failed_ && at_ < recordEnd && readRecord(record, static_cast<std::size_t>(recordEnd), depth + 1)) {
        }
        if (failed_) return false;
        at_ = static_cast<std::size_t>(recordEnd);
        return true;
    }

    template <class T, class As>
    bool readScalar(Record& record, std::size_t end) {
        if (!has(sizeof(T), end)) return fail("a value breaks off");
        record.values.emplace_back(static_cast<As>(read<T>()));
        return true;
    }

    bool readValue(Record& record, std::size_t end) {
        if (!has(1, end)) return fail("a value breaks off");
        const char type = static_cast<char>(read<std::uint8_t>());
        switch (type) {
            case 'C':
            case 'B':
            case 'Z':
                return readScalar<std::uint8_t, std::int64_t>(record, end);
            case 'Y':
                return readScalar<std::int16_t, std::int64_t>(record, end);
            case 'I':
                return readScalar<std::int32_t, std::int64_t>(record, end);
            case 'L':
                return readScalar<std::int64_t, std::int64_t>(record, end);
            case 'F':
                return readScalar<float, double>(record, end);
            case 'D':
                return readScalar<double, double>(record, end);
            case 'S':
            case 'R':
                return readString(record, end);
            case 'f':
            case 'd':
            case 'i':
            case 'l':
            case 'b':
            case 'c':
                return readArray(type, record, end);
            default:
                return fail("a value of an unknown type");
        }
    }

    bool readString(Record& record, std::size_t end) {
        if (!has(4, end)) return fail("a text breaks off");
        const auto length = read<std::uint32_t>();
        if (!has(length, end)) return fail("a text breaks off");
        record.values.emplace_back(readText(length));
        return true;
    }

    bool readArray(char type, Record& record, std::size_t end) {
        if (!has(12, end)) return fail("an array breaks off");
        PackedArray array;
        array.type = type;
        array.count = read<std::uint32_t>();
        array.deflated = read<std::uint32_t>() == 1;
        const auto packed = read<std::uint32_t>();
        const std::size_t element = type == 'd' || type == 'l' ? 8 : (type == 'f' || type == 'i' ? 4 : 1);
        const std::uint64_t size = std::uint64_t{array.count} * element;
        const std::uint64_t stored = array.deflated ? packed : size;
        if (!has(stored, end)) return fail("an array breaks off");
        if (array.deflated && size > stored * kMostDeflation)
            return fail(fmt::format("an array of {} numbers in {} bytes", array.count, stored));
        if ((numbers_ += array.count) > kMaxArrayNumbers)
            return fail(fmt::format("more than {} numbers in arrays", kMaxArrayNumbers));
        array.bytes = std::span(bytes_).subspan(at_, static_cast<std::size_t>(stored));
        at_ += static_cast<std::size_t>(stored);
        record.values.emplace_back(array);
        return true;
    }

    Document& document_;
    std::span<const std::uint8_t> bytes_;
    std::string location_;
    std::size_t at_ = 0;
    std::uint64_t records_ = 0;
    std::uint64_t values_ = 0;
    std::uint64_t numbers_ = 0;
    bool wide_ = false;
    std::optional<Error> failed_;
};

}  // namespace

std::optional<Error> parseBinary(Document& document, const std::string& location) {
    return BinaryParser(document, location).parse();
}

}  // namespace lutka::animation::rig_import::fbx
