#include "render/environment.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/random.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::render;

namespace {

namespace fs = std::filesystem;

/// A file that is gone with the test.
struct HdrFile {
    test::ScratchFolder folder;  // of its own: tests run side by side
    fs::path path = folder / "sky.hdr";
    explicit HdrFile(const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }
};

std::string header(int width, int height) {
    return "#?RADIANCE\n# made by a test\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
           std::to_string(width) + "\n";
}

// A row of one colour, run-length encoded: mantissas 128, 64, 32 with that exponent.
std::string runRow(int width, int exponent) {
    std::string row{2, 2, static_cast<char>(width >> 8), static_cast<char>(width & 255)};
    for (const int channel : {128, 64, 32, exponent}) {
        for (int left = width; left > 0; left -= 100) {
            row.push_back(static_cast<char>(128 + std::min(left, 100)));
            row.push_back(static_cast<char>(channel));
        }
    }
    return row;
}

std::string evenPanorama() {
    std::string bytes = header(256, 128);
    for (int y = 0; y < 128; ++y)
        bytes += runRow(256, 129);
    return bytes;
}

std::string refusal(const std::string& bytes) {
    const HdrFile file(bytes);
    const Result<Environment> loaded = loadHdr(file.path);
    if (loaded) return "";
    CHECK(loaded.error().code == ErrorCode::input);
    CHECK(loaded.error().location == file.path.string());
    return loaded.error().message;
}

// Lit from one side only.
Environment halfLit() {
    Environment environment{64, 32, std::vector<vec3>(64 * 32, vec3(0.1F))};
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 64; ++x)
            environment.radiance[static_cast<std::size_t>(y * 64 + x)] = vec3(1.0F, 0.8F, 0.4F);
    }
    return environment;
}

}  // namespace

TEST_CASE("a run-length encoded panorama is read with its colours and size") {
    const HdrFile file(evenPanorama());
    const Result<Environment> loaded = loadHdr(file.path);
    REQUIRE(loaded);
    CHECK(loaded.value().width == 256);
    CHECK(loaded.value().height == 128);
    for (const vec3& light : loaded.value().radiance)
        REQUIRE(glm::length(light - vec3(1.0F, 0.5F, 0.25F)) < 1e-6F);
}

TEST_CASE("plain pixels, and runs of the old kind, are read too") {
    // Two rows of four: below eight columns nothing is encoded; (1, 1, 1, 2) repeats the pixel before twice.
    const std::string red{static_cast<char>(128), 0, 0, static_cast<char>(129)};
    const std::string dark{0, 0, 0, 0};
    const HdrFile file(header(4, 2) + red + std::string{1, 1, 1, 2} + dark + dark + dark + red + red);
    const Result<Environment> loaded = loadHdr(file.path);
    REQUIRE(loaded);
    const std::vector<float> expected = {1, 1, 1, 0, 0, 0, 1, 1};
    for (std::size_t i = 0; i < expected.size(); ++i)
        CHECK(loaded.value().radiance[i].x == Approx(expected[i]));
}

TEST_CASE("a panorama that is cut off anywhere is refused and never waited for") {
    const std::string whole = evenPanorama();
    for (std::size_t size = 0; size < whole.size(); size += 97)
        CHECK_FALSE(refusal(whole.substr(0, size)).empty());
    CHECK(refusal(whole.substr(0, whole.size() - 1)).find("row 127") != std::string::npos);
}

TEST_CASE("a panorama with damage says what is wrong with it") {
    CHECK(refusal("hello").find("Radiance") != std::string::npos);
    CHECK(refusal("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 2 +X 4\n").find("rgbe") != std::string::npos);
    CHECK(refusal("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n+Y 2 +X 4\n").find("rows") != std::string::npos);
    CHECK(refusal(header(0, 4)).find("no size") != std::string::npos);
    CHECK(refusal(header(-3, 4)).find("no size") != std::string::npos);
    CHECK(refusal(header(2000000000, 2)).find("8192") != std::string::npos);
    CHECK(refusal(header(4, 2) + std::string(32, '\0')).find("black") != std::string::npos);
    // A run that leaves its row, one of no length, a row of another width, a repeat of nothing.
    CHECK(refusal(header(16, 1) + std::string{2, 2, 0, 16, static_cast<char>(128 + 17), 1}).find("row 0") !=
          std::string::npos);
    CHECK(refusal(header(16, 1) + std::string{2, 2, 0, 16, 0, 1}).find("row 0") != std::string::npos);
    CHECK(refusal(header(16, 1) + std::string{2, 2, 0, 15}).find("row 0") != std::string::npos);
    CHECK(refusal(header(4, 1) + std::string{1, 1, 1, 4}).find("row 0") != std::string::npos);
    const Result<Environment> none = loadHdr("/nowhere/sky.hdr");
    REQUIRE_FALSE(none);
    CHECK(none.error().code == ErrorCode::input);
}

TEST_CASE("a direction finds its place in the panorama and back") {
    Random random(4);
    for (int i = 0; i < 200; ++i) {
        const vec3 raw(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        if (glm::length(raw) < 0.1F) continue;
        const vec3 direction = glm::normalize(raw);
        CHECK(glm::distance(panoramaDirection(panoramaUv(direction)), direction) < 1e-3F);
    }
    CHECK(panoramaUv(vec3(0, 0, -1)).x == Approx(0.5F));
    CHECK(panoramaUv(vec3(1, 0, 0)).x == Approx(0.75F));
    CHECK(panoramaUv(vec3(0, 1, 0)).y == Approx(0.0F).margin(1e-3));
}

TEST_CASE("even light from everywhere lights every normal and every roughness the same") {
    const Environment even{64, 32, std::vector<vec3>(64 * 32, vec3(3.0F))};
    const EnvironmentLight light = makeEnvironmentLight(even);
    const float level = light.reflections[0].radiance[0].x;
    CHECK(level == Approx(3.0F * light.gain));
    for (const vec3& normal : {vec3(0, 1, 0), vec3(0, -1, 0), vec3(1, 0, 0), vec3(0, 0.6F, -0.8F)})
        CHECK(diffuseLight(light, normal).x == Approx(level).epsilon(0.01));
    for (const auto& one : light.reflections) {
        CHECK(one.radiance.size() == static_cast<std::size_t>(one.width) * static_cast<std::size_t>(one.height));
        for (const vec3& texel : one.radiance)
            REQUIRE(texel.x == Approx(level).epsilon(0.01));
    }
}

TEST_CASE("the harmonics equal the integral over the hemisphere where the light is smooth") {
    // Radiance 1 + y: irradiance / pi is 1 + 2/3 n.y, in closed form.
    Environment slope{128, 64, {}};
    for (int y = 0; y < 64; ++y) {
        const float up = std::cos((static_cast<float>(y) + 0.5F) / 64.0F * kPi);
        slope.radiance.insert(slope.radiance.end(), 128, vec3(1.0F + up));
    }
    const EnvironmentLight light = makeEnvironmentLight(slope);
    for (const float up : {-1.0F, -0.5F, 0.0F, 0.3F, 1.0F}) {
        const vec3 normal(std::sqrt(1.0F - up * up), up, 0);
        const float exact = light.gain * (1.0F + 2.0F / 3.0F * up);
        CHECK(diffuseLight(light, normal).x == Approx(exact).margin(0.01 * static_cast<double>(light.gain)));
    }
}

TEST_CASE("rough reflections lie between the bright and the dark half and sharp ones keep the edge") {
    const EnvironmentLight light = makeEnvironmentLight(halfLit());
    const auto& sharp = light.reflections.front();
    const auto& rough = light.reflections.back();
    const float bright = sharp.radiance.front().x;
    const float dark = sharp.radiance.back().x;
    CHECK(bright == Approx(10.0F * dark).epsilon(0.01));
    CHECK(rough.radiance.front().x < bright);
    CHECK(rough.radiance.back().x > dark);
    CHECK(rough.radiance.front().x > rough.radiance.back().x);
    CHECK(diffuseLight(light, {0, 1, 0}).x > diffuseLight(light, {0, -1, 0}).x);
}

TEST_CASE("a tiny sun in the panorama is held down and does not swallow the rest") {
    Environment sunny{64, 32, std::vector<vec3>(64 * 32, vec3(1.0F))};
    sunny.radiance[64 * 8 + 20] = vec3(60000.0F);
    const EnvironmentLight light = makeEnvironmentLight(sunny);
    float most = 0.0F;
    for (const vec3& texel : light.reflections[0].radiance) {
        CHECK(isFinite(texel));
        most = std::max(most, texel.x);
    }
    CHECK(most <= 30.0F * 0.65F * 1.01F);
}
