#include "animation/import/picture.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::animation::rig_import;

namespace {

// A binary PPM whose pixel (x, y) is (x, y, 7).
std::vector<std::uint8_t> ppm(int width, int height) {
    const std::string head = "P6 " + std::to_string(width) + " " + std::to_string(height) + " 255\n";
    std::vector<std::uint8_t> bytes(head.begin(), head.end());
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x)
            bytes.insert(bytes.end(), {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y), std::uint8_t{7}});
    }
    return bytes;
}

// Only the header, which is all that may be looked at of a picture that is too large.
std::vector<std::uint8_t> hugePicture(int width, int height) {
    std::vector<std::uint8_t> bytes = ppm(1, 1);
    const std::string head = "P6 " + std::to_string(width) + " " + std::to_string(height) + " 255\n";
    return {head.begin(), head.end()};
}

PictureLimits smallLimits() {
    PictureLimits limits;
    limits.mostPixels = 32 * 32;
    limits.mostSide = 16;
    limits.mostKept = 512;
    limits.mostDecoded = 4096;
    return limits;
}

using Outcome = PictureDecoder::Outcome;

}  // namespace

TEST_CASE("a picture within the limits is decoded as it is") {
    PictureDecoder decoder(smallLimits());
    const auto picture = decoder.decode(ppm(3, 2), "skin");
    REQUIRE(picture.outcome == Outcome::decoded);
    CHECK(picture.texture.width == 3);
    CHECK(picture.texture.height == 2);
    CHECK(picture.texture.rgba[4 * 5] == 2);
    CHECK(picture.texture.rgba[4 * 5 + 1] == 1);
    CHECK(picture.texture.rgba[4 * 5 + 3] == 255);
    CHECK(decoder.sentences().empty());
}

TEST_CASE("a picture with a longer side than allowed is halved, each pixel being the mean of four, and told") {
    PictureDecoder decoder(smallLimits());
    const auto picture = decoder.decode(ppm(32, 5), "wide");
    REQUIRE(picture.outcome == Outcome::decoded);
    CHECK(picture.texture.width == 16);
    CHECK(picture.texture.height == 2);
    // Columns 30 and 31, rows 2 and 3.
    const std::size_t last = 4 * (16 + 15);
    CHECK(picture.texture.rgba[last] == 31);
    CHECK(picture.texture.rgba[last + 1] == 3);
    CHECK(picture.texture.rgba[last + 2] == 7);
    REQUIRE(decoder.sentences().size() == 1);
    CHECK_THAT(decoder.sentences()[0], Catch::Contains("wide (32 x 5 to 16 x 2)"));
}

TEST_CASE("a picture that is too large by its header is left out without being decoded") {
    PictureDecoder decoder;
    CHECK(decoder.decode(hugePicture(16384, 16384), "bomb").outcome == Outcome::tooLarge);
    CHECK(decoder.decode(hugePicture(2000000000, 2000000000), "worse").outcome != Outcome::decoded);
    REQUIRE_FALSE(decoder.sentences().empty());
    CHECK_THAT(decoder.sentences()[0], Catch::Contains("bomb (16384 x 16384)"));
    CHECK(decoder.decode(std::vector<std::uint8_t>{1, 2, 3}, "noise").outcome == Outcome::damaged);
}

TEST_CASE("however many pictures there are, all together stay within the limits, and each gets something") {
    PictureDecoder decoder(smallLimits());
    std::size_t kept = 0;
    int left = 0;
    for (int i = 0; i < 20; ++i) {
        const auto picture = decoder.decode(ppm(16, 16), "picture " + std::to_string(i));
        kept += picture.texture.rgba.size() / 4;
        left += picture.outcome == Outcome::tooLarge ? 1 : 0;
        if (picture.outcome == Outcome::decoded) CHECK(picture.texture.width >= 1);
    }
    CHECK(kept <= smallLimits().mostKept + 20);  // one pixel is always had
    CHECK(left == 20 - 4096 / 256);
    CHECK(decoder.sentences().size() == 2);
}
