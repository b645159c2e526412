#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/files.hpp"
#include "render/image.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::render;

namespace {

namespace fs = std::filesystem;

fs::path temporary(const std::string& name) {
    return fs::temp_directory_path() / ("lutka-image-" + std::to_string(::getpid()) + "-" + name);
}

Image gradient() {
    Image image(Extent{37, 23}, colors::white);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            image.set(x, y,
                      {static_cast<std::uint8_t>(x * 6), static_cast<std::uint8_t>(y * 11),
                       static_cast<std::uint8_t>(x + y), static_cast<std::uint8_t>(255 - x)});
        }
    }
    return image;
}

}  // namespace

TEST_CASE("a picture survives the way through a PNG file bit by bit") {
    const Image image = gradient();
    const fs::path file = temporary("round.png");
    REQUIRE(savePng(image, file).ok());
    const Result<Image> back = loadPng(file);
    fs::remove(file);
    REQUIRE(back.ok());
    CHECK(back.value().size() == image.size());
    CHECK(back.value().rgba == image.rgba);
}

TEST_CASE("a file that is no picture is refused with its name, and so is one that is not there") {
    const fs::path file = temporary("words.png");
    std::ofstream(file) << "these are words";
    const Result<Image> words = loadPng(file);
    fs::remove(file);
    REQUIRE_FALSE(words.ok());
    CHECK(words.error().code == ErrorCode::input);
    CHECK(words.error().location == file.string());
    CHECK_FALSE(loadPng(temporary("nowhere.png")).ok());
}

TEST_CASE("a PNG cut short is refused") {
    const fs::path file = temporary("cut.png");
    REQUIRE(savePng(gradient(), file).ok());
    const auto bytes = readFile(file);
    REQUIRE(bytes.ok());
    fs::resize_file(file, bytes.value().size() / 3);
    CHECK_FALSE(loadPng(file).ok());
    fs::remove(file);
}

TEST_CASE("a picture that can't be written is an output error") {
    const Result<void> saved = savePng(gradient(), "/proc/lutka/picture.png");
    REQUIRE_FALSE(saved.ok());
    CHECK(saved.error().code == ErrorCode::output);
}

TEST_CASE("equal pictures do not differ") {
    const ImageDifference difference = compareImages(gradient(), gradient(), 0);
    CHECK(difference.sameSize);
    CHECK(difference.differingShare == 0.0);
    CHECK(difference.meanError == 0.0);
    CHECK(difference.maxError == 0);
}

TEST_CASE("a changed pixel counts when it is off by more than the tolerance") {
    const Image image = gradient();
    Image other = image;
    Color color = other.at(5, 7);
    color.g = static_cast<std::uint8_t>(color.g + 10);
    other.set(5, 7, color);
    const double one = 1.0 / (37.0 * 23.0);
    CHECK(compareImages(image, other, 9).differingShare == Approx(one));
    CHECK(compareImages(image, other, 10).differingShare == 0.0);
    CHECK(compareImages(image, other, 10).maxError == 10);
    CHECK(compareImages(image, other, 10).meanError == Approx(10.0 * one / 4.0));
    CHECK(differenceImage(image, other, 9).at(5, 7) == Color{255, 0, 0, 255});
    CHECK(differenceImage(image, other, 10).at(5, 7) != Color{255, 0, 0, 255});
}

TEST_CASE("pictures of different sizes differ wholly") {
    const ImageDifference difference = compareImages(Image({4, 5}, colors::red), Image({5, 4}, colors::red), 255);
    CHECK_FALSE(difference.sameSize);
    CHECK(difference.differingShare == 1.0);
}

TEST_CASE("every 8-bit sRGB value survives the way through linear light") {
    for (int value = 0; value < 256; ++value) {
        const auto byte = static_cast<std::uint8_t>(value);
        const Color color{byte, static_cast<std::uint8_t>(255 - value), byte, byte};
        CHECK(fromLinear(toLinear(color)) == color);
    }
    // IEC 61966-2-1: half-way grey 188 is 0.5 of the light.
    CHECK(toLinear({188, 188, 188, 255}).r == Approx(0.5F).margin(0.005));
}
