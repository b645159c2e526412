#include "animation/import/gltf/gltf_file.hpp"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <system_error>

#include "animation/import/gltf/gltf_text.hpp"
#include "animation/import/source_limits.hpp"
#include "animation/import/uri.hpp"
#include "core/files.hpp"
#include "core/letter_case.hpp"

namespace lutka::animation::rig_import::gltf {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kMaxUnpackedBytes = std::size_t{1} << 30U;  // of a compressed view
constexpr const char* kUncompressed = "export it again without KHR_meshopt_compression";

constexpr std::string_view kInstancing = "EXT_mesh_gpu_instancing";

// Read here, or without bearing on shape and motion.
bool isUnderstood(std::string_view extension) {
    constexpr std::array<std::string_view, 19> kExact = {
        "KHR_draco_mesh_compression", "KHR_mesh_quantization", "EXT_meshopt_compression", "KHR_meshopt_compression",
        "KHR_texture_transform", "KHR_lights_punctual", "KHR_node_visibility", "KHR_node_selectability",
        "KHR_node_hoverability", "KHR_xmp_json_ld", "KHR_xmp", "KHR_animation_pointer", "VRM", "VRMC_vrm",
        "KHR_implicit_shapes", "KHR_interactivity", "MSFT_lod", "EXT_mesh_manifold",
        // A place far off, and figures are brought to the origin.
        "CESIUM_RTC"};
    if (std::find(kExact.begin(), kExact.end(), extension) != kExact.end()) return true;
    constexpr std::array<std::string_view, 9> kKinds = {"KHR_materials_", "VRMC_",       "KHR_physics",
                                                        "EXT_materials_", "EXT_lights_", "KHR_audio",
                                                        "MSFT_audio_",    "OMI_",        "MSFT_packing_"};
    return std::any_of(kKinds.begin(), kKinds.end(),
                       [&](std::string_view kind) { return extension.starts_with(kind); });
}

// Such as KHR_texture_basisu, EXT_texture_webp and GOOGLE_texture_basis.
bool isPictureFormat(std::string_view extension) {
    return extension.find("_texture_") != std::string_view::npos;
}

// Shaders of materials, whose textures nothing else names.
bool isShading(std::string_view extension) {
    return extension == "KHR_techniques_webgl" || extension == "KHR_technique_webgl";
}

std::uint32_t littleEndian(const std::uint8_t* bytes) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i)
        value = (value << 8U) | bytes[i];
    return value;
}

std::vector<std::uint8_t> readWhole(const fs::path& file) {
    Result<std::vector<unsigned char>> bytes = readFile(file, kMaxFileBytes);
    if (!bytes)
        throw Damage{fmt::format("{}: {}", file.filename().string(), bytes.error().message), bytes.error().mend};
    return std::move(bytes).value();
}

int base64Value(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    return c == '/' || c == '_' ? 63 : -1;
}

std::vector<std::uint8_t> decodeBase64(std::string_view text) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(text.size() * 3 / 4);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        if (c == '=' || std::isspace(static_cast<unsigned char>(c)) != 0) continue;
        const int value = base64Value(c);
        if (value < 0) throw Damage{"a data URI holds something else than base64"};
        bits = (bits << 6U) | static_cast<std::uint32_t>(value);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<std::uint8_t>(bits >> static_cast<unsigned>(count)));
    }
    return bytes;
}

}  // namespace

bool isDataUri(const std::string& uri) {
    return lowerCased(uri.substr(0, 5)) == "data:";
}

std::optional<std::vector<std::uint8_t>> decodeDataUri(const std::string& uri) {
    if (!isDataUri(uri)) return std::nullopt;
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos) throw Damage{"a data URI has no data"};
    // Media types and their parameters are the same in capitals.
    if (lowerCased(uri.substr(0, comma)).find(";base64") != std::string::npos) {
        const bool isPlain = uri.find('%', comma) == std::string::npos;
        return isPlain ? decodeBase64(std::string_view(uri).substr(comma + 1))
                       : decodeBase64(decodePercents(uri.substr(comma + 1)));
    }
    const std::string plain = decodePercents(uri.substr(comma + 1));
    return std::vector<std::uint8_t>(plain.begin(), plain.end());
}

GltfFile::GltfFile(const fs::path& file, bool allowOutside) : file_(file), folder_(file, allowOutside) {
    readContainer();
    checkExtensions();
}

void GltfFile::readContainer() {
    std::vector<std::uint8_t> bytes = readWhole(file_);
    std::span<const std::uint8_t> text(bytes);
    if (bytes.size() >= 12 && std::memcmp(bytes.data(), "glTF", 4) == 0) {
        if (const std::uint32_t version = littleEndian(bytes.data() + 4); version != 2)
            throw Damage{fmt::format("is a glTF {} container; glTF 2.0 can be read", version),
                         "convert it to glTF 2.0"};
        text = {};
        for (std::size_t at = 12; at + 8 <= bytes.size();) {
            const std::size_t length = littleEndian(bytes.data() + at);
            const std::uint32_t kind = littleEndian(bytes.data() + at + 4);
            at += 8;
            const std::size_t there = std::min(length, bytes.size() - at);
            const std::span<const std::uint8_t> chunk(bytes.data() + at, there);
            if (kind == 0x4E4F534A && text.empty()) text = chunk;        // "JSON"
            if (kind == 0x004E4942 && binary_.empty()) binary_ = chunk;  // "BIN"
            at += there;
        }
    }
    json_ = parseGltfText(text, leftOut_);
    if (!binary_.empty()) container_ = std::move(bytes);  // a vector that is moved stays where it is
    const nlohmann::json* asset = member(json_, "asset");
    std::string version = asset == nullptr ? "" : textOf(*asset, "version");
    // Early writers of glTF 1.0 made it a number.
    const nlohmann::json* number = asset == nullptr ? nullptr : member(*asset, "version");
    if (number != nullptr && number->is_number()) version = fmt::format("{}", number->get<double>());
    if (!version.empty() && !version.starts_with("2"))
        throw Damage{fmt::format("is glTF {}; glTF 2.0 can be read", version), "convert it to glTF 2.0"};
    const std::string least = asset == nullptr ? "" : textOf(*asset, "minVersion");
    constexpr double kOurs = 2.0;
    if (std::strtod(least.c_str(), nullptr) > kOurs)
        throw Damage{fmt::format("needs a reader of glTF {}; glTF 2.0 can be read", least), "convert it to glTF 2.0"};
}

void GltfFile::checkExtensions() {
    const nlohmann::json* used = arrayOf(json_, "extensionsUsed");
    if (used != nullptr && std::find(used->begin(), used->end(), kInstancing) != used->end())
        leaveOut(fmt::format("copies of meshes by {} (each mesh stands once, at its node)", kInstancing));
    const nlohmann::json* required = arrayOf(json_, "extensionsRequired");
    if (required == nullptr) return;
    for (const nlohmann::json& entry : *required) {
        if (!entry.is_string()) continue;
        const std::string extension = entry.get<std::string>();
        if (isUnderstood(extension)) continue;
        if (isPictureFormat(extension)) {
            leaveOut(fmt::format("pictures stored by {}", extension));
        } else if (isShading(extension)) {
            leaveOut(fmt::format("materials by {}", extension));
        } else {
            throw Damage{fmt::format("requires the glTF extension {}, which can't be read", extension),
                         "export it again without this extension"};
        }
    }
}

const nlohmann::json& GltfFile::element(const char* array, int index) const {
    return json_.at(array).at(static_cast<std::size_t>(index));
}

std::vector<std::uint8_t> GltfFile::loadBuffer(int buffer) const {
    const std::string uri = textOf(element("buffers", buffer), "uri");
    if (std::optional<std::vector<std::uint8_t>> data = decodeDataUri(uri)) return *std::move(data);
    // Some tools add a version to the name, as in an address on the net.
    const std::string bare = uri.substr(0, uri.find_first_of("?#"));
    for (const std::string& spelling : {decodePercents(uri), uri, decodePercents(bare)}) {
        const ModelFolder::Named named = folder_.find(spelling);
        if (named.place == ModelFolder::Place::inside) return readWhole(named.file);
        if (named.place == ModelFolder::Place::outside)
            throw Damage{fmt::format("the buffer '{}' lies outside of the model's folder", uri),
                         "put the buffer beside the model, or allow it by --allow-outside"};
    }
    throw Damage{fmt::format("the buffer '{}' is missing", uri), "put the buffer beside the model"};
}

std::span<const std::uint8_t> GltfFile::bufferBytes(int buffer) {
    if (member(element("buffers", buffer), "uri") == nullptr) {
        if (buffer != 0 || binary_.empty()) throw Damage{fmt::format("buffer {} has no data", buffer)};
        return binary_;
    }
    const auto found = buffers_.find(buffer);
    return found != buffers_.end() ? found->second : (buffers_[buffer] = loadBuffer(buffer));
}

std::span<const std::uint8_t> GltfFile::slice(int buffer, std::size_t offset, std::size_t length) {
    const std::span<const std::uint8_t> bytes = bufferBytes(buffer);
    if (offset > bytes.size() || length > bytes.size() - offset)
        throw Damage{fmt::format("buffer {} ends before the data that is named in it: it is cut off", buffer)};
    return bytes.subspan(offset, length);
}

std::vector<std::uint8_t> GltfFile::decompressed(const nlohmann::json& block) {
    const int buffer = indexOf(block, "buffer", count("buffers")).value_or(0);
    const std::size_t stride = sizeOf(block, "byteStride", 0);
    const std::size_t elements = sizeOf(block, "count", 0);
    const std::span<const std::uint8_t> packed =
        slice(buffer, sizeOf(block, "byteOffset", 0), sizeOf(block, "byteLength", 0));
    if (stride == 0 || stride > 256 || elements > kMaxUnpackedBytes / stride)
        throw Damage{"a compressed view has absurd counts"};
    std::vector<std::uint8_t> out(stride * elements);
    const std::string mode = textOf(block, "mode");
    int failed = -1;
    if (mode == "ATTRIBUTES" && stride % 4 == 0)
        failed = meshopt_decodeVertexBuffer(out.data(), elements, stride, packed.data(), packed.size());
    if (mode == "TRIANGLES" && elements % 3 == 0 && (stride == 2 || stride == 4))
        failed = meshopt_decodeIndexBuffer(out.data(), elements, stride, packed.data(), packed.size());
    if (mode == "INDICES" && (stride == 2 || stride == 4))
        failed = meshopt_decodeIndexSequence(out.data(), elements, stride, packed.data(), packed.size());
    // The codec for vertices states its version in its first byte; version 1 came with KHR_meshopt_compression.
    constexpr unsigned kVersion = 0xFU;
    if (failed != 0 && mode == "ATTRIBUTES" && !packed.empty() && (packed[0] & kVersion) > 0)
        throw Damage{"a view is compressed by a version of meshoptimizer's codec that can't be read", kUncompressed};
    if (failed != 0) throw Damage{"a compressed view is damaged"};
    const std::string filter = textOf(block, "filter");
    static const std::set<std::string> known{"", "NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"};
    if (known.count(filter) == 0)
        throw Damage{fmt::format("a compressed view has the filter \"{}\", which can't be read", filter),
                     kUncompressed};
    if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) meshopt_decodeFilterOct(out.data(), elements, stride);
    if (filter == "QUATERNION" && stride == 8) meshopt_decodeFilterQuat(out.data(), elements, stride);
    if (filter == "EXPONENTIAL" && stride % 4 == 0) meshopt_decodeFilterExp(out.data(), elements, stride);
    return out;
}

std::span<const std::uint8_t> GltfFile::viewBytes(int view) {
    const nlohmann::json& source = element("bufferViews", view);
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        const nlohmann::json* block = extensionOf(source, name);
        if (block == nullptr) continue;
        const auto found = unpackedViews_.find(view);
        return found != unpackedViews_.end() ? found->second : (unpackedViews_[view] = decompressed(*block));
    }
    const std::optional<int> buffer = indexOf(source, "buffer", count("buffers"));
    if (!buffer) throw Damage{fmt::format("buffer view {} has no buffer", view)};
    return slice(*buffer, sizeOf(source, "byteOffset", 0), sizeOf(source, "byteLength", 0));
}

}  // namespace lutka::animation::rig_import::gltf
