#include "animation/import/assimp/b3d_bytes.hpp"

#include <cstdint>
#include <cstring>

#include "animation/import/source_limits.hpp"

namespace lutka::animation::rig_import {
namespace {

constexpr std::size_t kHead = 8;          // of a chunk: its tag and its size
constexpr std::size_t kNodeNumbers = 40;  // place, scale and rotation, after a node's name
constexpr std::size_t kVertexHead = 12;   // flags, sets of UVs and their size
constexpr std::size_t kWeight = 8;        // a vertex' number and its weight
constexpr std::size_t kTexture = 28;      // flags, blend mode, place, scale and turn, after a texture's name
constexpr std::size_t kBrush = 28;        // colour, opacity, shine, blend mode and effects, after a brush's name
constexpr std::uint32_t kNoTexture = 0xFFFFFFFFU;
constexpr std::uint32_t kHasNormal = 1;  // flags of vertices
constexpr std::uint32_t kHasColor = 2;

class Walker {
  public:
    explicit Walker(std::string& bytes) : bytes_(bytes) {}

    // The chunks from `at` to `end`, below a mesh whose vertices start at that count. False where they are damaged.
    bool walk(std::size_t at, std::size_t end, std::uint32_t start, int depth) {
        if (depth > kMaxDepth) return false;
        while (at + kHead <= end) {
            const std::string_view tag(bytes_.data() + at, 4);
            const std::size_t body = at + kHead;
            const std::size_t next = body + number(at + 4);
            if (next > end) return false;
            if (tag == "MESH") {
                start = vertices_;
                if (!walk(body + 4, next, start, depth + 1)) return false;
            } else if (tag == "NODE") {
                const std::size_t name = bytes_.find('\0', body);
                if (name == std::string::npos || name + 1 + kNodeNumbers > next) return false;
                if (!walk(name + 1 + kNodeNumbers, next, start, depth + 1)) return false;
            } else if (tag == "VRTS") {
                if (!countVertices(body, next)) return false;
            } else if (tag == "TEXS") {
                countTextures(body, next);
            } else if (tag == "BRUS") {
                clearMissingTextures(body, next);
            } else if (tag == "BONE" && start > 0) {
                for (std::size_t weight = body; weight + kWeight <= next; weight += kWeight)
                    setNumber(weight, number(weight) + start);
            }
            at = next;
        }
        return true;
    }

  private:
    bool countVertices(std::size_t body, std::size_t end) {
        if (body + kVertexHead > end) return false;
        const std::uint32_t flags = number(body);
        const std::uint64_t uvs = std::uint64_t{number(body + 4)} * number(body + 8);
        if (uvs > 64) return false;
        const std::uint64_t size =
            12 + ((flags & kHasNormal) != 0 ? 12 : 0) + ((flags & kHasColor) != 0 ? 16 : 0) + 4 * uvs;
        vertices_ += static_cast<std::uint32_t>((end - body - kVertexHead) / size);
        return true;
    }

    void countTextures(std::size_t at, std::size_t end) {
        for (std::size_t name = bytes_.find('\0', at); name < end; name = bytes_.find('\0', at)) {
            at = name + 1 + kTexture;
            if (at <= end) ++textures_;
        }
    }

    // Blender's exporter leaves out a texture whose picture it can't find, and not what refers to it.
    void clearMissingTextures(std::size_t body, std::size_t end) {
        if (body + 4 > end) return;
        const std::uint32_t count = number(body);
        if (count > (end - body) / 4) return;
        std::size_t at = body + 4;
        for (std::size_t name = bytes_.find('\0', at); name < end; name = bytes_.find('\0', at)) {
            at = name + 1 + kBrush;
            for (std::uint32_t slot = 0; slot < count && at + 4 <= end; ++slot, at += 4) {
                if (number(at) != kNoTexture && number(at) >= textures_) setNumber(at, kNoTexture);
            }
        }
    }

    [[nodiscard]] std::uint32_t number(std::size_t at) const {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes_.data() + at, sizeof value);
        return value;
    }
    void setNumber(std::size_t at, std::uint32_t value) { std::memcpy(bytes_.data() + at, &value, sizeof value); }

    std::string& bytes_;
    std::uint32_t vertices_ = 0;
    std::uint32_t textures_ = 0;
};

}  // namespace

bool isB3d(std::string_view start) {
    return start.starts_with("BB3D");
}

std::string tidyB3d(std::string_view bytes) {
    constexpr std::size_t kVersion = 4;
    std::string out(bytes);
    Walker(out).walk(kHead + kVersion, out.size(), 0, 0);
    return out;
}

}  // namespace lutka::animation::rig_import
