#include "render/video_end.hpp"

#include <array>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <system_error>

namespace lutka::render {
namespace {

// ISO/IEC 14496-12, 4.2: big-endian size and type; a size of 1 is followed by one of 64 bits.
constexpr std::size_t kShortHeader = 8;
constexpr std::size_t kLongHeader = 16;

std::uint64_t bigEndian(const char* bytes, int count) {
    std::uint64_t value = 0;
    for (int i = 0; i < count; ++i)
        value = value << 8U | static_cast<unsigned char>(bytes[i]);
    return value;
}

bool boxesFill(std::ifstream& in, std::uint64_t size) {
    bool hasIndex = false;
    std::uint64_t at = 0;
    while (at < size) {
        std::array<char, kLongHeader> header{};
        in.seekg(static_cast<std::streamoff>(at));
        if (size - at < kShortHeader || !in.read(header.data(), kShortHeader)) return false;
        std::uint64_t length = bigEndian(header.data(), 4);
        const bool isLong = length == 1;
        if (isLong && !in.read(header.data() + kShortHeader, kLongHeader - kShortHeader)) return false;
        if (isLong) length = bigEndian(header.data() + kShortHeader, 8);
        if (length < (isLong ? kLongHeader : kShortHeader) || length > size - at) return false;
        hasIndex = hasIndex || std::string_view(header.data() + 4, 4) == "moov";
        at += length;
    }
    return hasIndex;
}

}  // namespace

bool isWholeVideo(const std::filesystem::path& file) {
    constexpr char kGifTrailer = 0x3B;
    std::error_code failed;
    const std::uint64_t size = std::filesystem::file_size(file, failed);
    std::ifstream in(file, std::ios::binary);
    std::array<char, kShortHeader> start{};
    if (failed || size < start.size() || !in.read(start.data(), start.size())) return false;
    if (std::string_view(start.data(), 3) == "GIF") {
        in.seekg(-1, std::ios::end);
        return in.get() == kGifTrailer;
    }
    return std::string_view(start.data() + 4, 4) == "ftyp" && boxesFill(in, size);
}

}  // namespace lutka::render
