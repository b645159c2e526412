/// Radiance's picture format (*.hdr), read without trust: stb_image does not come back from a cut-off one.

#include "render/environment.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>

#include "core/files.hpp"

namespace lutka::render {
namespace {

constexpr int kWidest = 8192;
constexpr int kHighest = 4096;
constexpr std::size_t kRgbeChannels = 4;  // red, green, blue, exponent

/// Reads bytes and lines, and remembers when there were none left.
class Reader {
  public:
    explicit Reader(std::span<const unsigned char> bytes) : bytes_(bytes) {}

    [[nodiscard]] bool ended() const { return ended_; }
    int byte() {
        if (at_ >= bytes_.size()) {
            ended_ = true;
            return 0;
        }
        return bytes_[at_++];
    }
    std::string line() {
        std::string text;
        for (int c = byte(); !ended_ && c != '\n'; c = byte())
            text.push_back(static_cast<char>(c));
        if (!text.empty() && text.back() == '\r') text.pop_back();
        return text;
    }
    void back(std::size_t count) { at_ -= count; }

  private:
    std::span<const unsigned char> bytes_;
    std::size_t at_ = 0;
    bool ended_ = false;
};

// What is wrong with the header; empty when nothing is, and the size is then set.
std::string readHeader(Reader& reader, int& width, int& height) {
    const std::string magic = reader.line();
    if (magic.rfind("#?RADIANCE", 0) != 0 && magic.rfind("#?RGBE", 0) != 0) return "is not a Radiance picture (.hdr)";
    bool known = false;
    for (std::string line = reader.line(); !line.empty() && !reader.ended(); line = reader.line())
        known = known || line == "FORMAT=32-bit_rle_rgbe";
    if (!known) return "is not in the format 32-bit_rle_rgbe";
    const std::string size = reader.line();
    if (std::sscanf(size.c_str(), "-Y %d +X %d", &height, &width) != 2) return "does not have its rows from the top";
    if (width < 1 || height < 1) return "has no size";
    if (width > kWidest || height > kHighest) return "has more than 8192 x 4096 pixels";
    return "";
}

// A row whose channels are run-length encoded one after the other. False when a run leaves the row.
bool readRuns(Reader& reader, std::span<unsigned char> row) {
    constexpr int kRun = 128;
    const std::size_t width = row.size() / kRgbeChannels;
    for (std::size_t channel = 0; channel < kRgbeChannels; ++channel) {
        for (std::size_t x = 0; x < width;) {
            int count = reader.byte();
            const bool run = count > kRun;
            if (run) count -= kRun;
            if (count == 0 || x + static_cast<std::size_t>(count) > width || reader.ended()) return false;
            const int value = run ? reader.byte() : 0;
            for (; count > 0; --count, ++x)
                row[x * kRgbeChannels + channel] = static_cast<unsigned char>(run ? value : reader.byte());
        }
    }
    return !reader.ended();
}

// A row of plain pixels; (1, 1, 1, n) repeats the pixel before, shifted further with each such pixel in turn.
bool readPlain(Reader& reader, std::span<unsigned char> row) {
    int shift = 0;
    for (std::size_t x = 0; x < row.size();) {
        std::array<unsigned char, kRgbeChannels> pixel{};
        for (unsigned char& channel : pixel)
            channel = static_cast<unsigned char>(reader.byte());
        if (reader.ended()) return false;
        const bool repeats = pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1;
        if (!repeats) {
            std::copy(pixel.begin(), pixel.end(), row.begin() + static_cast<std::ptrdiff_t>(x));
            x += kRgbeChannels;
            shift = 0;
            continue;
        }
        if (x == 0 || shift > 16) return false;
        const std::size_t count = static_cast<std::size_t>(pixel[3]) << static_cast<unsigned>(shift);
        if (x + count * kRgbeChannels > row.size()) return false;
        for (std::size_t i = 0; i < count * kRgbeChannels; ++i, ++x)
            row[x] = row[x - kRgbeChannels];
        shift += 8;
    }
    return true;
}

bool readRow(Reader& reader, std::span<unsigned char> row) {
    constexpr std::size_t kLeastRuns = 8;
    constexpr std::size_t kMostRuns = 32767;
    const std::size_t width = row.size() / kRgbeChannels;
    if (width < kLeastRuns || width > kMostRuns) return readPlain(reader, row);
    const int first = reader.byte();
    const int second = reader.byte();
    const auto high = static_cast<std::size_t>(reader.byte());
    const auto low = static_cast<std::size_t>(reader.byte());
    if (reader.ended()) return false;
    if (first != 2 || second != 2 || high >= 128) {
        reader.back(kRgbeChannels);
        return readPlain(reader, row);
    }
    return high * 256 + low == width && readRuns(reader, row);
}

vec3 decoded(const unsigned char* pixel) {
    constexpr int kBias = 128 + 8;
    if (pixel[3] == 0) return vec3(0);
    return vec3(pixel[0], pixel[1], pixel[2]) * std::ldexp(1.0F, pixel[3] - kBias);
}

}  // namespace

vec2 panoramaUv(const vec3& direction) {
    const float heading = std::atan2(direction.x, -direction.z);  // 0 towards -Z, grows towards +X
    return {heading / (2.0F * kPi) + 0.5F, std::acos(std::clamp(direction.y, -1.0F, 1.0F)) / kPi};
}

vec3 panoramaDirection(const vec2& uv) {
    const float heading = (uv.x - 0.5F) * 2.0F * kPi;
    const float fromUp = uv.y * kPi;
    const float across = std::sin(fromUp);
    return {across * std::sin(heading), std::cos(fromUp), -across * std::cos(heading)};
}

Result<Environment> loadHdr(const std::filesystem::path& file) {
    const Result<std::vector<unsigned char>> bytes = readFile(file, std::size_t{1} << 28U);
    if (!bytes) return bytes.error();
    const auto fail = [&](const std::string& why) {
        return Error{ErrorCode::input, why, file.string(), "give an equirectangular .hdr panorama"};
    };
    Reader reader(bytes.value());
    Environment environment;
    const std::string defect = readHeader(reader, environment.width, environment.height);
    if (!defect.empty()) return fail(defect);
    const auto width = static_cast<std::size_t>(environment.width);
    const auto height = static_cast<std::size_t>(environment.height);
    std::vector<unsigned char> row(width * kRgbeChannels);
    bool lit = false;
    for (std::size_t y = 0; y < height; ++y) {
        if (!readRow(reader, row)) return fail("is damaged or cut off in row " + std::to_string(y));
        // Row by row, so that a header that lies about its size allocates little.
        for (std::size_t x = 0; x < width; ++x) {
            const vec3 light = decoded(&row[x * kRgbeChannels]);
            lit = lit || light.x > 0 || light.y > 0 || light.z > 0;
            environment.radiance.push_back(light);
        }
    }
    if (!lit) return fail("is black all over: it gives no light");
    return environment;
}

vec3 meanRadiance(const Environment& environment) {
    glm::dvec3 sum(0);
    double weights = 0.0;
    for (int y = 0; y < environment.height; ++y) {
        const double part = (static_cast<double>(y) + 0.5) / environment.height;
        const double weight = std::sin(part * static_cast<double>(kPi));
        for (int x = 0; x < environment.width; ++x)
            sum += weight * glm::dvec3(environment.at(x, y));
        weights += weight * environment.width;
    }
    return vec3(sum / weights);
}

}  // namespace lutka::render
