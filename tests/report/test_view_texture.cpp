#include "report/view_texture.hpp"

#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::reporting;

namespace {

animation::Texture plain(int width, int height) {
    animation::Texture texture;
    texture.width = width;
    texture.height = height;
    texture.rgba.assign(static_cast<std::size_t>(width) * height * 4, 200);
    return texture;
}

// Width and height out of the header of the PNG in a data URI; base64 of 8 + 16 bytes is 32 letters.
std::pair<int, int> sizeOf(const std::string& uri) {
    constexpr std::string_view kStart = "data:image/png;base64,";
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    REQUIRE(uri.starts_with(kStart));
    std::string bytes;
    for (std::size_t at = kStart.size(); at < kStart.size() + 32; at += 4) {
        std::uint32_t group = 0;
        for (std::size_t i = 0; i < 4; ++i)
            group = group << 6U | static_cast<std::uint32_t>(kDigits.find(uri[at + i]));
        for (int shift = 16; shift >= 0; shift -= 8)
            bytes += static_cast<char>(group >> shift & 0xFFU);
    }
    const auto word = [&](std::size_t at) {
        return static_cast<unsigned char>(bytes[at + 2]) * 256 + static_cast<unsigned char>(bytes[at + 3]);
    };
    return {word(16), word(20)};
}

}  // namespace

TEST_CASE("textures are halved until they are small enough, whatever their shape") {
    CHECK(sizeOf(textureUri(plain(64, 32), 512)) == std::pair(64, 32));
    CHECK(sizeOf(textureUri(plain(2048, 1024), 512)) == std::pair(512, 256));
    CHECK(sizeOf(textureUri(plain(1500, 3), 512)) == std::pair(375, 1));
    CHECK(sizeOf(textureUri(plain(1030, 1), 512)) == std::pair(257, 1));
}

TEST_CASE("a texture without pixels gives nothing") {
    CHECK(textureUri({}, 512).empty());
    animation::Texture cut = plain(8, 8);
    cut.rgba.resize(7);
    CHECK(textureUri(cut, 512).empty());
}
