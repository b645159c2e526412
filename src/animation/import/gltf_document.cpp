#include "animation/import/gltf_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string_view>

namespace lutka::animation::rig_import {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::uint64_t kMaxJsonBytes = std::uint64_t{256} << 20U;

// Read by Assimp 5.2.5, or without bearing on shape and motion.
bool isHarmless(std::string_view extension) {
    constexpr std::array<std::string_view, 9> kExact = {"KHR_draco_mesh_compression",
                                                        "KHR_texture_transform",
                                                        "KHR_lights_punctual",
                                                        "KHR_node_visibility",
                                                        "KHR_xmp_json_ld",
                                                        "KHR_animation_pointer",
                                                        "VRM",
                                                        "VRMC_vrm",
                                                        "KHR_materials_unlit"};
    if (std::find(kExact.begin(), kExact.end(), extension) != kExact.end()) return true;
    return extension.starts_with("KHR_materials_") || extension.starts_with("VRMC_");
}

bool isPictureFormat(std::string_view extension) {
    return extension == "KHR_texture_basisu" || extension == "EXT_texture_webp" || extension == "EXT_texture_avif" ||
           extension == "MSFT_texture_dds";
}

std::string mendFor(std::string_view extension) {
    if (extension == "KHR_mesh_quantization")
        return "write it again with float attributes, for instance `gltf-transform dequantize IN.glb OUT.glb`";
    if (extension.ends_with("meshopt_compression"))
        return "write it again uncompressed, for instance `gltf-transform copy IN.glb OUT.glb` followed by "
               "`gltf-transform dequantize`";
    return "export it again without this extension";
}

const json* member(const json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

const json* element(const json* array, std::size_t index) {
    return array != nullptr && array->is_array() && index < array->size() ? &(*array)[index] : nullptr;
}

std::optional<std::size_t> indexIn(const json& object, const char* key) {
    const json* value = member(object, key);
    if (value == nullptr || !value->is_number_unsigned()) return std::nullopt;
    return value->get<std::size_t>();
}

Error refused(const fs::path& file, std::string_view extension) {
    return {ErrorCode::input, fmt::format("requires the glTF extension {}, which can't be read", extension),
            file.string(), mendFor(extension)};
}

// Some writers quantise without saying so in extensionsRequired; Assimp reads such positions as nonsense all the same.
bool hasQuantisedPositions(const json& document) {
    const json* meshes = member(document, "meshes");
    if (meshes == nullptr || !meshes->is_array()) return false;
    for (const json& mesh : *meshes) {
        const json* primitives = member(mesh, "primitives");
        if (primitives == nullptr || !primitives->is_array()) continue;
        for (const json& primitive : *primitives) {
            const json* attributes = member(primitive, "attributes");
            const auto index = attributes == nullptr ? std::nullopt : indexIn(*attributes, "POSITION");
            const json* accessor = index ? element(member(document, "accessors"), *index) : nullptr;
            if (accessor != nullptr && indexIn(*accessor, "componentType").value_or(5126) != 5126) return true;
        }
    }
    return false;
}

std::optional<Error> checkExtensions(GltfDocument& document, const fs::path& file) {
    const json* required = member(document.json, "extensionsRequired");
    if (required != nullptr && required->is_array()) {
        for (const json& entry : *required) {
            if (!entry.is_string()) continue;
            const std::string extension = entry.get<std::string>();
            if (isPictureFormat(extension)) {
                document.warnings.push_back(
                    fmt::format("pictures stored by {} can't be read; their materials stay plain", extension));
            } else if (extension == "KHR_texture_transform") {
                document.warnings.push_back("KHR_texture_transform is not applied: pictures may sit wrongly");
            } else if (!isHarmless(extension)) {
                return refused(file, extension);
            }
        }
    }
    if (hasQuantisedPositions(document.json)) return refused(file, "KHR_mesh_quantization");
    return std::nullopt;
}

std::uint32_t littleEndian(const char* bytes) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i)
        value = (value << 8U) | static_cast<unsigned char>(bytes[i]);
    return value;
}

// The JSON text of a .glb (its first chunk) or .gltf; nothing when the file is something else.
std::optional<std::string> jsonText(std::ifstream& in, const fs::path& file, bool& binary) {
    std::array<char, 20> header{};
    in.read(header.data(), header.size());
    const auto got = in.gcount();
    binary = got >= 4 && std::memcmp(header.data(), "glTF", 4) == 0;
    std::error_code ignored;
    const std::uint64_t size = fs::file_size(file, ignored);
    std::uint64_t length = 0;
    if (binary) {
        // Version 1 containers are left to Assimp as they are.
        if (got < 20 || littleEndian(header.data() + 4) != 2) return std::nullopt;
        length = littleEndian(header.data() + 12);
    } else if (file.extension() == ".gltf") {
        length = size;
        in.clear();
        in.seekg(0);
    } else {
        return std::nullopt;
    }
    if (length > size || length > kMaxJsonBytes) length = std::min(size, kMaxJsonBytes);
    std::string text(static_cast<std::size_t>(length), '\0');
    in.read(text.data(), static_cast<std::streamsize>(length));
    text.resize(static_cast<std::size_t>(in.gcount()));
    return text;
}

// glTF node index → joint, by walking both trees in the same order.
std::map<std::size_t, int> jointsOfGltfNodes(const json& document, const NodeTree& tree) {
    std::map<std::size_t, int> joints;
    const json* nodes = member(document, "nodes");
    const json* scene = element(member(document, "scenes"), indexIn(document, "scene").value_or(0));
    const json* roots = scene == nullptr ? nullptr : member(*scene, "nodes");
    if (nodes == nullptr || roots == nullptr || !roots->is_array()) return joints;
    struct Pair {
        const json* indices;
        const aiNode* parent;
    };
    std::map<const aiNode*, int> jointOf;
    for (const NodeTree::Node& node : tree.nodes)
        jointOf[node.source] = node.joint;
    std::vector<Pair> pending;
    const auto visit = [&](const json& index, const aiNode* node) {
        const json* source = index.is_number_unsigned() ? element(nodes, index.get<std::size_t>()) : nullptr;
        if (source == nullptr || node == nullptr) return;
        const json* name = member(*source, "name");
        const bool named = name != nullptr && name->is_string() && !name->get_ref<const std::string&>().empty();
        if (named && name->get_ref<const std::string&>() != node->mName.C_Str()) return;
        if (!joints.emplace(index.get<std::size_t>(), jointOf[node]).second) return;
        const json* children = member(*source, "children");
        if (children != nullptr && children->is_array()) pending.push_back({children, node});
    };
    const aiNode* root = tree.nodes.front().source;
    // One root node is the scene's; several hang under one that Assimp adds.
    if (roots->size() == 1) {
        visit(roots->front(), root);
    } else {
        pending.push_back({roots, root});
    }
    while (!pending.empty()) {
        const Pair pair = pending.back();
        pending.pop_back();
        for (std::size_t i = 0; i < pair.indices->size() && i < pair.parent->mNumChildren; ++i)
            visit((*pair.indices)[i], pair.parent->mChildren[i]);
    }
    return joints;
}

// VRM 1.0 shifted the thumb's names by one joint towards the hand.
std::string roleOfVrm0(const std::string& bone) {
    for (const char* side : {"left", "right"}) {
        if (bone == std::string(side) + "ThumbProximal") return std::string(side) + "ThumbMetacarpal";
        if (bone == std::string(side) + "ThumbIntermediate") return std::string(side) + "ThumbProximal";
    }
    return bone;
}

// Role → glTF node index of either version's block.
std::map<std::string, std::size_t> nodesOfRoles(const json& document) {
    std::map<std::string, std::size_t> roles;
    const json* extensions = member(document, "extensions");
    if (extensions == nullptr) return roles;
    const auto bonesOf = [&](const char* extension) -> const json* {
        const json* block = member(*extensions, extension);
        const json* humanoid = block == nullptr ? nullptr : member(*block, "humanoid");
        return humanoid == nullptr ? nullptr : member(*humanoid, "humanBones");
    };
    if (const json* bones = bonesOf("VRMC_vrm"); bones != nullptr && bones->is_object()) {
        for (const auto& [role, bone] : bones->items()) {
            if (const auto node = indexIn(bone, "node")) roles[role] = *node;
        }
    } else if (const json* old = bonesOf("VRM"); old != nullptr && old->is_array()) {
        for (const json& entry : *old) {
            const json* bone = member(entry, "bone");
            const auto node = indexIn(entry, "node");
            if (bone != nullptr && bone->is_string() && node) roles[roleOfVrm0(bone->get<std::string>())] = *node;
        }
    }
    return roles;
}

}  // namespace

Result<std::optional<GltfDocument>> readGltfDocument(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) return Error{ErrorCode::input, "can't be opened", file.string(), ""};
    GltfDocument document;
    const std::optional<std::string> text = jsonText(in, file, document.binary);
    if (!text) return std::optional<GltfDocument>();
    document.json = json::parse(*text, nullptr, false);
    if (document.json.is_discarded() || !document.json.is_object()) {
        return Error{ErrorCode::input, "the glTF's JSON is broken or cut off", file.string(),
                     "check that the file is whole"};
    }
    if (std::optional<Error> error = checkExtensions(document, file)) return *std::move(error);
    return std::optional<GltfDocument>(std::move(document));
}

std::map<std::string, int> vrmHumanoid(const GltfDocument& document, const NodeTree& tree,
                                       std::vector<std::string>& warnings) {
    std::map<std::string, int> humanoid;
    const std::map<std::string, std::size_t> roles = nodesOfRoles(document.json);
    if (roles.empty()) return humanoid;
    const std::map<std::size_t, int> joints = jointsOfGltfNodes(document.json, tree);
    for (const auto& [role, node] : roles) {
        const auto found = joints.find(node);
        if (found != joints.end()) {
            humanoid[role] = found->second;
        } else {
            warnings.push_back(fmt::format("the VRM role '{}' names node {}, which is not in the scene", role, node));
        }
    }
    return humanoid;
}

}  // namespace lutka::animation::rig_import
