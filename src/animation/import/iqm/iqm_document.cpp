#include "animation/import/iqm/iqm_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "animation/import/source_limits.hpp"

namespace lutka::animation::rig_import::iqm {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kMagic = "INTERQUAKEMODEL\0"sv;
constexpr std::size_t kMeshBytes = 24, kVertexArrayBytes = 20, kTriangleBytes = 12, kAnimationBytes = 20;
constexpr std::size_t kMaxFrameNumbers = 64'000'000;  // of all joints and frames, as a BVH may have
constexpr double kAnyRate = 30.0;                     // frames a second, where the file says nothing

enum ArrayKind : std::uint32_t { position, texcoord, normal, tangent, blendIndexes, blendWeights, color };
enum ComponentType : std::uint32_t { byte, ubyte, shortInt, ushortInt, integer, uinteger, half, single, dbl };

struct Section {
    std::size_t count = 0, offset = 0;
};

// The header's numbers that are used, in the file's order.
struct Header {
    std::uint32_t version = 0;
    Section text, meshes, vertexArrays, triangles, joints, poses, animations, frames;
    std::size_t vertexCount = 0;
    std::size_t frameChannels = 0;
};

// 0 for a type that there is not.
std::size_t componentBytes(std::uint32_t type) {
    constexpr std::array<std::size_t, 9> kBytes = {1, 1, 2, 2, 4, 4, 2, 4, 8};
    return type < kBytes.size() ? kBytes[type] : 0;
}

float fromHalf(std::uint16_t bits) {
    const int exponent = bits >> 10U & 0x1F;
    const auto fraction = static_cast<float>(bits & 0x3FFU);
    const float sign = (bits & 0x8000U) != 0 ? -1.0F : 1.0F;
    if (exponent == 31) return std::numeric_limits<float>::quiet_NaN();
    if (exponent == 0) return sign * std::ldexp(fraction, -24);
    return sign * std::ldexp(1024.0F + fraction, exponent - 25);
}

class Parser {
  public:
    Parser(std::span<const unsigned char> bytes, std::string location)
        : bytes_(bytes), location_(std::move(location)) {}

    Result<IqmDocument> parse() {
        if (!readHeader()) return error_;
        if (!readJoints() || !readMeshes() || !readVertices() || !readTriangles() || !readAnimations()) return error_;
        return std::move(document_);
    }

  private:
    template <class T>
    [[nodiscard]] T value(std::size_t at) const {
        T out;
        std::memcpy(&out, bytes_.data() + at, sizeof(T));
        return out;
    }
    [[nodiscard]] std::uint32_t number(std::size_t at) const { return value<std::uint32_t>(at); }
    [[nodiscard]] double real(std::size_t at) const { return static_cast<double>(value<float>(at)); }
    [[nodiscard]] glm::dvec3 vector(std::size_t at) const { return {real(at), real(at + 4), real(at + 8)}; }

    bool fail(std::string message) {
        error_ = Error{ErrorCode::input, std::move(message), location_,
                       "the file is cut off or damaged: copy it anew, or export it again"};
        return false;
    }

    // Whether `count` records of that size lie within the file.
    bool holds(const Section& section, std::size_t record, const char* what) {
        if (section.count == 0) return true;
        if (section.offset <= bytes_.size() && section.count <= (bytes_.size() - section.offset) / record) return true;
        return fail(fmt::format("its {} {} end behind the file's end", section.count, what));
    }

    bool readHeader() {
        constexpr std::size_t kHeaderBytes = 16 + 27 * 4;
        if (bytes_.size() < kHeaderBytes) return fail("its header is cut off");
        const auto at = [&](int index) { return std::size_t{number(16 + 4 * static_cast<std::size_t>(index))}; };
        header_.version = number(16);
        if (header_.version != 1 && header_.version != 2) {
            error_ = Error{ErrorCode::input, fmt::format("is IQM {}; versions 1 and 2 can be read", header_.version),
                           location_, "export it as IQM 2, glTF 2.0 or FBX"};
            return false;
        }
        document_.version = static_cast<int>(header_.version);
        header_.text = {at(3), at(4)};
        header_.meshes = {at(5), at(6)};
        header_.vertexArrays = {at(7), at(9)};
        header_.vertexCount = at(8);
        header_.triangles = {at(10), at(11)};
        header_.joints = {at(13), at(14)};
        header_.poses = {at(15), at(16)};
        header_.animations = {at(17), at(18)};
        header_.frames = {at(19), at(21)};
        header_.frameChannels = at(20);
        if (header_.joints.count > kMaxNodes - kMaxMeshes || header_.meshes.count > kMaxMeshes) {
            error_ = tooManyNodes(location_);
            return false;
        }
        if (header_.vertexCount > kMaxVertices || header_.triangles.count > kMaxCorners / 3)
            return fail(fmt::format("has {} vertices and {} triangles, more than can be read", header_.vertexCount,
                                    header_.triangles.count));
        return holds(header_.text, 1, "bytes of names");
    }

    // The name at a place of the text section; empty for one outside of it.
    [[nodiscard]] std::string text(std::uint32_t at) const {
        if (at >= header_.text.count) return "";
        const std::string_view all(reinterpret_cast<const char*>(bytes_.data()) + header_.text.offset,
                                   header_.text.count);
        const std::string_view from = all.substr(at);
        return std::string(from.substr(0, from.find('\0')));
    }

    // Version 1 leaves out the rotation's real part, which is not positive there.
    [[nodiscard]] std::size_t placementNumbers() const { return header_.version == 1 ? 9 : 10; }
    [[nodiscard]] Placement placementOf(std::span<const double> numbers) const {
        Placement out;
        out.translation = {numbers[0], numbers[1], numbers[2]};
        const glm::dvec3 imaginary(numbers[3], numbers[4], numbers[5]);
        const double realPart =
            header_.version == 1 ? -std::sqrt(std::max(1.0 - glm::dot(imaginary, imaginary), 0.0)) : numbers[6];
        const glm::dquat rotation(realPart, imaginary.x, imaginary.y, imaginary.z);
        const double length = glm::length(rotation);
        if (std::isfinite(length) && length > 1e-6) out.rotation = rotation / length;
        const std::size_t scale = placementNumbers() - 3;
        out.scale = {numbers[scale], numbers[scale + 1], numbers[scale + 2]};
        return out;
    }

    bool readJoints() {
        const std::size_t record = 8 + 4 * placementNumbers();
        if (!holds(header_.joints, record, "joints")) return false;
        std::vector<int> depths;
        for (std::size_t i = 0; i < header_.joints.count; ++i) {
            const std::size_t at = header_.joints.offset + i * record;
            Joint joint;
            joint.name = text(number(at));
            joint.parent = value<std::int32_t>(at + 4);
            if (joint.parent >= static_cast<int>(i))
                return fail(fmt::format("joint {} (\"{}\") names joint {} as its parent, which comes later", i,
                                        joint.name, joint.parent));
            joint.parent = std::max(joint.parent, -1);
            depths.push_back(joint.parent < 0 ? 0 : depths[static_cast<std::size_t>(joint.parent)] + 1);
            if (depths.back() > kMaxDepth) {
                error_ = nestedTooDeep(location_);
                return false;
            }
            std::array<double, 10> numbers{};
            for (std::size_t k = 0; k < placementNumbers(); ++k)
                numbers[k] = real(at + 8 + 4 * k);
            joint.bind = placementOf(numbers);
            document_.joints.push_back(std::move(joint));
        }
        return true;
    }

    bool readMeshes() {
        if (!holds(header_.meshes, kMeshBytes, "meshes")) return false;
        std::size_t vertices = 0;
        std::size_t triangles = 0;
        for (std::size_t i = 0; i < header_.meshes.count; ++i) {
            const std::size_t at = header_.meshes.offset + i * kMeshBytes;
            Mesh mesh{text(number(at)), text(number(at + 4)), number(at + 8),
                      number(at + 12),  number(at + 16),      number(at + 20)};
            if (mesh.firstVertex + mesh.vertexCount > header_.vertexCount ||
                mesh.firstTriangle + mesh.triangleCount > header_.triangles.count)
                return fail(
                    fmt::format("mesh {} (\"{}\") has vertices or triangles that the file has not", i, mesh.name));
            vertices += mesh.vertexCount;
            triangles += mesh.triangleCount;
            // Meshes of one file share nothing; each is a copy of its range.
            if (vertices > kMaxVertices || triangles > kMaxCorners / 3)
                return fail("its meshes overlap and have more vertices together than can be read");
            document_.meshes.push_back(std::move(mesh));
        }
        return true;
    }

    [[nodiscard]] float component(std::uint32_t type, std::size_t at) const {
        switch (type) {
            case byte:
                return static_cast<float>(value<std::int8_t>(at));
            case ubyte:
                return static_cast<float>(value<std::uint8_t>(at));
            case shortInt:
                return static_cast<float>(value<std::int16_t>(at));
            case ushortInt:
                return static_cast<float>(value<std::uint16_t>(at));
            case integer:
                return static_cast<float>(value<std::int32_t>(at));
            case uinteger:
                return static_cast<float>(value<std::uint32_t>(at));
            case half:
                return fromHalf(value<std::uint16_t>(at));
            case single:
                return value<float>(at);
            default:
                return static_cast<float>(value<double>(at));
        }
    }

    VertexArray* arrayOf(std::uint32_t kind, std::uint32_t size) {
        const bool isVector = size == 3;
        switch (kind) {
            case position:
                return isVector ? &document_.positions : nullptr;
            case texcoord:
                return size == 2 ? &document_.uvs : nullptr;
            case normal:
                return isVector ? &document_.normals : nullptr;
            case blendIndexes:
                return size <= 8 ? &document_.blendIndices : nullptr;
            case blendWeights:
                return size <= 8 ? &document_.blendWeights : nullptr;
            case color:
                return isVector || size == 4 ? &document_.colors : nullptr;
            default:
                return nullptr;  // tangents are made anew; others are the exporter's own
        }
    }

    bool readVertices() {
        document_.vertexCount = header_.vertexCount;
        if (!holds(header_.vertexArrays, kVertexArrayBytes, "vertex arrays")) return false;
        for (std::size_t i = 0; i < header_.vertexArrays.count; ++i) {
            const std::size_t at = header_.vertexArrays.offset + i * kVertexArrayBytes;
            const std::uint32_t kind = number(at);
            const std::uint32_t type = number(at + 8);
            const std::uint32_t size = number(at + 12);
            const std::size_t bytes = componentBytes(type);
            VertexArray* to = size == 0 || bytes == 0 ? nullptr : arrayOf(kind, size);
            if (to == nullptr || !to->empty()) continue;
            if (!holds({header_.vertexCount, number(at + 16)}, bytes * size, "vertices")) return false;
            to->components = static_cast<int>(size);
            constexpr std::array kMost = {127.0F, 255.0F, 32767.0F, 65535.0F, 2147483647.0F, 4294967295.0F};
            to->most = type < kMost.size() ? kMost[type] : 1.0F;
            to->values.reserve(header_.vertexCount * size);
            for (std::size_t k = 0; k < header_.vertexCount * size; ++k)
                to->values.push_back(component(type, number(at + 16) + k * bytes));
        }
        if (document_.positions.empty() && !document_.meshes.empty()) return fail("its vertices have no positions");
        return true;
    }

    bool readTriangles() {
        if (!holds(header_.triangles, kTriangleBytes, "triangles")) return false;
        document_.corners.reserve(header_.triangles.count * 3);
        for (std::size_t i = 0; i < header_.triangles.count * 3; ++i) {
            document_.corners.push_back(number(header_.triangles.offset + 4 * i));
            if (document_.corners.back() >= header_.vertexCount)
                return fail(fmt::format("triangle {} names vertex {}, of which there are {}", i / 3,
                                        document_.corners.back(), header_.vertexCount));
        }
        return true;
    }

    bool readAnimations() {
        const std::size_t numbers = placementNumbers();
        const std::size_t record = 8 + 8 * numbers;
        if (header_.animations.count == 0 || header_.frames.count == 0) return true;
        if (header_.poses.count != header_.joints.count) {
            document_.warnings.push_back(
                fmt::format("animations were left out: they move {} joints, and the model has {}", header_.poses.count,
                            header_.joints.count));
            return true;
        }
        if (!holds(header_.animations, kAnimationBytes, "animations") || !holds(header_.poses, record, "poses"))
            return false;
        if (header_.frames.count > kMaxFrameNumbers / std::max<std::size_t>(numbers * header_.joints.count, 1))
            return fail(fmt::format("has {} frames of {} joints, more than can be read", header_.frames.count,
                                    header_.joints.count));
        // Where no channel moves, all frames are the poses' offsets, and the file holds none.
        if (header_.frameChannels == 0)
            header_.frames.count = 1;
        else if (!holds(header_.frames, header_.frameChannels * 2, "frames"))
            return false;
        std::size_t channels = 0;
        for (std::size_t i = 0; i < header_.poses.count; ++i)
            channels += static_cast<std::size_t>(__builtin_popcount(maskAt(i)));
        if (channels != header_.frameChannels)
            return fail(
                fmt::format("its poses move {} channels, and its frames have {}", channels, header_.frameChannels));
        std::size_t at = header_.frames.offset;
        for (std::size_t frame = 0; frame < header_.frames.count; ++frame) {
            for (std::size_t i = 0; i < header_.poses.count; ++i)
                document_.frames.push_back(placementIn(i, at));
        }
        document_.frameCount = header_.frames.count;
        return readRanges();
    }

    [[nodiscard]] std::size_t poseAt(std::size_t pose) const {
        return header_.poses.offset + pose * (8 + 8 * placementNumbers());
    }
    [[nodiscard]] std::uint32_t maskAt(std::size_t pose) const {
        return number(poseAt(pose) + 4) & ((1U << placementNumbers()) - 1U);
    }

    // A joint in the frame whose next channel is at `at`, which goes on behind what it has of it.
    Placement placementIn(std::size_t pose, std::size_t& at) const {
        const std::size_t offsets = poseAt(pose) + 8;
        const std::size_t scales = offsets + 4 * placementNumbers();
        const std::uint32_t mask = maskAt(pose);
        std::array<double, 10> out{};
        for (std::size_t k = 0; k < placementNumbers(); ++k) {
            out[k] = real(offsets + 4 * k);
            if ((mask >> k & 1U) == 0) continue;
            out[k] += static_cast<double>(value<std::uint16_t>(at)) * real(scales + 4 * k);
            at += 2;
        }
        return placementOf(out);
    }

    bool readRanges() {
        bool unknownRate = false;
        std::size_t played = 0;
        const std::size_t mostPlayed =
            kMaxFrameNumbers / std::max<std::size_t>(placementNumbers() * header_.joints.count, 1);
        for (std::size_t i = 0; i < header_.animations.count; ++i) {
            const std::size_t at = header_.animations.offset + i * kAnimationBytes;
            Animation animation{text(number(at)), number(at + 4), number(at + 8), real(at + 12)};
            if (header_.frameChannels == 0) animation.firstFrame = 0;
            if (animation.firstFrame >= header_.frames.count) {
                document_.warnings.push_back(
                    fmt::format("animation \"{}\" was left out: it begins at frame {}, and the file has {}",
                                animation.name, animation.firstFrame, header_.frames.count));
                continue;
            }
            animation.frameCount = std::min(animation.frameCount, header_.frames.count - animation.firstFrame);
            if (!(animation.frameRate > 0.0) || !std::isfinite(animation.frameRate)) {
                animation.frameRate = kAnyRate;
                unknownRate = true;
            }
            // Each becomes a clip with keys of its own.
            played += animation.frameCount;
            if (played > mostPlayed) return fail("its animations overlap and have more frames than can be read");
            if (animation.frameCount > 0) document_.animations.push_back(std::move(animation));
        }
        if (unknownRate)
            document_.warnings.push_back(
                fmt::format("animations without a rate play at {:.0f} frames a second", kAnyRate));
        return true;
    }

    std::span<const unsigned char> bytes_;
    std::string location_;
    Header header_;
    IqmDocument document_;
    Error error_{ErrorCode::input, "", "", ""};
};

}  // namespace

bool isIqm(std::string_view start) {
    return start.starts_with(kMagic);
}

Result<IqmDocument> parseIqm(std::span<const unsigned char> bytes, const std::string& location) {
    return Parser(bytes, location).parse();
}

}  // namespace lutka::animation::rig_import::iqm
