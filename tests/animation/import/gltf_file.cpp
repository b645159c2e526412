#include "animation/import/gltf_file.hpp"

#include <unistd.h>

#include <atomic>
#include <cstring>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

namespace lutka::test {
namespace {

constexpr int kFloat = 5126;
constexpr int kByte = 5121;
constexpr int kShort = 5123;

std::string base64(const std::vector<unsigned char>& bytes) {
    static const char* const kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = (group << 8U) | (i + k < bytes.size() ? bytes[i + k] : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k <= bytes.size() ? kDigits[(group >> (18U - 6U * k)) & 63U] : '=';
    }
    return out;
}

void put32(std::string& out, std::size_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8)
        out += static_cast<char>((value >> shift) & 255U);
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    static std::atomic<int> counter{0};
    path_ = std::filesystem::temp_directory_path() /
            ("lutka-test-" + std::to_string(::getpid()) + "-" + std::to_string(counter++));
    std::filesystem::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

GltfFile::GltfFile() {
    json = {{"asset", {{"version", "2.0"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", nlohmann::json::array()}}}},
            {"nodes", nlohmann::json::array()},
            {"bufferViews", nlohmann::json::array()},
            {"accessors", nlohmann::json::array()}};
}

int GltfFile::addNode(const std::string& name, int parent, const mat4& parentFromNode) {
    const int index = static_cast<int>(json["nodes"].size());
    nlohmann::json node;
    if (!name.empty()) node["name"] = name;
    if (parentFromNode != mat4(1.0F)) {
        const float* values = glm::value_ptr(parentFromNode);
        node["matrix"] = std::vector<float>(values, values + 16);
    }
    json["nodes"].push_back(node);
    (parent < 0 ? json["scenes"][0]["nodes"] : json["nodes"][parent]["children"]).push_back(index);
    return index;
}

int GltfFile::addView(const void* data, std::size_t size) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}});
    const auto* first = static_cast<const unsigned char*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
    return static_cast<int>(json["bufferViews"].size()) - 1;
}

int GltfFile::addFloats(std::span<const float> values, const std::string& type) {
    const std::size_t width = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
    std::vector<float> low(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(width));
    std::vector<float> high = low;
    for (std::size_t i = 0; i < values.size(); ++i) {
        low[i % width] = std::min(low[i % width], values[i]);
        high[i % width] = std::max(high[i % width], values[i]);
    }
    json["accessors"].push_back({{"bufferView", addView(values.data(), values.size_bytes())},
                                 {"componentType", kFloat},
                                 {"count", values.size() / width},
                                 {"type", type},
                                 {"min", low},
                                 {"max", high}});
    return static_cast<int>(json["accessors"].size()) - 1;
}

int GltfFile::addBytes4(std::span<const std::array<std::uint8_t, 4>> values) {
    json["accessors"].push_back({{"bufferView", addView(values.data(), values.size_bytes())},
                                 {"componentType", kByte},
                                 {"count", values.size()},
                                 {"type", "VEC4"}});
    return static_cast<int>(json["accessors"].size()) - 1;
}

int GltfFile::addIndices(std::span<const std::uint16_t> values) {
    json["accessors"].push_back({{"bufferView", addView(values.data(), values.size_bytes())},
                                 {"componentType", kShort},
                                 {"count", values.size()},
                                 {"type", "SCALAR"}});
    return static_cast<int>(json["accessors"].size()) - 1;
}

void GltfFile::addTurn(const std::string& clip, int node, std::span<const float> times, int values,
                       const std::string& interpolation) {
    json["animations"].push_back(
        {{"name", clip},
         {"samplers", {{{"input", addFloats(times, "SCALAR")}, {"output", values}, {"interpolation", interpolation}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "rotation"}}}}}}});
}

void GltfFile::saveBeside(const std::filesystem::path& file, const std::string& bufferName,
                          const std::string& uri) const {
    nlohmann::json out = json;
    out["buffers"] = {{{"byteLength", bytes_.size()}, {"uri", uri}}};
    std::ofstream(file, std::ios::binary) << out.dump();
    std::ofstream(file.parent_path() / bufferName, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
}

void GltfFile::saveText(const std::filesystem::path& file) const {
    nlohmann::json out = json;
    if (!bytes_.empty()) {
        out["buffers"] = {
            {{"byteLength", bytes_.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes_)}}};
    }
    std::ofstream(file, std::ios::binary) << out.dump();
}

void GltfFile::saveBinary(const std::filesystem::path& file) const {
    nlohmann::json document = json;
    document["buffers"] = {{{"byteLength", bytes_.size()}}};
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string data(bytes_.begin(), bytes_.end());
    data.resize((data.size() + 3) / 4 * 4, '\0');
    std::string out = "glTF";
    put32(out, 2);
    put32(out, 12 + 8 + text.size() + 8 + data.size());
    put32(out, text.size());
    out += "JSON" + text;
    put32(out, data.size());
    out += std::string("BIN\0", 4) + data;
    std::ofstream(file, std::ios::binary) << out;
}

Post makePost() {
    Post post;
    for (int ring = 0; ring < 4; ++ring) {
        const float y = 0.6F * static_cast<float>(ring);
        for (const vec2& corner : {vec2(-1, -1), vec2(-1, 1), vec2(1, 1), vec2(1, -1)}) {
            post.positions.emplace_back(0.3F * corner.x, y, 0.2F * corner.y);
            post.skin.push_back({{static_cast<std::uint8_t>(std::min(ring, 2))}});
        }
    }
    for (std::uint16_t ring = 0; ring < 3; ++ring) {
        for (std::uint16_t side = 0; side < 4; ++side) {
            const auto a = static_cast<std::uint16_t>(4 * ring + side);
            const auto b = static_cast<std::uint16_t>(4 * ring + (side + 1) % 4);
            const auto up = static_cast<std::uint16_t>(4);
            for (const int i : {+a, +b, b + up, +a, b + up, a + up})
                post.indices.push_back(static_cast<std::uint16_t>(i));
        }
    }
    return post;
}

int addPostMesh(GltfFile& file, const Post& post, const mat4& meshFromModel, bool skinned) {
    std::vector<float> positions;
    std::vector<std::array<std::uint8_t, 4>> joints;
    std::vector<float> weights;
    for (std::size_t v = 0; v < post.positions.size(); ++v) {
        const vec3 p(meshFromModel * vec4(post.positions[v], 1.0F));
        positions.insert(positions.end(), {p.x, p.y, p.z});
        joints.push_back(post.skin[v].joints);
        weights.insert(weights.end(), post.skin[v].weights.begin(), post.skin[v].weights.end());
    }
    nlohmann::json attributes = {{"POSITION", file.addFloats(positions, "VEC3")}};
    if (skinned) {
        attributes["JOINTS_0"] = file.addBytes4(joints);
        attributes["WEIGHTS_0"] = file.addFloats(weights, "VEC4");
    }
    std::vector<std::uint16_t> indices = post.indices;
    // A mirror turns the triangles round, and a viewer of glTF turns them back.
    if (glm::determinant(meshFromModel) < 0.0F) {
        for (std::size_t i = 0; i < indices.size(); i += 3)
            std::swap(indices[i + 1], indices[i + 2]);
    }
    file.json["meshes"].push_back(
        {{"primitives", {{{"attributes", attributes}, {"indices", file.addIndices(indices)}}}}});
    return static_cast<int>(file.json["meshes"].size()) - 1;
}

int addSkin(GltfFile& file, const std::vector<int>& nodes, const std::vector<mat4>& jointFromMesh) {
    std::vector<float> values;
    for (const mat4& m : jointFromMesh)
        values.insert(values.end(), glm::value_ptr(m), glm::value_ptr(m) + 16);
    file.json["skins"].push_back({{"joints", nodes}, {"inverseBindMatrices", file.addFloats(values, "MAT4")}});
    return static_cast<int>(file.json["skins"].size()) - 1;
}

GltfFile makePostRig(const mat4& sceneFromArmature) {
    GltfFile file;
    const mat4 armatureFromScene = glm::inverse(sceneFromArmature);
    const int armature = file.addNode("Armature", -1, sceneFromArmature);
    std::vector<int> nodes;
    std::vector<mat4> inverseBinds;
    int parent = armature;
    vec3 before(0);
    for (const char* name : {"low", "middle", "high"}) {
        const vec3 at(armatureFromScene * vec4(0, 0.6F * static_cast<float>(nodes.size()), 0, 1));
        parent = file.addNode(name, parent, glm::translate(mat4(1.0F), at - before));
        nodes.push_back(parent);
        inverseBinds.push_back(glm::translate(mat4(1.0F), -at));
        before = at;
    }
    const int body = file.addNode("Body", armature);
    file.json["nodes"][body]["mesh"] = addPostMesh(file, makePost(), armatureFromScene);
    file.json["nodes"][body]["skin"] = addSkin(file, nodes, inverseBinds);
    return file;
}

}  // namespace lutka::test
