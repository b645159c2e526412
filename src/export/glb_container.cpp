#include "export/glb_container.hpp"

#include <cstdint>
#include <cstring>

#include "core/assert.hpp"
#include "core/base64.hpp"
#include "core/json/json_text.hpp"

namespace lutka::exporting {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;  // "glTF"
constexpr std::uint32_t kJson = 0x4E4F534A;
constexpr std::uint32_t kBinary = 0x004E4942;
constexpr std::size_t kHeader = 12;
constexpr std::size_t kChunkHeader = 8;

std::uint32_t wordAt(std::string_view bytes, std::size_t at) {
    LUTKA_ASSERT(at + 4 <= bytes.size());
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i)
        word |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    return word;
}

void appendWord(std::uint32_t word, std::string& out) {
    for (std::uint32_t shift = 0; shift < 32; shift += 8)
        out += static_cast<char>(word >> shift & 0xFFU);
}

void appendChunk(std::uint32_t type, std::string data, char fill, std::string& out) {
    data.resize((data.size() + 3) / 4 * 4, fill);
    appendWord(static_cast<std::uint32_t>(data.size()), out);
    appendWord(type, out);
    out += data;
}

}  // namespace

GlbContainer unpackGlb(std::string_view bytes) {
    LUTKA_ASSERT(wordAt(bytes, 0) == kMagic);
    GlbContainer container;
    for (std::size_t at = kHeader; at + kChunkHeader <= bytes.size();) {
        const std::size_t length = wordAt(bytes, at);
        const std::string_view data = bytes.substr(at + kChunkHeader, length);
        if (wordAt(bytes, at + 4) == kJson) container.json = nlohmann::ordered_json::parse(data);
        if (wordAt(bytes, at + 4) == kBinary) container.binary = data;
        at += kChunkHeader + length;
    }
    return container;
}

std::string packGlb(const GlbContainer& container) {
    std::string chunks;
    appendChunk(kJson, container.json.dump(), ' ', chunks);
    if (!container.binary.empty()) appendChunk(kBinary, container.binary, '\0', chunks);
    std::string out;
    appendWord(kMagic, out);
    appendWord(2, out);
    appendWord(static_cast<std::uint32_t>(kHeader + chunks.size()), out);
    return out + chunks;
}

std::string gltfText(const GlbContainer& container) {
    nlohmann::ordered_json json = container.json;
    if (!container.binary.empty()) {
        const std::size_t length = json["buffers"][0]["byteLength"];
        json["buffers"][0]["uri"] =
            "data:application/octet-stream;base64," + base64(std::string_view(container.binary).substr(0, length));
    }
    return jsonText(json);
}

}  // namespace lutka::exporting
